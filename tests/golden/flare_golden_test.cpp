// Flares of three lenses with the light at three angles, as they were looked at.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "aureole/base/units.h"
#include "aureole/lens/flare.h"
#include "aureole/lens/library.h"
#include "golden.h"

namespace aureole {
namespace {

struct Case {
    const char* name;
    const char* lens;
    const char* position;
    double f_number;
    double field_deg;  // of the picture
    double angle_deg;  // of the light, towards the upper left
};

Image flare_of(const Case& test, lens::GhostMethod method) {
    const View view = View::from_fov(240, 160, test.field_deg, Projection::kPerspective);
    const lens::Lens lens(lens::shipped_lens(test.lens),
                          {.position = test.position, .f_number = test.f_number});
    lens::FlareOptions options;
    options.method = method;
    options.wavelengths = 4;
    options.rays_per_side = 64;
    lens::Flare flare(lens, lens::Iris({.blades = 7, .rotation_deg = 10}), view, options);
    const double radius = view.focal_length_px() * std::tan(rad_from_deg(test.angle_deg));
    const sources::Light light = sources::light_at(view, view.axis_x - 0.8 * radius,
                                                   view.axis_y - 0.6 * radius, {1e6F, 1e6F, 1e6F});
    Image picture(view.width, view.height, 3);
    flare.render({&light, 1}, picture);
    return picture;
}

class FlareGolden : public testing::TestWithParam<Case> {};

TEST_P(FlareGolden, Traced) {
    EXPECT_TRUE(golden::matches(fmt::format("{}-traced", GetParam().name),
                                flare_of(GetParam(), lens::GhostMethod::kTraced),
                                {.outliers = 0.01}));
}

TEST_P(FlareGolden, Matrix) {
    EXPECT_TRUE(golden::matches(fmt::format("{}-matrix", GetParam().name),
                                flare_of(GetParam(), lens::GhostMethod::kMatrix),
                                {.outliers = 0.002}));
}

INSTANTIATE_TEST_SUITE_P(Lenses, FlareGolden,
                         testing::Values(Case{"heliar-03", "heliar", "", 8, 20, 3},
                                         Case{"heliar-08", "heliar", "", 8, 20, 8},
                                         Case{"heliar-14", "heliar", "", 8, 20, 14},
                                         Case{"nikon-28-75-05", "nikon-28-75", "", 5.6, 65, 5},
                                         Case{"nikon-28-75-15", "nikon-28-75", "", 5.6, 65, 15},
                                         Case{"nikon-28-75-30", "nikon-28-75", "", 5.6, 65, 30},
                                         Case{"canon-70-200-02", "canon-70-200", "wide", 4, 28, 2},
                                         Case{"canon-70-200-08", "canon-70-200", "wide", 4, 28, 8},
                                         Case{"canon-70-200-16", "canon-70-200", "wide", 4, 28,
                                              16}),
                         [](const testing::TestParamInfo<Case>& param) {
                             std::string name = param.param.name;
                             for (char& c : name) {
                                 if (c == '-') c = '_';
                             }
                             return name;
                         });

}  // namespace
}  // namespace aureole
