#include "aureole/ibl/spherical_harmonics.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "ibl/gauss_legendre.h"

namespace aureole::ibl {
namespace {

// Texels of maps below this size are taken in parts.
constexpr int kFinestSize = 16;
// Sizes from which 2 and 1 Gauss-Legendre points per side of a texel do for Y; 4 below.
constexpr int kTwoPointSize = 64;
constexpr int kOnePointSize = 1024;

constexpr double kWeakestPerBand = 16;  // cutoffs that are looked for
constexpr int kCutoffSteps = 14;
constexpr int kGridSize = 24;  // of the cube map on which negative values are looked for

const GaussRule& rule_for(int size) {
    static const GaussRule one = gauss_legendre(1);
    static const GaussRule two = gauss_legendre(2);
    static const GaussRule four = gauss_legendre(4);
    if (size >= kOnePointSize) return one;
    return size >= kTwoPointSize ? two : four;
}

using Basis = std::array<double, kMostShCoefficients>;
using Coefficients = std::array<std::array<double, 3>, kMostShCoefficients>;

// Associated Legendre functions without their sin^m, normalised, by the recurrence over l
// (Abramowitz & Stegun 8.5.3); times the real and imaginary parts of (x + i y)^m they are Y (Sloan
// 2013, "Efficient Spherical Harmonic Evaluation").
struct Recurrence {
    double diagonal[kMostShBands];              // P of l = m
    double grow[kMostShBands][kMostShBands];    // by m and l: P of l + 1 = grow z P of l
    double shrink[kMostShBands][kMostShBands];  //             - shrink P of l - 1

    Recurrence() {
        const auto norm = [](int l, int m) {
            double ratio = m == 0 ? 1 : 2;  // 2 (l - m)! / (l + m)!
            for (int i = l - m + 1; i <= l + m; ++i) ratio /= i;
            return std::sqrt((2 * l + 1) / (4 * kPi) * ratio);
        };
        double double_factorial = 1;  // (2m - 1)!!
        for (int m = 0; m < kMostShBands; ++m) {
            diagonal[m] = norm(m, m) * double_factorial;
            double_factorial *= 2 * m + 1;
            for (int l = m; l < kMostShBands; ++l) {
                const double to = norm(l + 1, m) / (l + 1 - m);
                grow[m][l] = (2 * l + 1) * to / norm(l, m);
                shrink[m][l] = l > m ? (l + m) * to / norm(l - 1, m) : 0;
            }
        }
    }
};

// The first `bands` bands; the rest of `basis` is left as it is.
void set_basis(const Direction& unit, int bands, Basis& basis) {
    static const Recurrence recurrence;
    double real = 1;  // of (x + i y)^m
    double imaginary = 0;
    for (int m = 0; m < bands; ++m) {
        double before = 0;
        double legendre = recurrence.diagonal[m];
        for (int l = m; l < bands; ++l) {
            const auto middle = static_cast<std::size_t>(l * l + l);
            basis[middle - static_cast<std::size_t>(m)] = legendre * imaginary;
            basis[middle + static_cast<std::size_t>(m)] = legendre * real;
            const double next =
                recurrence.grow[m][l] * unit.z * legendre - recurrence.shrink[m][l] * before;
            before = legendre;
            legendre = next;
        }
        const double turned = real * unit.x - imaginary * unit.y;
        imaginary = real * unit.y + imaginary * unit.x;
        real = turned;
    }
}

// Integral of Y over texel (x, y) of a face.
Basis integral_over(int face, int x, int y, int size, int bands) {
    const GaussRule& rule = rule_for(size);
    const double half = 1.0 / size;
    Basis basis;
    Basis sum = {};
    double total = 0;
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const double s = (2 * x + 1 + rule.nodes[i]) * half - 1;
            const double t = (2 * y + 1 + rule.nodes[j]) * half - 1;
            const double h = 1 + s * s + t * t;
            const double weight = rule.weights[i] * rule.weights[j] / (h * std::sqrt(h));
            set_basis(direction_of({face, s, t}), bands, basis);
            total += weight;
            for (int k = 0; k < bands * bands; ++k) {
                sum[static_cast<std::size_t>(k)] += weight * basis[static_cast<std::size_t>(k)];
            }
        }
    }
    // So that a constant is exact for every rule.
    const double scale = texel_solid_angle_sr(x, y, size) / total;
    for (double& value : sum) value *= scale;
    return sum;
}

double window_at(ShWindow window, double cutoff, int band) {
    if (window == ShWindow::kNone || band == 0) return 1;
    if (band >= cutoff) return 0;
    const double x = kPi * band / cutoff;
    return window == ShWindow::kHann ? (1 + std::cos(x)) / 2 : std::sin(x) / x;
}

