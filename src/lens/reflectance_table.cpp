#include "lens/reflectance_table.h"

#include <cmath>

#include "aureole/base/parallel.h"
#include "aureole/lens/coating.h"
#include "lens/ray_kernels.h"

namespace aureole::lens {

ReflectanceTable::ReflectanceTable(const Lens& lens, std::span<const double> wavelengths_nm)
    : faces_(lens.faces().size()),
      samples_(wavelengths_nm.size() * faces_ * 4 * kReflectanceSamples),
      axial_transmission_(wavelengths_nm.size(), 1.0) {
    parallel_for(wavelengths_nm.size(), [&](std::size_t band, int) {
        const double wavelength_nm = wavelengths_nm[band];
        const std::vector<double> index = lens.indices(wavelength_nm);
        for (std::size_t face = 0; face < faces_; ++face) {
            const Coating& coating = lens.faces()[face].coating;
            const double front = index[face];
            const double back = index[face + 1];
            const auto fill = [&](bool backwards, int k) {
                double cosine = static_cast<double>(k) / (kReflectanceSamples - 1);
                Reflectance r{1, 1};
                if (backwards) {
                    // A lossless stack reflects as much from behind, at the angle that light
                    // refracts to.
                    const double sine2 = (1 - cosine * cosine) * back * back / (front * front);
                    cosine = sine2 < 1 ? std::sqrt(1 - sine2) : 0;
                }
                if (cosine > 0) r = reflectance(front, back, coating, wavelength_nm, cosine);
                float* pair = samples_.data() + offset(face, band, backwards) + 2 * k;
                pair[0] = static_cast<float>(r.s);
                pair[1] = static_cast<float>(r.p);
            };
            for (int k = 0; k < kReflectanceSamples; ++k) {
                fill(false, k);
                fill(true, k);
            }
            axial_transmission_[band] *=
                1 - reflectance(front, back, coating, wavelength_nm, 1).mean();
        }
    });
}

std::size_t ReflectanceTable::offset(std::size_t face, std::size_t band, bool backwards) const {
    return ((band * faces_ + face) * 2 + (backwards ? 1 : 0)) * 2 * kReflectanceSamples;
}

const float* ReflectanceTable::pairs(int face, int band, bool backwards) const {
    return samples_.data() +
           offset(static_cast<std::size_t>(face), static_cast<std::size_t>(band), backwards);
}

}  // namespace aureole::lens
