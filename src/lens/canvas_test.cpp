#include "lens/canvas.h"

#include <gtest/gtest.h>

#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"

namespace aureole::lens {
namespace {

struct Size {
    int width;
    int height;
};
constexpr Size kSizes[] = {{64, 48}, {61, 37}, {255, 129}, {640, 9}};

// Calls value(x, y, plane) for every pixel of a level, margins included.
template <class Value>
void fill(Canvas& canvas, int l, const Value& value) {
    canvas.mark_used(l);
    const CanvasLevel& level = canvas.level(l);
    for (int p = 0; p < 3; ++p) {
        for (int y = -level.margin; y < level.height + level.margin; ++y) {
            for (int x = -level.margin; x < level.width + level.margin; ++x) {
                level.planes[p][y * level.stride + x] = static_cast<float>(value(x, y, p));
            }
        }
    }
}

double sum(const Image& image, int plane) {
    double total = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        total += static_cast<double>(image.plane(plane)[i]);
    }
    return total;
}

TEST(Canvas, AConstantOnAnyLevelIsAConstant) {
    for (const Size size : kSizes) {
        Canvas canvas(size.width, size.height);
        for (int l = 0; l < canvas.levels(); ++l) {
            canvas.clear();
            fill(canvas, l, [](int, int, int p) { return 1 + p; });
            Image out(size.width, size.height, 3);
            canvas.add_to(out);
            for (int p = 0; p < 3; ++p) {
                for (std::size_t i = 0; i < out.pixels(); ++i) {
                    ASSERT_FLOAT_EQ(out.plane(p)[i], static_cast<float>(1 + p))
                        << size.width << " level " << l << " pixel " << i;
                }
            }
        }
    }
}

TEST(Canvas, ARampStaysARamp) {
    for (const Size size : kSizes) {
        Canvas canvas(size.width, size.height);
        for (int l = 0; l < canvas.levels(); ++l) {
            canvas.clear();
            const double scale = 1 << l;
            // The value of a pixel is that at its centre.
            fill(canvas, l, [&](int x, int y, int p) {
                return (p + 1) * (x + 0.5) * scale - 2 * (y + 0.5) * scale;
            });
            Image out(size.width, size.height, 3);
            canvas.add_to(out);
            for (int y = 0; y < size.height; ++y) {
                for (int x = 0; x < size.width; ++x) {
                    ASSERT_NEAR(out.at(x, y, 2), 3 * (x + 0.5) - 2 * (y + 0.5), 2e-3)
                        << size.width << " level " << l << " at " << x << ", " << y;
                }
            }
        }
    }
}

TEST(Canvas, APixelKeepsItsSumAndItsCentre) {
    Canvas canvas(257, 131);
    for (int l = 0; l < 4; ++l) {
        canvas.clear();
        const CanvasLevel& level = canvas.level(l);
        const int x = level.width / 2;
        const int y = level.height / 2;
        level.mark_used(y, x, x + 1);
        level.planes[1][y * level.stride + x] = 3;
        Image out(257, 131, 3);
        canvas.add_to(out);
        const double scale = 1 << l;
        EXPECT_NEAR(sum(out, 1) / (3 * scale * scale), 1, 1e-6) << l;
        EXPECT_EQ(sum(out, 0), 0);
        double mean_x = 0;
        double mean_y = 0;
        for (int j = 0; j < 131; ++j) {
            for (int i = 0; i < 257; ++i) {
                mean_x += static_cast<double>(out.at(i, j, 1)) * (i + 0.5);
                mean_y += static_cast<double>(out.at(i, j, 1)) * (j + 0.5);
            }
        }
        EXPECT_NEAR(mean_x / sum(out, 1), (x + 0.5) * scale, 1e-4);
        EXPECT_NEAR(mean_y / sum(out, 1), (y + 0.5) * scale, 1e-4);
    }
}

// Oracle: weights of Chaikin's subdivision, level by level, on whole planes.
std::vector<double> refine(const std::vector<double>& coarse, int width, int height, int fine_width,
                           int fine_height) {
    const int m = Canvas::kMargin;
    const auto at = [&](int x, int y) {
        const bool there = x >= -m && x < width + m && y >= -m && y < height + m;
        return there ? coarse[static_cast<std::size_t>((y + m) * (width + 2 * m) + x + m)] : 0.0;
    };
    std::vector<double> fine;
    for (int y = -m; y < fine_height + m; ++y) {
        for (int x = -m; x < fine_width + m; ++x) {
            const int cx = x >> 1;
            const int cy = y >> 1;
            const int nx = (x & 1) != 0 ? cx + 1 : cx - 1;
            const int ny = (y & 1) != 0 ? cy + 1 : cy - 1;
            fine.push_back(0.5625 * at(cx, cy) + 0.1875 * (at(nx, cy) + at(cx, ny)) +
                           0.0625 * at(nx, ny));
        }
    }
    return fine;
}

void draw_noise(Canvas& canvas, std::uint64_t seed) {
    Random random(seed);
    for (int l = 0; l < canvas.levels(); ++l) {
        const CanvasLevel& level = canvas.level(l);
        for (int y = -level.margin; y < level.height + level.margin; ++y) {
            const int begin = static_cast<int>(random.uniform(-level.margin, level.width));
            const int end = begin + static_cast<int>(random.uniform(1, 3));
            level.mark_used(y, begin, end);
            for (int x = begin; x < end; ++x) {
                for (float* plane : level.planes) {
                    plane[y * level.stride + x] = static_cast<float>(random.uniform());
                }
            }
        }
    }
}

TEST(Canvas, SparseDrawingEqualsTheSubdivisionOfWholePlanes) {
    for (const Size size : kSizes) {
        Canvas canvas(size.width, size.height);
        draw_noise(canvas, 5);
        std::vector<double> sum_so_far;
        for (int l = canvas.levels() - 1; l >= 0; --l) {
            const CanvasLevel& level = canvas.level(l);
            if (l == canvas.levels() - 1) {
                sum_so_far.assign(static_cast<std::size_t>((level.width + 4) * (level.height + 4)),
                                  0);
            } else {
                const CanvasLevel& coarse = canvas.level(l + 1);
                sum_so_far =
                    refine(sum_so_far, coarse.width, coarse.height, level.width, level.height);
            }
            std::size_t i = 0;
            for (int y = -2; y < level.height + 2; ++y) {
                for (int x = -2; x < level.width + 2; ++x) {
                    sum_so_far[i++] += static_cast<double>(level.planes[2][y * level.stride + x]);
                }
            }
        }
        Image planar(size.width, size.height, 3);
        Image mixed(size.width, size.height, 4);  // of pixels that are neither planar nor packed
        std::vector<float> packed(planar.pixels() * 3);
        const auto run = [&](const ImageView& out) {
            canvas.clear();
            draw_noise(canvas, 5);
            canvas.add_to(out);
        };
        run(planar);
        run(interleaved_view(packed.data(), size.width, size.height, 3));
        run(interleaved_view(mixed.plane(0), size.width, size.height, 4).channel_range(0, 3));
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const auto i = static_cast<std::size_t>(y * size.width + x);
                const double expected =
                    sum_so_far[static_cast<std::size_t>((y + 2) * (size.width + 4) + x + 2)];
                ASSERT_NEAR(planar.at(x, y, 2), expected, 1e-6) << x << ", " << y;
                ASSERT_EQ(packed[3 * i + 2], planar.at(x, y, 2));
                ASSERT_EQ(mixed.plane(0)[4 * i + 2], planar.at(x, y, 2));
            }
        }
    }
}

TEST(Canvas, ClearLeavesNothingAndThreadsDoNotMatter) {
    Canvas canvas(301, 203);
    Image first(301, 203, 3);
    {
        const ThreadLimit limit(1);
        draw_noise(canvas, 9);
        canvas.add_to(first);
    }
    for (int run = 0; run < 3; ++run) {
        canvas.clear();
        Image nothing(301, 203, 3);
        canvas.add_to(nothing);
        EXPECT_EQ(sum(nothing, 0), 0);
        draw_noise(canvas, 9);
        Image again(301, 203, 3);
        canvas.add_to(again);
        for (std::size_t i = 0; i < again.pixels(); ++i) {
            ASSERT_EQ(again.plane(1)[i], first.plane(1)[i]);
        }
    }
    // The padding stays 0, also where vectors wrote into it.
    canvas.clear();
    for (int l = 0; l < canvas.levels(); ++l) {
        const CanvasLevel& level = canvas.level(l);
        for (std::ptrdiff_t x = -level.margin; x < level.stride - level.margin; ++x) {
            ASSERT_EQ(level.planes[0][x], 0);
        }
    }
}

}  // namespace
}  // namespace aureole::lens
