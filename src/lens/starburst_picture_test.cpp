// The star of irises and glasses that are given as pictures, and how starburst_psf() behaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/lens/starburst.h"
#include "lens/starburst_test_support.h"

namespace aureole::lens {
namespace {

// A line of the given width through the middle of a white picture, along `direction_deg` as seen
// (counter-clockwise, top of the picture up).
Image scratched(int size, double width_px, double direction_deg, float value) {
    Image picture(size, size, 1);
    const double s = std::sin(rad_from_deg(direction_deg));
    const double c = std::cos(rad_from_deg(direction_deg));
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const double dx = x + 0.5 - size / 2.0;
            const double dy = size / 2.0 - y - 0.5;
            picture.at(x, y) = std::abs(-s * dx + c * dy) < width_px / 2 ? value : 1.0F;
        }
    }
    return picture;
}

TEST(Starburst, ScratchesSpreadLightAcrossThemselves) {
    constexpr double kDiameterMm = 6;
    const auto grid = grid_of(301, 4, kDiameterMm);
    const Occluder occluder(scratched(1024, 6, 30, 0).view(), 8);
    const auto clean = starburst_psf(Iris(), kDiameterMm, grid, kSmall);
    const auto dirty = starburst_psf(Iris(), kDiameterMm, grid, kSmall, &occluder);
    EXPECT_LT(energy_error(dirty), 1e-6);
    EXPECT_EQ(spikes(by_direction(clean, 15, 45, 180), 2).size(), 0u);
    const auto found = spikes(by_direction(dirty, 15, 45, 180), 2);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0], 120, 1);
    EXPECT_NEAR(found[1], 300, 1);
}

// A scratch that blocks a share b of the light takes 1 - b of the amplitude from the axis; so much
// is left of the intensity there when the light that passes is made 1 again.
TEST(Starburst, ScratchesTakeWhatTheyBlock) {
    constexpr double kDiameterMm = 6;
    const wave::KernelGrid axis = grid_of(3, 0.02, kDiameterMm);
    constexpr StarburstOptions kOptions{.samples = 2048, .bands = 1};
    const Occluder occluder(scratched(1024, 48, 90, 0).view(), 8);
    const auto clean = starburst_psf(Iris(), kDiameterMm, axis, kOptions);
    const auto dirty = starburst_psf(Iris(), kDiameterMm, axis, kOptions, &occluder);
    // A strip of 48 of the 768 pixels across the pupil.
    const double a = 48.0 / 768;
    const double blocked = 2 / kPi * (a * std::sqrt(1 - a * a) + std::asin(a));
    // Between pixels transmission is interpolated: of each edge, 1 pixel wide, 1/6 of a pixel
    // passes as amplitude but not as energy.
    const double lost = blocked * (2.0 / 6) / 48;
    EXPECT_NEAR(static_cast<double>(dirty.kernel.at(1, 1, 1)) /
                    static_cast<double>(clean.kernel.at(1, 1, 1)),
                (1 - blocked) * (1 - blocked) / (1 - blocked - lost), 1e-3);
}

TEST(Starburst, APictureOfADiscIsARoundIris) {
    constexpr int kSize = 1024;
    Image picture(kSize, kSize, 1);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const double r = std::hypot(x + 0.5 - kSize / 2.0, y + 0.5 - kSize / 2.0);
            picture.at(x, y) = static_cast<float>(std::clamp(400.5 - r, 0.0, 1.0));
        }
    }
    constexpr double kDiameterMm = 4;
    const auto grid = grid_of(201, 0.25, kDiameterMm);
    const auto drawn = starburst_psf(Iris(picture.view()), kDiameterMm, grid, kOneBand);
    EXPECT_LT(energy_error(drawn), 1e-6);
    for (const double radius : {2.0, 6.0, 20.0}) {
        EXPECT_NEAR(encircled(drawn, 1, 4 * radius), 1 - airy_outside(radius), 2e-3) << radius;
    }
}

// A slit that leans by 30 deg, seen through the camera, throws its light across.
TEST(Starburst, APictureIsSeenUpright) {
    Image picture = scratched(512, 40, 30, 0);
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        picture.plane(0)[i] = 1 - picture.plane(0)[i];  // the slit is open, all else is not
    }
    const auto psf = starburst_psf(Iris(picture.view()), 2, grid_of(201, 3, 2), kSmall);
    const auto found = spikes(by_direction(psf, 20, 60, 180), 6);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0], 120, 1);
}

