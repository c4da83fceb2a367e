#include "aureole/color/antialias.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "aureole/base/error.h"

namespace aureole::color {
namespace {

constexpr int kSide = 64;

Image drawn(const std::function<double(int x, int y)>& value) {
    Image image(kSide, kSide, 3);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) image.at(x, y, c) = static_cast<float>(value(x, y));
        }
    }
    return image;
}

Image antialiased(const Image& image) {
    Image out(image.width(), image.height(), image.channels());
    antialias_edges(image, out);
    return out;
}

double largest_difference(const Image& a, const Image& b) {
    double largest = 0;
    for (int c = 0; c < a.channels(); ++c) {
        for (std::size_t i = 0; i < a.pixels(); ++i) {
            largest = std::max(largest, std::abs(double{a.plane(c)[i]} - b.plane(c)[i]));
        }
    }
    return largest;
}

// Root mean square over the pixels that are at least `margin` from the border.
double rms_difference(const Image& a, const Image& b, int margin) {
    double sum = 0;
    int count = 0;
    for (int y = margin; y < kSide - margin; ++y) {
        for (int x = margin; x < kSide - margin; ++x) {
            sum += std::pow(double{a.at(x, y)} - b.at(x, y), 2);
            ++count;
        }
    }
    return std::sqrt(sum / count);
}

TEST(AntialiasEdges, LeavesSmoothShadingsStraightEdgesAndLonePixels) {
    const Image shading = drawn([](int x, int y) { return (x + y) / 128.0; });
    EXPECT_EQ(largest_difference(antialiased(shading), shading), 0);
    const Image column = drawn([](int x, int) { return x < 30 ? 0.1 : 0.9; });
    EXPECT_LT(largest_difference(antialiased(column), column), 1e-6);
    const Image row = drawn([](int, int y) { return y < 30 ? 0.1 : 0.9; });
    EXPECT_LT(largest_difference(antialiased(row), row), 1e-6);
    const Image star = drawn([](int x, int y) { return x == 20 && y == 33 ? 1.0 : 0.0; });
    EXPECT_LT(largest_difference(antialiased(star), star), 0.1);
    EXPECT_EQ(antialiased(star).at(20, 33), 1);
}

// The oracle is the area of the pixel that the half plane covers, by 32 x 32 samples.
TEST(AntialiasEdges, BringsJaggedEdgesNearerToTheAreaTheyCover) {
    for (const double degrees : {10.0, 20.0, 30.0, 45.0, 65.0, 80.0}) {
        const double nx = std::cos(degrees * 3.14159265 / 180);
        const double ny = std::sin(degrees * 3.14159265 / 180);
        const auto inside = [&](double x, double y) {
            return nx * (x - 32.3) + ny * (y - 31.6) > 0 ? 1.0 : 0.0;
        };
        const Image jagged = drawn([&](int x, int y) { return inside(x + 0.5, y + 0.5); });
        const Image truth = drawn([&](int x, int y) {
            double sum = 0;
            for (int j = 0; j < 32; ++j) {
                for (int i = 0; i < 32; ++i) {
                    sum += inside(x + (i + 0.5) / 32, y + (j + 0.5) / 32);
                }
            }
            return sum / (32 * 32);
        });
        EXPECT_LT(rms_difference(antialiased(jagged), truth, 4),
                  0.75 * rms_difference(jagged, truth, 4))
            << degrees;
    }
}

TEST(AntialiasEdges, RisesContinuouslyWithContrast) {
    Image before;
    for (int step = 0; step <= 200; ++step) {
        const double contrast = step / 200.0;
        const Image image = drawn([&](int x, int y) { return 3 * x + y > 120 ? contrast : 0.0; });
        const Image out = antialiased(image);
        if (step > 0) {
            EXPECT_LT(largest_difference(out, before), 4 / 200.0);
        }
        before = out;
    }
}

TEST(AntialiasEdges, StaysInRangeAndRefusesOtherShapes) {
    const Image checks = drawn([](int x, int y) { return ((x / 3 + y / 5) % 2 == 0) ? 1.0 : 0.0; });
    const Image out = antialiased(checks);
    for (std::size_t i = 0; i < out.pixels(); ++i) {
        EXPECT_GE(out.plane(0)[i], 0);
        EXPECT_LE(out.plane(0)[i], 1 + 1e-6F);
    }
    Image narrow(kSide - 1, kSide, 3);
    EXPECT_THROW(antialias_edges(checks, narrow), InvalidArgument);
    Image two(kSide, kSide, 2);
    EXPECT_THROW(antialias_edges(two, two), InvalidArgument);
}

}  // namespace
}  // namespace aureole::color
