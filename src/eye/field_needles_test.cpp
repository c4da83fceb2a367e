// Laws of needles that differ from place to place, on small rasters.
#include "aureole/eye/field_needles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/eye/field_psf.h"

namespace aureole::eye {
namespace {

FieldNeedlesOptions small() {
    FieldNeedlesOptions options;
    options.psf.aperture = {1024, 10};
    options.region_deg = 2;
    options.reach_deg = 1;
    return options;
}

// Regions of 2 deg: 5 by 3, one of them around the central pixel; from a region's middle to the
// next are 64 pixels.
View view_of() { return View::from_fov(257, 129, 8, Projection::kPerspective); }

wave::VaryingPsf plain(const Eye& eye, const View& view) {
    return {eye_psf(eye, wave::KernelGrid::full_reach(view), small().psf), {}, view};
}

wave::VaryingPsf varied(const Eye& eye = {}) {
    wave::VaryingPsf psf = plain(eye, view_of());
    vary_needles(psf, eye, small());
    return psf;
}

// Sum of |a - b| between two angles (pixels) from the light, over the sum of a there.
double difference(const Image& a, const Image& b, double from_px, double to_px) {
    double sum = 0;
    double energy = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const double rho = std::hypot(x - a.width() / 2, y - a.height() / 2);
            if (rho < from_px || rho > to_px) continue;
            sum += std::abs(static_cast<double>(a.at(x, y, 1) - b.at(x, y, 1)));
            energy += static_cast<double>(a.at(x, y, 1));
        }
    }
    return sum / energy;
}

TEST(FieldNeedles, OnTheAxisAreTheEyesOwn) {
    Eye eye;
    eye.pupil_diameter_mm = 6;  // with a halo, and with streaks
    const wave::Psf own = plain(eye, view_of()).base;
    const wave::Psf here = wave::psf_at(varied(eye), 128, 64);
    EXPECT_LT(difference(own.kernel, here.kernel, 1, 60), 0.03);  // a smaller raster
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(here.off_kernel_energy[c] / own.off_kernel_energy[c], 1, 2e-3);
    }
}

TEST(FieldNeedles, DifferFromRegionToRegionAndNotWithinOne) {
    const wave::VaryingPsf psf = varied();
    const Image here = wave::psf_at(psf, 128, 64).kernel;
    EXPECT_LT(difference(here, wave::psf_at(psf, 132, 68).kernel, 1, 60), 1e-4);
    for (const auto& [x, y] : {std::pair(64, 64), std::pair(128, 0), std::pair(192, 128)}) {
        const Image there = wave::psf_at(psf, x, y).kernel;
        EXPECT_GT(difference(here, there, 8, 16), 0.1) << x;
        // Beyond the reach they are the same.
        EXPECT_LT(difference(here, there, 34, 120), 2e-3) << x;
    }
}

// The middle of a kernel, `side` pixels wide.
Image middle_of(const Image& kernel, int side) {
    Image middle(side, side, 3);
    const int left = (kernel.width() - side) / 2;
    const int top = (kernel.height() - side) / 2;
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < side; ++y) {
            std::copy_n(kernel.row(top + y, c) + left, side, middle.row(y, c));
        }
    }
    return middle;
}

TEST(FieldNeedles, AreThoseOfTheMiddleOfTheRegion) {
    Eye eye;
    eye.streaks = 0;
    const wave::VaryingPsf psf = varied(eye);
    const Image truth = needles_at(eye, field_position(psf.view, 192.5, 64.5),
                                   wave::KernelGrid::square(psf.view, 49), small().psf);
    // But for the raster, which is smaller there.
    EXPECT_LT(difference(truth, middle_of(wave::psf_at(psf, 192, 64).kernel, 49), 1, 20), 0.03);
    EXPECT_GT(difference(truth, middle_of(wave::psf_at(psf, 64, 64).kernel, 49), 8, 16), 0.1);
}

