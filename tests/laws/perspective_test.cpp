// How far the shift-invariant form of perspective glare,
//     W(x) L(x) = W(s) L(s) k(x - s),
// is from the exact sum over angles, L(x) = E psf(angle between x and s), for a source in the
// corner. The figures are those of docs/glare.md.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "aureole/base/units.h"
#include "aureole/eye/scatter.h"
#include "aureole/image/view.h"

namespace aureole {
namespace {

using Direction = std::array<double, 3>;

Direction direction(const View& view, double x, double y) {
    const double f = view.focal_length_px();
    const double u = (x - view.axis_x) / f;
    const double v = (y - view.axis_y) / f;
    const double length = std::sqrt(1 + u * u + v * v);
    return {u / length, v / length, 1 / length};
}

double angle_deg(const Direction& a, const Direction& b) {
    const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return deg_from_rad(std::acos(std::min(dot, 1.0)));
}

// Relative solid angle of a pixel: cos^3 of its angle from the axis.
double weight(const View& view, double x, double y) {
    return std::pow(direction(view, x, y)[2], 3);
}

// Glare at a fraction `t` of the way from the source's corner to the opposite one: shift-invariant
// over exact.
double ratio(const View& view, double t, const eye::ScatterPsf& psf) {
    const double x = t * view.width;
    const double y = t * view.height;
    const double f = view.focal_length_px();
    const double exact = psf.per_sr(angle_deg(direction(view, 0, 0), direction(view, x, y)));
    // Energy kernel of a central source at the same displacement, per relative pixel.
    const double displacement = std::hypot(x, y) / f;
    const double angle = std::atan(displacement);
    const double kernel = psf.per_sr(deg_from_rad(angle)) * std::pow(std::cos(angle), 3);
    return weight(view, 0, 0) * kernel / weight(view, x, y) / (weight(view, 0, 0) * exact);
}

struct Figures {
    double fov_deg;
    double near;      // 5 % of the diagonal from the source
    double centre;    // the picture's centre
    double opposite;  // the opposite corner
};

class CornerSource : public testing::TestWithParam<Figures> {};

TEST_P(CornerSource, ErrorIsAsDocumented) {
    const Figures& expected = GetParam();
    const View view = View::from_fov(1920, 1080, expected.fov_deg, Projection::kPerspective);
    const eye::ScatterPsf psf(eye::ScatterModel::kCie, 30, eye::Pigmentation::kBrown, 5);
    fmt::print("{} deg: shift-invariant / exact near {:.3f}, centre {:.3f}, opposite {:.3f}\n",
               expected.fov_deg, ratio(view, 0.05, psf), ratio(view, 0.5, psf),
               ratio(view, 1, psf));
    EXPECT_NEAR(ratio(view, 0.05, psf), expected.near, 0.01);
    EXPECT_NEAR(ratio(view, 0.5, psf), expected.centre, 0.01);
    EXPECT_NEAR(ratio(view, 1, psf), expected.opposite, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Fields, CornerSource,
                         testing::Values(Figures{60, 1, 1, 1}, Figures{90, 1, 1, 1}),
                         [](const auto& instance) {
                             return std::to_string(static_cast<int>(instance.param.fov_deg)) +
                                    "_deg";
                         });

}  // namespace
}  // namespace aureole
