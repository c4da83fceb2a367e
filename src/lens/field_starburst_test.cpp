// Pupils off the axis against the rays of vignetting.h and the overlap of holes, and the stars that
// they make.
#include "aureole/lens/field_starburst.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/lens/library.h"
#include "aureole/lens/vignetting.h"
#include "lens/test_lenses.h"

namespace aureole::lens {
namespace {

double area_mm2(const wave::Shape& shape) {
    double sum = 0;
    const auto& points = shape.outlines.front();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const wave::Point& a = points[i];
        const wave::Point& b = points[(i + 1) % points.size()];
        sum += 0.5 * (a.x_mm * b.y_mm - b.x_mm * a.y_mm);
    }
    return sum;
}

// Largest extent along a direction.
double width_mm(const wave::Shape& shape, double direction_deg) {
    const double c = std::cos(rad_from_deg(direction_deg));
    const double s = std::sin(rad_from_deg(direction_deg));
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (const wave::Point& p : shape.outlines.front()) {
        low = std::min(low, c * p.x_mm + s * p.y_mm);
        high = std::max(high, c * p.x_mm + s * p.y_mm);
    }
    return high - low;
}

TEST(PupilOutline, HasTheAreaOfTheBeamWhateverItsDirection) {
    for (const double f_number : {1.4, 4.0}) {
        const Lens lens(shipped_lens("biotar"), {.f_number = f_number});
        const double angles[] = {0, 8, 16};
        const auto fields = field_sweep(lens, angles, 587.56, 801);
        for (const FieldPoint& field : fields) {
            const double tangent = std::tan(rad_from_deg(field.angle_deg));
            for (const double turn_deg : {0.0, 70.0, 200.0}) {
                const auto outline =
                    pupil_outline(lens, Iris(), tangent * std::cos(rad_from_deg(turn_deg)),
                                  tangent * std::sin(rad_from_deg(turn_deg)));
                ASSERT_TRUE(outline);
                EXPECT_NEAR(area_mm2(*outline) / field.open_area_mm2, 1, 4e-3)
                    << f_number << " " << field.angle_deg << " " << turn_deg;
            }
        }
    }
}

TEST(PupilOutline, IsACatsEyeAcrossTheDirectionOfTheLight) {
    // Two holes, radii 5 and 5 mm, 20 mm apart: light 14 deg aside sees them 5 mm apart.
    const Lens lens(
        lens_of({{.thickness_mm = 20, .semi_aperture_mm = 5, .stop = true},
                 {.thickness_mm = 1, .semi_aperture_mm = 5},
                 {.radius_mm = 3000, .thickness_mm = 1, .index = 1.5, .semi_aperture_mm = 90},
                 {.radius_mm = -3000, .semi_aperture_mm = 90}}));
    const auto outline = pupil_outline(lens, Iris(), 0.25, 0);
    ASSERT_TRUE(outline);
    EXPECT_NEAR(width_mm(*outline, 0), 5 * std::cos(std::atan(0.25)), 0.02);
    EXPECT_NEAR(width_mm(*outline, 90), 2 * std::sqrt(25 - 6.25), 0.02);
    // 10 mm apart they do not overlap any more.
    EXPECT_FALSE(pupil_outline(lens, Iris(), 0.51, 0));
}

TEST(PupilOutline, KeepsTheBladesOfTheIris) {
    const Lens lens(shipped_lens("heliar"), {.f_number = 11});
    const auto outline = pupil_outline(lens, Iris(IrisShape{.blades = 6}), 0, 0);
    ASSERT_TRUE(outline);
    const double pupil_mm = lens.efl_mm() / lens.f_number();
    const Iris hexagon(IrisShape{.blades = 6});
    // Aberrations of the pupil, which the round stop's f-number takes in.
    EXPECT_NEAR(width_mm(*outline, 0) / (pupil_mm * hexagon.outer_radius()), 1, 0.01);
    EXPECT_NEAR(width_mm(*outline, 30) / (pupil_mm * hexagon.apothem()), 1, 0.01);
    Image white(4, 4, 1);
    std::fill_n(white.plane(0), white.pixels(), 1.0F);
    EXPECT_THROW(pupil_outline(lens, Iris(white.view()), 0, 0), InvalidArgument);
}

FieldStarburstOptions small() {
    FieldStarburstOptions options;
    options.psf.samples = 512;
    options.psf.bands = 16;
    options.reach_deg = 2;
    options.spacing_deg = 15;
    return options;
}

wave::VaryingPsf star(const View& view) {
    const Lens lens(shipped_lens("biotar"), {.f_number = 1.4});
    return field_starburst(lens, Iris(), lens.efl_mm() / lens.f_number(), view, small());
}

TEST(FieldStarburst, HasUnitEnergyEverywhere) {
    const wave::VaryingPsf psf = star(View::from_fov(81, 61, 30, Projection::kPerspective));
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(40, 30), std::pair(57, 12)}) {
        const wave::Psf own = wave::psf_at(psf, x, y);
        for (int c = 0; c < 3; ++c) {
            double sum = own.off_kernel_energy[static_cast<std::size_t>(c)];
            for (std::size_t i = 0; i < own.kernel.pixels(); ++i) {
                sum += static_cast<double>(own.kernel.plane(c)[i]);
            }
            EXPECT_NEAR(sum, 1, 1e-4);
        }
    }
}

