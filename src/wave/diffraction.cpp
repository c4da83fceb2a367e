#include "aureole/wave/diffraction.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "wave/transform_samples.h"

namespace aureole::wave {
namespace {

// What one pass over the aperture learns about a row.
struct RowLight {
    double energy = 0;
    int first_column = 0;
    int end_column = 0;  // empty: 0, 0
};

RowLight row_light(const float* re, const float* im, int n) {
    const auto dark = [&](int i) { return re[i] == 0 && im[i] == 0; };
    int first = 0;
    while (first < n && dark(first)) ++first;
    if (first == n) return {};
    int end = n;
    while (dark(end - 1)) --end;
    // Four independent sums: the order is fixed, and additions overlap.
    double sums[4] = {};
    int i = first;
    for (; i + 4 <= end; i += 4) {
        for (int s = 0; s < 4; ++s) {
            const double a = static_cast<double>(re[i + s]);
            const double b = static_cast<double>(im[i + s]);
            sums[s] += a * a + b * b;
        }
    }
    for (; i < end; ++i) {
        sums[0] += static_cast<double>(re[i]) * static_cast<double>(re[i]) +
                   static_cast<double>(im[i]) * static_cast<double>(im[i]);
    }
    return {sums[0] + sums[1] + sums[2] + sums[3], first, end};
}

void require_wavelength(double wavelength_nm) {
    if (!(wavelength_nm > 0) || !std::isfinite(wavelength_nm)) {
        throw InvalidArgument("wavelength (nm)", std::to_string(wavelength_nm),
                              "must be positive and finite");
    }
}

// Multiplies by exp(i cycles_per_mm2 * 2 pi r^2), which separates into x and y.
void multiply_quadratic_phase(Field& field, double cycles_per_mm2) {
    const int n = field.grid.samples;
    const auto count = static_cast<std::size_t>(n);
    std::vector<float> c(count);
    std::vector<float> s(count);
    for (int i = 0; i < n; ++i) {
        const double x = field.grid.x_mm(i);
        const double phase = 2 * kPi * cycles_per_mm2 * x * x;
        c[static_cast<std::size_t>(i)] = static_cast<float>(std::cos(phase));
        s[static_cast<std::size_t>(i)] = static_cast<float>(std::sin(phase));
    }
    parallel_for(count, [&](std::size_t j, int) {
        float* re = field.re.data() + j * count;
        float* im = field.im.data() + j * count;
        for (std::size_t i = 0; i < count; ++i) {
            const float factor_re = c[i] * c[j] - s[i] * s[j];
            const float factor_im = c[i] * s[j] + s[i] * c[j];
            const float a = re[i];
            const float b = im[i];
            re[i] = a * factor_re - b * factor_im;
            im[i] = a * factor_im + b * factor_re;
        }
    });
}

}  // namespace

double Pattern::step(double wavelength_nm) const {
    return mm_from_nm(wavelength_nm) / grid.extent_mm;
}

double Pattern::intensity_per_sr(int k, int l, double wavelength_nm) const {
    const double d = step(wavelength_nm);
    const double sine2 = (static_cast<double>(k) * k + static_cast<double>(l) * l) * d * d;
    if (sine2 >= 1) return 0;
    const int half = grid.samples / 2;
    const std::size_t index =
        static_cast<std::size_t>(l + half) * static_cast<std::size_t>(grid.samples) +
        static_cast<std::size_t>(k + half);
    return static_cast<double>(energy[index]) * std::sqrt(1 - sine2) / (d * d);
}

double transform(Field& field, fourier::Fft2d& fft) {
    const int n = field.grid.samples;
    if (fft.width() != n || fft.height() != n) {
        throw InvalidArgument(
            "transform size", std::to_string(fft.width()) + "x" + std::to_string(fft.height()),
            "must be that of the aperture, " + std::to_string(n) + "x" + std::to_string(n));
    }
    const auto count = static_cast<std::size_t>(n);
    std::vector<RowLight> rows(count);
    parallel_for(count, [&](std::size_t j, int) {
        rows[j] = row_light(field.re.data() + j * count, field.im.data() + j * count, n);
    });
    double energy = 0;
    int first = n;
    int end = 0;
    for (const RowLight& row : rows) {
        energy += row.energy;
        if (row.end_column == 0) continue;
        first = std::min(first, row.first_column);
        end = std::max(end, row.end_column);
    }
    if (!(energy > 0) || !std::isfinite(energy)) {
        throw InvalidArgument("energy of the aperture", std::to_string(energy),
                              "the mask has no opening; some samples must be open, all finite");
    }
    fft.forward(field.re.data(), field.im.data(), first, end);
    return energy * static_cast<double>(count) * static_cast<double>(count);
}

Pattern fraunhofer(Field& field, fourier::Fft2d& fft) {
    transform(field, fft);
    const auto n = static_cast<std::size_t>(field.grid.samples);
    const std::size_t half = n / 2;
    const std::vector<float> gain = box_filter_gain(field);
    Pattern pattern{field.grid, Buffer(field.grid.size())};
    std::vector<double> sums(n);
    parallel_for(n, [&](std::size_t j, int) {
        const std::size_t row = (j + half) % n;  // of the pattern
        const float row_gain = gain[row < half ? half - row : row - half];
        const float* re = field.re.data() + j * n;
        const float* im = field.im.data() + j * n;
        float* out = pattern.energy.data() + row * n;
        for (std::size_t i = 0; i < half; ++i) {
            const std::size_t h = i + half;
            out[h] = (re[i] * re[i] + im[i] * im[i]) * (gain[i] * row_gain);
            out[i] = (re[h] * re[h] + im[h] * im[h]) * (gain[half - i] * row_gain);
        }
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += static_cast<double>(out[i]);
        sums[j] = sum;
    });
    double total = 0;
    for (const double sum : sums) total += sum;
    const auto scale = static_cast<float>(1 / total);
    parallel_for(n, [&](std::size_t j, int) {
        float* out = pattern.energy.data() + j * n;
        for (std::size_t i = 0; i < n; ++i) out[i] *= scale;
    });
    return pattern;
}

void add_defocus(Field& field, double defocus_dioptres, double wavelength_nm) {
    require_wavelength(wavelength_nm);
    if (!std::isfinite(defocus_dioptres)) {
        throw InvalidArgument("defocus (dioptres)", std::to_string(defocus_dioptres),
                              "must be finite");
    }
    // pi D r^2 / lambda with D in 1/m and lengths in mm: D / 1000 per mm.
    if (defocus_dioptres == 0) return;
    multiply_quadratic_phase(field, defocus_dioptres * 1e-3 / (2 * mm_from_nm(wavelength_nm)));
    field.box_filtered = false;
}

double chromatic_defocus_dioptres(double wavelength_nm) {
    require_wavelength(wavelength_nm);
    return 1.7312 - 0.63346 / (wavelength_nm * 1e-3 - 0.21410);
}

void add_fresnel_term(Field& field, double distance_mm, double wavelength_nm) {
    if (!(distance_mm > 0) || !std::isfinite(distance_mm)) {
        throw InvalidArgument("distance (mm)", std::to_string(distance_mm),
                              "must be positive and finite");
    }
    add_defocus(field, 1000 / distance_mm, wavelength_nm);
}

double max_spacing_for_defocus_mm(double defocus_dioptres, double radius_mm, double wavelength_nm) {
    return mm_from_nm(wavelength_nm) / (2 * std::abs(defocus_dioptres) * 1e-3 * radius_mm);
}

}  // namespace aureole::wave