// Correlation of two textures in a ring (deg).
double correlation(const Image& a, const Image& b, double pitch_deg, double from_deg,
                   double to_deg) {
    std::vector<std::pair<double, double>> values;
    double mean_a = 0;
    double mean_b = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const double angle_deg = pitch_deg * std::hypot(x - a.width() / 2, y - a.height() / 2);
            if (angle_deg < from_deg || angle_deg > to_deg) continue;
            const double flat = std::pow(angle_deg, 2.5);  // about what scatter falls with
            values.emplace_back(flat * static_cast<double>(a.at(x, y, 1)),
                                flat * static_cast<double>(b.at(x, y, 1)));
            mean_a += values.back().first;
            mean_b += values.back().second;
        }
    }
    mean_a /= static_cast<double>(values.size());
    mean_b /= static_cast<double>(values.size());
    double both = 0;
    double own_a = 0;
    double own_b = 0;
    for (const auto& [value_a, value_b] : values) {
        both += (value_a - mean_a) * (value_b - mean_b);
        own_a += (value_a - mean_a) * (value_a - mean_a);
        own_b += (value_b - mean_b) * (value_b - mean_b);
    }
    return both / std::sqrt(own_a * own_b);
}

TEST(FieldNeedles, ChangeSoonerFartherFromTheLight) {
    // Layers a depth z apart, seen from another angle f, are displaced by z f, which turns the
    // phase between them by 2 pi z f sin(a) / lambda at an angle a from the light.
    const View view = View::from_fov(1920, 1080, 60, Projection::kPerspective);
    const wave::KernelGrid grid = wave::KernelGrid::square(view, 121);
    const Image ahead = needles_at({}, {}, grid);
    const auto left = [&](double field_deg, double from_deg, double to_deg) {
        return correlation(ahead, needles_at({}, {field_deg, 0}, grid), view.pitch_deg, from_deg,
                           to_deg);
    };
    EXPECT_GT(left(0.1, 0.25, 0.5), 0.9);
    EXPECT_LT(left(0.1, 1, 2), 0.7);
    EXPECT_LT(left(1.6, 0.25, 0.5), 0.5);
}

TEST(FieldNeedles, KeepUnitEnergyAndTakeNothingBelowZero) {
    FieldPsfOptions streaks;
    streaks.psf = small().psf;
    streaks.spacing_deg = 6;
    wave::VaryingPsf with_streaks = eye_field_psf({}, view_of(), streaks);
    vary_needles(with_streaks, {}, small());
    const wave::VaryingPsf without = varied();
    for (const wave::VaryingPsf* psf : {&std::as_const(with_streaks), &without}) {
        for (const auto& [x, y] : {std::pair(0, 0), std::pair(100, 37), std::pair(256, 128)}) {
            const wave::Psf here = wave::psf_at(*psf, x, y);
            for (int c = 0; c < 3; ++c) {
                double sum = here.off_kernel_energy[static_cast<std::size_t>(c)];
                for (std::size_t i = 0; i < here.kernel.pixels(); ++i) {
                    ASSERT_GE(here.kernel.plane(c)[i], 0);
                    sum += static_cast<double>(here.kernel.plane(c)[i]);
                }
                EXPECT_NEAR(sum, 1, 1e-4);
            }
        }
    }
}

TEST(FieldNeedles, RefuseAnEyeWithoutThem) {
    Eye eye;
    wave::VaryingPsf psf = plain(eye, view_of());
    FieldNeedlesOptions options = small();
    options.region_deg = 1;
    EXPECT_THROW(vary_needles(psf, eye, options), InvalidArgument);
    options = small();
    options.psf.spectral.by_color = true;
    EXPECT_THROW(vary_needles(psf, eye, options), InvalidArgument);
    eye.corona_contrast = 0;
    EXPECT_THROW(vary_needles(psf, eye, small()), InvalidArgument);
    EXPECT_TRUE(psf.parts.empty());
}

}  // namespace
}  // namespace aureole::eye
