#include "aureole/color/rgb.h"

#include <cmath>

namespace aureole::color {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

constexpr Matrix inverse(const Matrix& m) {
    const auto cofactor = [&](std::size_t r, std::size_t c) {
        const std::size_t r1 = (r + 1) % 3;
        const std::size_t r2 = (r + 2) % 3;
        const std::size_t c1 = (c + 1) % 3;
        const std::size_t c2 = (c + 2) % 3;
        return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    };
    const double determinant =
        m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
    Matrix result{};
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) result[r][c] = cofactor(c, r) / determinant;
    }
    return result;
}

// IEC 61966-2-1:1999, as printed. Its middle row is kLuminanceWeights, so that Y and luminance()
// agree exactly; the other direction is inverted here instead of taken from the standard's
// rounded figures, so that there and back is the identity.
constexpr Matrix kXyzFromRgb = {{{0.4124, 0.3576, 0.1805},
                                 {kLuminanceWeights[0], kLuminanceWeights[1], kLuminanceWeights[2]},
                                 {0.0193, 0.1192, 0.9505}}};
constexpr Matrix kRgbFromXyz = inverse(kXyzFromRgb);

std::array<double, 3> multiply(const Matrix& m, const std::array<double, 3>& v) {
    return {m[0][0] * v[0] + m[0][1] * v[1] + m[0][2] * v[2],
            m[1][0] * v[0] + m[1][1] * v[1] + m[1][2] * v[2],
            m[2][0] * v[0] + m[2][1] * v[1] + m[2][2] * v[2]};
}

}  // namespace

Rgb rgb_from_xyz(const Xyz& xyz) { return multiply(kRgbFromXyz, xyz); }
Xyz xyz_from_rgb(const Rgb& rgb) { return multiply(kXyzFromRgb, rgb); }

std::array<double, 2> chromaticity(const Rgb& rgb) {
    const Xyz xyz = xyz_from_rgb(rgb);
    const double sum = xyz[0] + xyz[1] + xyz[2];
    return {xyz[0] / sum, xyz[1] / sum};
}

float srgb_encode(float linear) {
    const double x = std::abs(double{linear});
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return static_cast<float>(std::copysign(encoded, linear));
}

float srgb_decode(float encoded) {
    const double x = std::abs(double{encoded});
    const double linear = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    return static_cast<float>(std::copysign(linear, encoded));
}

}  // namespace aureole::color
