// Streak images of a camera, from pictures of its iris and of what lies before its lens.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "aureole/color/spectrum.h"
#include "program.h"

namespace aureole::cli {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSize = 401;
const std::string kPsf =
    "psf -o star.exr --observer camera --lens heliar --f-number 8 --fov 20 --width 1920 --size 401";

class Star : public CliTest {
  protected:
    Image star(const std::string& options) const {
        const Outcome outcome = run(kPsf + options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return read("star.exr").image();
    }
};

// White within a polygon of straight sides, a corner to the right.
Image polygon(int size, int corners) {
    Image picture(size, size, 1);
    const double apothem = 0.45 * size * std::cos(kPi / corners);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const double u = x + 0.5 - 0.5 * size;
            const double v = 0.5 * size - y - 0.5;
            double beyond = -size;
            for (int k = 0; k < corners; ++k) {
                const double normal = 2 * kPi * (k + 0.5) / corners;
                beyond = std::max(beyond, u * std::cos(normal) + v * std::sin(normal) - apothem);
            }
            picture.at(x, y) = static_cast<float>(std::clamp(0.5 - beyond, 0.0, 1.0));
        }
    }
    return picture;
}

// Directions (deg) with more than twice the mean energy, between 40 and 180 pixels away.
std::vector<double> arms(const Image& kernel) {
    constexpr int kBins = 180;
    std::array<double, kBins> energy = {};
    double mean = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const double dx = x - kSize / 2;
            const double dy = kSize / 2 - y;
            const double r = std::hypot(dx, dy);
            if (r < 40 || r > 180) continue;
            const double turn = std::atan2(dy, dx) / (2 * kPi);
            const auto bin = static_cast<std::size_t>((turn - std::floor(turn)) * kBins) % kBins;
            energy[bin] += double{kernel.at(x, y, 1)};
            mean += double{kernel.at(x, y, 1)} / kBins;
        }
    }
    std::vector<double> found;
    for (std::size_t i = 0; i < kBins; ++i) {
        const double before = energy[(i + kBins - 1) % kBins];
        const double after = energy[(i + 1) % kBins];
        if (energy[i] > 2 * mean && energy[i] >= before && energy[i] > after) {
            found.push_back(360.0 / kBins * (static_cast<double>(i) + 0.5));
        }
    }
    return found;
}

// Each blade sends light to both sides of its edge: n arms if blades face each other, else 2 n.
TEST_F(Star, PicturesOfDiaphragmsHaveTheirArms) {
    for (const auto& [blades, expected] : {std::pair{6, 6}, {5, 10}}) {
        write("iris.exr", polygon(1024, blades));
        const std::vector<double> found = arms(star(" --iris iris.exr"));
        ASSERT_EQ(found.size(), static_cast<std::size_t>(expected)) << blades;
        const double step = 360.0 / expected;
        const double first = std::fmod(180.0 / blades, step);
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_NEAR(found[i], first + step * static_cast<double>(i), 2) << blades;
        }
    }
}

TEST_F(Star, AScratchThrowsLightAcrossItself) {
    constexpr double kLeanDeg = 20;  // counter-clockwise from the right
    Image glass(1024, 1024, 1);
    const double c = std::cos(kPi * kLeanDeg / 180);
    const double s = std::sin(kPi * kLeanDeg / 180);
    for (int y = 0; y < 1024; ++y) {
        for (int x = 0; x < 1024; ++x) {
            const double across = s * (x - 511.5) + c * (y - 511.5);
            glass.at(x, y) = std::abs(across) < 2 ? 0.0F : 1.0F;
        }
    }
    write("glass.exr", glass);
    const std::vector<double> found = arms(star(" --occluder glass.exr"));
    ASSERT_EQ(found.size(), 2U);
    EXPECT_NEAR(found[0], kLeanDeg + 90, 2);
    EXPECT_NEAR(found[1], kLeanDeg + 270, 2);
}

// A regular grid, the star filter: order 1 of each colour at its mean wavelength over the period,
// along both axes.
TEST_F(Star, AGridMakesOrders) {
    constexpr int kPixels = 2048;
    constexpr int kPeriod = 16;
    Image glass(kPixels, kPixels, 1);
    for (int y = 0; y < kPixels; ++y) {
        for (int x = 0; x < kPixels; ++x) {
            glass.at(x, y) = x % kPeriod < 2 || y % kPeriod < 2 ? 0.0F : 1.0F;
        }
    }
    write("glass.exr", glass);
    const Image kernel = star(" --occluder glass.exr");
    const double pitch_rad =
        double{read("star.exr").float_attribute("aureole:pitch_deg").value_or(0)} * kPi / 180;
    // The picture spans the front element.
    const auto lens = report("lens show heliar");
    const double front_mm = 2 * lens["table"][0]["semi_aperture_mm"].get<double>();
    const double period_mm = front_mm * kPeriod / kPixels;
    const auto bands = color::sample_spectrum(64);
    for (int c = 0; c < 3; ++c) {
        double mean_nm = 0;
        for (const auto& band : bands) {
            mean_nm += band.rgb[static_cast<std::size_t>(c)] * band.wavelength_nm;
        }
        const double expected = mean_nm * 1e-6 / period_mm / pitch_rad;
        ASSERT_GT(expected, 6);
        // From the shortest wavelength of order 1 to that of order 2.
        const double shortest = 380 * 1e-6 / period_mm / pitch_rad;
        std::array<double, 2> energy = {};
        std::array<double, 2> place = {};
        for (int r = static_cast<int>(shortest) - 1; r < 2 * shortest - 1; ++r) {
            for (int side = -2; side <= 2; ++side) {
                const double right = kernel.at(kSize / 2 + r, kSize / 2 + side, c);
                const double up = kernel.at(kSize / 2 + side, kSize / 2 - r, c);
                energy[0] += right;
                place[0] += right * r;
                energy[1] += up;
                place[1] += up * r;
            }
        }
        EXPECT_GT(energy[0], 0.01) << c;
        EXPECT_NEAR(place[0] / energy[0], expected, 1) << "right, channel " << c;
        EXPECT_NEAR(place[1] / energy[1], expected, 1) << "up, channel " << c;
    }
}

}  // namespace
}  // namespace aureole::cli
