// How far the shift-invariant form of perspective glare,
//     W(x) L(x) = W(s) L(s) k(x - s),
// is from the exact sum over angles, L(x) = E psf(angle between x and s), for a source in the
// corner. The figures are those of docs/glare.md.
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

struct Position {
    double x;
    double y;
};

// Where the view shows what lies `away_deg` from its corner (0, 0), towards the optical axis or at
// right angles to that.
Position away_from_corner(const View& view, double away_deg, bool towards_axis) {
    const Direction corner = direction(view, 0, 0);
    const double theta = std::acos(corner[2]);
    const double phi = std::atan2(corner[1], corner[0]);
    const double away = rad_from_deg(away_deg);
    const Direction radial = {std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi),
                              -std::sin(theta)};
    const Direction tangential = {-std::sin(phi), std::cos(phi), 0};
    Direction seen;
    for (std::size_t i = 0; i < 3; ++i) {
        seen[i] = corner[i] * std::cos(away) +
                  (towards_axis ? -radial[i] : tangential[i]) * std::sin(away);
    }
    const double f = view.focal_length_px();
    return {view.axis_x + f * seen[0] / seen[2], view.axis_y + f * seen[1] / seen[2]};
}

// Glare of a source in the corner (0, 0): shift-invariant over exact.
double ratio(const View& view, const Position& at, const eye::ScatterPsf& psf) {
    const double exact = psf.per_sr(angle_deg(direction(view, 0, 0), direction(view, at.x, at.y)));
    // Energy kernel of a central source at the same displacement, per relative pixel.
    const double angle = std::atan(std::hypot(at.x, at.y) / view.focal_length_px());
    const double kernel = psf.per_sr(deg_from_rad(angle)) * std::pow(std::cos(angle), 3);
    return kernel / (weight(view, at.x, at.y) * exact);
}

struct Figures {
    double fov_deg;
    double towards_axis;    // 10 deg from the source
    double at_right_angle;  // 10 deg from the source
    double centre;          // of the picture
};

class CornerSource : public testing::TestWithParam<Figures> {};

TEST_P(CornerSource, ErrorIsAsDocumented) {
    const Figures& expected = GetParam();
    const View view = View::from_fov(1920, 1080, expected.fov_deg, Projection::kPerspective);
    const eye::ScatterPsf psf(eye::ScatterModel::kCie, 30, eye::Pigmentation::kBrown, 5);
    EXPECT_NEAR(ratio(view, away_from_corner(view, 10, true), psf), expected.towards_axis, 0.005);
    EXPECT_NEAR(ratio(view, away_from_corner(view, 10, false), psf), expected.at_right_angle,
                0.005);
    EXPECT_NEAR(ratio(view, {view.axis_x, view.axis_y}, psf), expected.centre, 0.005);
}

// On the axis the two are the same thing.
TEST(CentralSource, IsExact) {
    View view = View::from_fov(1920, 1080, 60, Projection::kPerspective);
    view.axis_x = view.axis_y = 0;
    const eye::ScatterPsf psf(eye::ScatterModel::kCie, 30, eye::Pigmentation::kBrown, 5);
    for (const double x : {1.0, 30.0, 700.0}) {
        EXPECT_NEAR(ratio(view, {x, 0.7 * x}, psf), 1, 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Fields, CornerSource,
                         testing::Values(Figures{60, 0.719, 1.165, 0.579},
                                         Figures{90, 0.510, 1.441, 0.284}),
                         [](const auto& instance) {
                             return std::to_string(static_cast<int>(instance.param.fov_deg)) +
                                    "_deg";
                         });

}  // namespace
}  // namespace aureole