TEST(FieldStarburst, ErrsLessWithMoreNodes) {
    const View view = View::from_fov(81, 61, 30, Projection::kPerspective);
    const Lens lens(shipped_lens("biotar"), {.f_number = 1.4});
    const double pupil_mm = lens.efl_mm() / lens.f_number();
    const auto error = [&](double spacing_deg) {
        FieldStarburstOptions options = small();
        options.spacing_deg = spacing_deg;
        const wave::VaryingPsf psf = field_starburst(lens, Iris(), pupil_mm, view, options);
        return field_starburst_error(lens, Iris(), pupil_mm, psf, options, 12);
    };
    const wave::FieldError coarse = error(15);
    const wave::FieldError fine = error(4);
    EXPECT_EQ(coarse.positions, 12);
    EXPECT_GT(coarse.l1, 0.01);
    EXPECT_LT(fine.l1, 0.6 * coarse.l1);
    EXPECT_GE(fine.worst, fine.mean);
    EXPECT_THROW(field_starburst_error(lens, Iris(), pupil_mm, {}, small(), 0), InvalidArgument);
}

// Edges scatter across themselves: the two long sides of a cat's eye send light along the radius of
// the picture, its corners next to none across it.
TEST(FieldStarburst, SpreadsAlongTheRadiusOffTheAxis) {
    const wave::VaryingPsf psf = star(View::from_fov(81, 61, 30, Projection::kPerspective));
    const auto along_over_across = [&](int x, int y) {
        const Image kernel = wave::psf_at(psf, x, y).kernel;
        double along = 0;
        double across = 0;
        for (int d = 2; d <= 4; ++d) {
            along += static_cast<double>(kernel.at(kernel.width() / 2 + d, kernel.height() / 2, 1));
            across +=
                static_cast<double>(kernel.at(kernel.width() / 2, kernel.height() / 2 + d, 1));
        }
        return along / across;
    };
    EXPECT_NEAR(along_over_across(40, 30), 1, 0.15);  // of a raster as small as this
    EXPECT_GT(along_over_across(80, 30), 3);
}

TEST(FieldStarburst, RefusesWhatNoLensHas) {
    FieldStarburstOptions options = small();
    options.spacing_deg = 0.1;
    const Lens lens(shipped_lens("biotar"));
    EXPECT_THROW(field_starburst(lens, Iris(), 10,
                                 View::from_fov(81, 61, 30, Projection::kPerspective), options),
                 InvalidArgument);
}

}  // namespace
}  // namespace aureole::lens
