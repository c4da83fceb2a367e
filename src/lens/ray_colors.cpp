#include "lens/ray_colors.h"

#include <algorithm>

#include "aureole/color/spectrum.h"
#include "aureole/lens/glass.h"
#include "lens/polarisation.h"
#include "lens/ray_kernels.h"
#include "lens/reflectance_table.h"

namespace aureole::lens {
namespace {

std::vector<double> band_wavelengths_nm() {
    std::vector<double> wavelengths_nm;
    for (const color::SpectralBand& band : color::sample_spectrum(RayColors::kBands)) {
        wavelengths_nm.push_back(band.wavelength_nm);
    }
    return wavelengths_nm;
}

}  // namespace

RayColors::RayColors(const Lens& lens) : tracer_(lens, kLineDNm), stop_(lens.stop()) {
    const auto bands = color::sample_spectrum(kBands);
    const ReflectanceTable table(lens, band_wavelengths_nm());
    samples_.resize(lens.faces().size() * 2 * kReflectanceSamples);
    for (std::size_t b = 0; b < kBands; ++b) {
        const int band = static_cast<int>(b);
        axial_[b] = table.axial_transmission(band);
        rgb_[b] = bands[b].rgb;
        Sample* sample = samples_.data();
        for (int face = 0; face < static_cast<int>(lens.faces().size()); ++face) {
            for (const bool backwards : {false, true}) {
                const float* pairs = table.pairs(face, band, backwards);
                for (int k = 0; k < kReflectanceSamples; ++k, ++sample) {
                    sample->s[b] = pairs[2 * k];
                    sample->p[b] = pairs[2 * k + 1];
                }
            }
        }
    }
}

bool RayColors::color_of(const Bounces& bounces, const Ray& ray, std::vector<Incidence>& incidences,
                         std::array<double, 3>& color) const {
    color = {};
    if (tracer_.trace(bounces, ray, incidences).fate != Fate::kArrived) return false;
    PolarisationFrame frame(ray.direction);
    Coherency<float, kBands> light;
    Bands s;
    Bands p;
    for (const Incidence& at : incidences) {
        if (at.step.face == stop_) continue;
        const double position = at.cosine * (kReflectanceSamples - 1);
        const int below = std::clamp(static_cast<int>(position), 0, kReflectanceSamples - 2);
        const auto part = static_cast<float>(position - below);
        const Sample* sample = &samples_[static_cast<std::size_t>(
            (2 * at.step.face + (at.step.backwards ? 1 : 0)) * kReflectanceSamples + below)];
        for (std::size_t b = 0; b < kBands; ++b) {
            s[b] = sample[0].s[b] + part * (sample[1].s[b] - sample[0].s[b]);
            p[b] = sample[0].p[b] + part * (sample[1].p[b] - sample[0].p[b]);
        }
        light.turn(frame.turn_to_plane(at.direction, at.normal));
        at.step.reflects ? light.reflect(s, p) : light.transmit(s, p);
    }
    for (std::size_t b = 0; b < kBands; ++b) {
        const double share = static_cast<double>(light.energy(b)) / axial_[b];
        for (std::size_t c = 0; c < 3; ++c) color[c] += rgb_[b][c] * share;
    }
    return true;
}

std::array<double, 3> RayColors::axial_transmission() const {
    std::array<double, 3> axial = {};
    for (std::size_t b = 0; b < kBands; ++b) {
        for (std::size_t c = 0; c < 3; ++c) axial[c] += rgb_[b][c] * axial_[b];
    }
    return axial;
}

}  // namespace aureole::lens
