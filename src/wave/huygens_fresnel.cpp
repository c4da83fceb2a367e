#include "aureole/wave/huygens_fresnel.h"

#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"

namespace aureole::wave {

std::vector<std::complex<double>> huygens_fresnel(const Field& field, double wavelength_nm,
                                                  double distance_mm,
                                                  std::span<const Point> points) {
    if (!(wavelength_nm > 0)) {
        throw InvalidArgument("wavelength (nm)", std::to_string(wavelength_nm), "must be positive");
    }
    if (!(distance_mm > 0)) {
        throw InvalidArgument("distance (mm)", std::to_string(distance_mm), "must be positive");
    }
    struct Source {
        double x, y, re, im;
    };
    const ApertureGrid& grid = field.grid;
    std::vector<Source> sources;
    for (int j = 0; j < grid.samples; ++j) {
        for (int i = 0; i < grid.samples; ++i) {
            const std::size_t index =
                static_cast<std::size_t>(j) * static_cast<std::size_t>(grid.samples) +
                static_cast<std::size_t>(i);
            const double re = static_cast<double>(field.re[index]);
            const double im = static_cast<double>(field.im[index]);
            if (re != 0 || im != 0) sources.push_back({grid.x_mm(i), grid.y_mm(j), re, im});
        }
    }
    if (sources.empty()) {
        throw InvalidArgument("energy of the aperture", "0", "the mask has no opening");
    }
    const double lambda = mm_from_nm(wavelength_nm);
    const double k = 2 * kPi / lambda;
    const double z = distance_mm;
    std::vector<std::complex<double>> amplitudes(points.size());
    parallel_for(points.size(), [&](std::size_t p, int) {
        double sum_re = 0;
        double sum_im = 0;
        for (const Source& source : sources) {
            const double dx = points[p].x_mm - source.x;
            const double dy = points[p].y_mm - source.y;
            const double r2 = dx * dx + dy * dy + z * z;
            const double r = std::sqrt(r2);
            const double c = std::cos(k * r) * z / r2;  // 1/r and the obliquity z/r
            const double s = std::sin(k * r) * z / r2;
            sum_re += source.re * c - source.im * s;
            sum_im += source.re * s + source.im * c;
        }
        const double scale = grid.spacing_mm() * grid.spacing_mm() / lambda;
        amplitudes[p] = std::complex<double>(sum_im, -sum_re) * scale;  // 1/i
    });
    return amplitudes;
}

std::vector<double> huygens_fresnel_per_sr(const Field& field, double wavelength_nm,
                                           double distance_mm, std::span<const Point> points) {
    const auto amplitudes = huygens_fresnel(field, wavelength_nm, distance_mm, points);
    double light_mm2 = 0;
    for (std::size_t i = 0; i < field.grid.size(); ++i) {
        light_mm2 += static_cast<double>(field.re[i]) * static_cast<double>(field.re[i]) +
                     static_cast<double>(field.im[i]) * static_cast<double>(field.im[i]);
    }
    light_mm2 *= field.grid.spacing_mm() * field.grid.spacing_mm();
    std::vector<double> intensities(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double r2 = points[p].x_mm * points[p].x_mm + points[p].y_mm * points[p].y_mm +
                          distance_mm * distance_mm;
        const double cosine = distance_mm / std::sqrt(r2);
        intensities[p] = std::norm(amplitudes[p]) * r2 / (cosine * light_mm2);
    }
    return intensities;
}

}  // namespace aureole::wave
