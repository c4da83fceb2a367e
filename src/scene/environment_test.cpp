#include "aureole/scene/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/color/rgb.h"
#include "scene/environments.h"

namespace aureole::scene {
namespace {

EnvironmentOptions sized(int width) {
    EnvironmentOptions options;
    options.width = width;
    options.height = width / 2;
    return options;
}

double luminance_at(const Image& rgb, int x, int y) {
    return color::luminance({rgb.at(x, y, 0), rgb.at(x, y, 1), rgb.at(x, y, 2)});
}

double solid_angle_sr(const Image& rgb, int y) {
    return 2 * kPi / rgb.width() * (kPi / rgb.height()) * std::sin(kPi * (y + 0.5) / rgb.height());
}

// Mean luminance over the sphere, pixels counting as `most` at most.
double mean_of(const Image& rgb, double most) {
    double sum = 0;
    double weights = 0;
    for (int y = 0; y < rgb.height(); ++y) {
        const double weight = std::sin(kPi * (y + 0.5) / rgb.height());
        for (int x = 0; x < rgb.width(); ++x) {
            sum += weight * std::min(most, luminance_at(rgb, x, y));
        }
        weights += weight * rgb.width();
    }
    return sum / weights;
}

TEST(Environments, AreListedWithDescriptions) {
    std::string names;
    for (const EnvironmentInfo& info : list_environments()) {
        names += std::string(info.name) + " ";
        EXPECT_LT(info.description.size(), 90U) << "one line of help";
    }
    EXPECT_EQ(names, "studio interior overcast sunny ");
}

TEST(Environments, AreFiniteAndNotNegative) {
    for (const EnvironmentInfo& info : list_environments()) {
        for (const int width : {2, 96}) {
            const Environment made = make_environment(info.name, sized(width));
            ASSERT_EQ(made.rgb.width(), width);
            ASSERT_EQ(made.rgb.height(), width / 2);
            EXPECT_GT(made.adaptation_cd_m2, 0);
            EXPECT_GT(made.display_white_cd_m2, 0);
            for (std::size_t i = 0; i < 3 * made.rgb.pixels(); ++i) {
                const float v = made.rgb.plane(0)[i];
                ASSERT_TRUE(std::isfinite(v) && v >= 0) << info.name << " " << i << ": " << v;
            }
        }
    }
}

TEST(Environments, DoNotDependOnThreadsButOnSeeds) {
    for (const EnvironmentInfo& info : list_environments()) {
        EnvironmentOptions options = sized(64);
        const Environment many = make_environment(info.name, options);
        options.seed = 2;
        const Environment other = make_environment(info.name, options);
        const ThreadLimit limit(1);
        const Environment one = make_environment(info.name, sized(64));
        bool differ = false;
        for (std::size_t i = 0; i < 3 * many.rgb.pixels(); ++i) {
            ASSERT_EQ(many.rgb.plane(0)[i], one.rgb.plane(0)[i]) << info.name;
            differ = differ || many.rgb.plane(0)[i] != other.rgb.plane(0)[i];
        }
        EXPECT_TRUE(differ) << info.name;
    }
}

TEST(Environments, AreTheSameWorldAtEverySize) {
    for (const EnvironmentInfo& info : list_environments()) {
        const double small = mean_of(make_environment(info.name, sized(128)).rgb, 5e4);
        const double large = mean_of(make_environment(info.name, sized(384)).rgb, 5e4);
        EXPECT_NEAR(small / large, 1, 0.04) << info.name;
    }
}

// Rows end where they begin.
TEST(Environments, HaveNoSeam) {
    for (const EnvironmentInfo& info : list_environments()) {
        const Image rgb = make_environment(info.name, sized(512)).rgb;
        double seam = 0;
        double inside = 0;
        for (int y = 0; y < 256; ++y) {
            const auto step = [&](int a, int b) {
                return std::abs(
                    std::log((luminance_at(rgb, a, y) + 1) / (luminance_at(rgb, b, y) + 1)));
            };
            seam += step(511, 0);
            for (int x = 100; x < 420; ++x) inside += step(x, x + 1) / 320;
        }
        EXPECT_LT(seam, 2.5 * inside) << info.name;
    }
}

TEST(Environments, RefuseWhatTheyCannotDo) {
    EXPECT_THROW(make_environment("moon"), InvalidArgument);
    EXPECT_THROW(make_environment("studio", {0, 4, 1}), InvalidArgument);
    EXPECT_THROW(make_environment("studio", {4, 40000, 1}), InvalidArgument);
}

TEST(Sunny, HasTheRealSunsEnergyAtEverySize) {
    const double exact = 1.6e9 * 2 * kPi * (1 - std::cos(rad_from_deg(0.265)));
    for (const int width : {32, 256}) {
        const Image rgb = make_environment("sunny", sized(width)).rgb;
        double sum = 0;
        for (int y = 0; y < rgb.height(); ++y) {
            for (int x = 0; x < rgb.width(); ++x) {
                const double v = luminance_at(rgb, x, y);
                if (v > 1e6) sum += (v - 3e4) * solid_angle_sr(rgb, y);
            }
        }
        EXPECT_NEAR(sum / exact, 1, 0.01) << width;
    }
}

TEST(Sunny, HasTheRangeOfDaylight) {
    const Image rgb = make_environment("sunny").rgb;
    double brightest = 0;
    int column = 0;
    int row = 0;
    for (int y = 0; y < rgb.height(); ++y) {
        for (int x = 0; x < rgb.width(); ++x) {
            const double v = luminance_at(rgb, x, y);
            if (v <= brightest) continue;
            brightest = v;
            column = x;
            row = y;
        }
    }
    EXPECT_NEAR(brightest / 1.6e9, 1, 0.03);
    EXPECT_GT(brightest / mean_of(rgb, 1e12), 1e5);
    // 38 deg to the right of the middle, 41 deg up.
    EXPECT_NEAR(column, 2048 * (0.5 + 38.0 / 360), 3);
    EXPECT_NEAR(row, 1024 * (0.5 - 41.0 / 180), 3);
}

// Moon & Spencer: three times as bright in the zenith as at the horizon.
TEST(Overcast, FollowsTheCieSky) {
    const Image rgb = make_environment("overcast", sized(256)).rgb;
    const auto ring = [&](int y) {
        double sum = 0;
        for (int x = 0; x < 256; ++x) sum += luminance_at(rgb, x, y) / 256;
        return sum;
    };
    EXPECT_NEAR(ring(1) / 7000, 1, 0.15);
    for (const int y : {30, 60, 90}) {
        const double sine = std::cos(kPi * (y + 0.5) / 128);
        EXPECT_NEAR(ring(y) / (7000 * (1 + 2 * sine) / 3), 1, 0.15) << y;
        if (y == 30) break;  // lower down, hills and land
    }
    EXPECT_LT(ring(110), 2500) << "the field is darker than the sky";
}

TEST(Studio, HasBrightLightsInADarkRoom) {
    const Image rgb = make_environment("studio", sized(512)).rgb;
    int bright = 0;
    int dark = 0;
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 512; ++x) {
            bright += luminance_at(rgb, x, y) > 2000 ? 1 : 0;
            dark += luminance_at(rgb, x, y) < 200 ? 1 : 0;
        }
    }
    EXPECT_GT(bright, 512 * 256 / 100);
    EXPECT_GT(dark, 512 * 256 / 2);
}

}  // namespace
}  // namespace aureole::scene