int band_of(std::size_t coefficient) {
    return static_cast<int>(std::sqrt(static_cast<double>(coefficient) + 0.5));
}

bool is_negative_somewhere(const SphericalHarmonics& sh) {
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < kGridSize; ++y) {
            for (int x = 0; x < kGridSize; ++x) {
                const auto rgb = evaluate_sh(sh, texel_direction(face, x, y, kGridSize));
                if (rgb[0] < 0 || rgb[1] < 0 || rgb[2] < 0) return true;
            }
        }
    }
    return false;
}

}  // namespace

std::array<double, kMostShCoefficients> sh_basis(const Direction& unit) {
    Basis basis;
    set_basis(unit, kMostShBands, basis);
    return basis;
}

SphericalHarmonics project_to_sh(const CubeMap& environment, int bands) {
    if (environment.empty()) {
        throw InvalidArgument("environment", "empty", "a cube map has texels");
    }
    if (bands < 1 || bands > kMostShBands) {
        throw InvalidArgument("bands", std::to_string(bands),
                              fmt::format("must be in [1, {}]", kMostShBands));
    }
    const int parts = (kFinestSize + environment.size() - 1) / environment.size();
    const int size = parts * environment.size();
    // One sum per row, added in their order: the same bits with any number of threads.
    std::vector<Coefficients> rows(static_cast<std::size_t>(kFaces * size));
    parallel_for(rows.size(), [&](std::size_t row, int) {
        const int face = static_cast<int>(row) / size;
        const int y = static_cast<int>(row) % size;
        Coefficients sum = {};
        for (int x = 0; x < size; ++x) {
            const Basis integral = integral_over(face, x, y, size, bands);
            for (int c = 0; c < 3; ++c) {
                const double radiance = environment.at(face, x / parts, y / parts, c);
                for (int k = 0; k < bands * bands; ++k) {
                    sum[static_cast<std::size_t>(k)][static_cast<std::size_t>(c)] +=
                        radiance * integral[static_cast<std::size_t>(k)];
                }
            }
        }
        rows[row] = sum;
    });
    SphericalHarmonics sh;
    sh.bands = bands;
    sh.coefficients.resize(static_cast<std::size_t>(bands * bands));
    for (const Coefficients& row : rows) {
        for (std::size_t k = 0; k < sh.coefficients.size(); ++k) {
            for (std::size_t c = 0; c < 3; ++c) sh.coefficients[k][c] += row[k][c];
        }
    }
    return sh;
}

SphericalHarmonics irradiance_of_sh(const SphericalHarmonics& radiance) {
    constexpr std::array<double, kMostShBands> kFactor = {kPi, 2 * kPi / 3, kPi / 4, 0, -kPi / 24};
    SphericalHarmonics irradiance = radiance;
    for (std::size_t k = 0; k < irradiance.coefficients.size(); ++k) {
        for (double& value : irradiance.coefficients[k]) {
            value *= kFactor[static_cast<std::size_t>(band_of(k))];
        }
    }
    return irradiance;
}

std::array<double, 3> evaluate_sh(const SphericalHarmonics& sh, const Direction& unit) noexcept {
    const Basis basis = sh_basis(unit);
    std::array<double, 3> rgb = {};
    for (std::size_t k = 0; k < sh.coefficients.size(); ++k) {
        for (std::size_t c = 0; c < 3; ++c) rgb[c] += basis[k] * sh.coefficients[k][c];
    }
    return rgb;
}

SphericalHarmonics windowed(const SphericalHarmonics& sh, ShWindow window, double cutoff) {
    if (!(cutoff > 0)) {
        throw InvalidArgument("cutoff", fmt::format("{}", cutoff), "must be positive");
    }
    SphericalHarmonics result = sh;
    for (std::size_t k = 0; k < result.coefficients.size(); ++k) {
        for (double& value : result.coefficients[k]) {
            value *= window_at(window, cutoff, band_of(k));
        }
    }
    return result;
}

double deringing_cutoff(const SphericalHarmonics& sh, ShWindow window) {
    if (window == ShWindow::kNone) {
        throw InvalidArgument("window", "none", "must be hann or lanczos");
    }
    // Up to 1 nothing but the mean is left. Weaker windows ring more, so halving finds the limit.
    double good = 1;
    double bad = kWeakestPerBand * sh.bands;
    if (!is_negative_somewhere(windowed(sh, window, bad))) return bad;
    for (int i = 0; i < kCutoffSteps; ++i) {
        const double middle = (good + bad) / 2;
        (is_negative_somewhere(windowed(sh, window, middle)) ? bad : good) = middle;
    }
    return good;
}

}  // namespace aureole::ibl