// Far beyond the raster a spike of a straight blade is as wide as near the axis: lambda / edge to
// either side, here 2 pixels. With dirt on the glass, too.
TEST(Starburst, SpikesKeepTheirWidth) {
    constexpr double kDiameterMm = 3;
    const Iris iris({.blades = 4, .rotation_deg = 45});
    const auto grid = grid_of(1001, 0.5, kDiameterMm);
    const Occluder occluder(scratched(1024, 4, 30, 0).view(), 4);
    for (const Occluder* dirt : {static_cast<const Occluder*>(nullptr), &occluder}) {
        const auto psf = starburst_psf(iris, kDiameterMm, grid, kOneBand, dirt);
        const auto column = [&](int x, int reach) {
            double total = 0;
            for (int y = -reach; y <= reach; ++y) {
                total += static_cast<double>(psf.kernel.at(500 + x, 500 + y, 1));
            }
            return total;
        };
        // Edges of sqrt(pi) / 2 of the diameter: the first zero across the spike is 2.26 pixels
        // away.
        for (const int x : {40, 200, 480}) {
            double inner = 0;
            double outer = 0;
            for (int i = 0; i < 10; ++i) {
                inner += column(x + i, 2);
                outer += column(x + i, 20);
            }
            // Of sinc^2, .90 within the first zeros.
            EXPECT_NEAR(inner / outer, 0.92, 0.04) << x << (dirt != nullptr ? " dirty" : "");
        }
    }
}

// ---- Behaviour ----

TEST(Starburst, DoesNotDependOnThreads) {
    const Iris iris({.blades = 6, .rotation_deg = 3});
    const Occluder occluder(scratched(256, 3, 20, 0.5F).view(), 8);
    const wave::KernelGrid grid{401, 301, 0.02, Projection::kPerspective};
    const auto many = starburst_psf(iris, 6, grid, kSmall, &occluder);
    const ThreadLimit one(1);
    const auto single = starburst_psf(iris, 6, grid, kSmall, &occluder);
    EXPECT_EQ(std::memcmp(many.kernel.plane(0), single.kernel.plane(0),
                          3 * many.kernel.pixels() * sizeof(float)),
              0);
    EXPECT_EQ(many.off_kernel_energy, single.off_kernel_energy);
}

TEST(Starburst, LooksTheSameAfterAHalfTurn) {
    const auto psf = starburst_psf(Iris({.blades = 5, .rotation_deg = 3}), 6,
                                   {201, 151, 0.02, Projection::kPerspective}, kSmall);
    for (int y = 0; y < 151; ++y) {
        for (int x = 0; x < 201; ++x) {
            ASSERT_EQ(psf.kernel.at(x, y, 0), psf.kernel.at(200 - x, 150 - y, 0));
        }
    }
}

struct Counter : Progress {
    void report(std::string_view, double fraction) override {
        EXPECT_GE(fraction, last);
        last = fraction;
    }
    bool cancelled() const override { return last >= stop_at; }
    double last = 0;
    double stop_at = 2;
};

TEST(Starburst, ReportsAndStops) {
    const wave::KernelGrid grid{31, 31, 0.02, Projection::kPerspective};
    Counter counter;
    starburst_psf(Iris(), 5, grid, {.samples = 256}, nullptr, &counter);
    EXPECT_EQ(counter.last, 1);
    Counter stopping;
    stopping.stop_at = 0.3;
    EXPECT_THROW(starburst_psf(Iris(), 5, grid, {.samples = 256}, nullptr, &stopping), Cancelled);
}

TEST(Starburst, SaysWhatIsWrong) {
    const wave::KernelGrid grid{31, 31, 0.02, Projection::kPerspective};
    const auto with = [&](const StarburstOptions& options) {
        return starburst_psf(Iris(), 5, grid, options);
    };
    EXPECT_THROW(with({.samples = 128}), InvalidArgument);
    EXPECT_THROW(with({.samples = 1023}), InvalidArgument);
    EXPECT_THROW(with({.samples = 1034}), InvalidArgument);  // 2 * 11 * 47
    EXPECT_THROW(with({.samples = 32768}), InvalidArgument);
    EXPECT_THROW(with({.samples = 256, .bands = -1}), InvalidArgument);
    EXPECT_THROW(with({.samples = 256, .bands = 5000}), InvalidArgument);
    for (const double diameter_mm : {0.0, -1.0, std::nan("")}) {
        EXPECT_THROW(starburst_psf(Iris(), diameter_mm, grid), InvalidArgument);
    }
    EXPECT_THROW(starburst_psf(Iris(), 5, {30, 31, 0.02, Projection::kPerspective}),
                 InvalidArgument);
    EXPECT_THROW(starburst_psf(Iris(), 5, {31, 31, 0, Projection::kPerspective}), InvalidArgument);
    // Open in a corner that is not before the pupil.
    Image picture(64, 64, 1);
    picture.at(0, 0) = 1;
    const Occluder opaque(picture.view(), 10);
    EXPECT_THROW(starburst_psf(Iris(), 5, grid, {.samples = 256}, &opaque), InvalidArgument);
}

}  // namespace
}  // namespace aureole::lens
