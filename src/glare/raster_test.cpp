#include "glare/raster.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/random.h"
#include "glare/raster_error.h"
#include "glare/raster_kernel.h"
#include "glare/sprite_tiles.h"

namespace aureole::glare {
namespace {

constexpr int kWidth = 301;
constexpr int kHeight = 43;

Image gathered(const Image& picture, int scale, const float* weights = nullptr) {
    Image raster(raster_size(picture.width(), scale), raster_size(picture.height(), scale),
                 picture.channels());
    RasterGatherer(picture.width(), scale).run(picture, weights, raster);
    return raster;
}

Image between(const Image& raster, int scale) {
    Image picture(kWidth, kHeight, raster.channels());
    add_between(raster, scale, nullptr, picture);
    return picture;
}

Image noise(int width, int height, std::uint64_t seed) {
    Image image(width, height, 1);
    Random random(seed);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        image.plane(0)[i] = static_cast<float>(random.uniform(-1, 1));
    }
    return image;
}

double product(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        sum += static_cast<double>(a.plane(0)[i]) * b.plane(0)[i];
    }
    return sum;
}

// Middle of node or pixel i in pixels.
double node_place(int i, int scale) { return (i - kRasterMargin + 0.5) * scale; }

TEST(Raster, GathersEnergyAndCentroid) {
    for (const int scale : {2, 4, 8}) {
        for (const auto& [x, y] : {std::pair{0, 0}, {13, 21}, {14, 22}, {300, 42}}) {
            Image picture(kWidth, kHeight, 1);
            picture.at(x, y) = 5;
            const Image raster = gathered(picture, scale);
            double sum = 0;
            double sum_x = 0;
            double sum_y = 0;
            for (int j = 0; j < raster.height(); ++j) {
                for (int i = 0; i < raster.width(); ++i) {
                    const auto value = static_cast<double>(raster.at(i, j));
                    sum += value;
                    sum_x += value * node_place(i, scale);
                    sum_y += value * node_place(j, scale);
                }
            }
            EXPECT_NEAR(sum, 5, 1e-5);
            EXPECT_NEAR(sum_x / sum, x + 0.5, 1e-4);
            EXPECT_NEAR(sum_y / sum, y + 0.5, 1e-4);
        }
    }
}

TEST(Raster, GatheringIsTheTransposeOfInterpolation) {
    for (const int scale : {2, 4, 8}) {
        const Image picture = noise(kWidth, kHeight, 1);
        const Image raster = noise(raster_size(kWidth, scale), raster_size(kHeight, scale), 2);
        EXPECT_NEAR(product(gathered(picture, scale), raster),
                    product(picture, between(raster, scale)), 1e-3);
    }
}

TEST(Raster, GathersWeightedPixels) {
    const Image picture = noise(kWidth, kHeight, 3);
    const Image weights = noise(kWidth, kHeight, 4);
    Image weighted = picture;
    for (std::size_t i = 0; i < weighted.pixels(); ++i) {
        weighted.plane(0)[i] *= weights.plane(0)[i];
    }
    const Image a = gathered(picture, 4, weights.plane(0));
    const Image b = gathered(weighted, 4);
    for (std::size_t i = 0; i < a.pixels(); ++i) ASSERT_NEAR(a.plane(0)[i], b.plane(0)[i], 1e-5);
}

TEST(Raster, FillsTilesLikePictures) {
    for (const int scale : {2, 4, 8}) {
        const Image raster = noise(raster_size(kWidth, scale), raster_size(kHeight, scale), 5);
        const Image picture = between(raster, scale);
        const SpriteTiles tiles(kWidth, kHeight);
        std::vector<float> scratch(3 * SpriteTiles::kPlane);
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            const SpriteTile tile = tiles.cleared_tile(i, 1, scratch.data());
            add_between(raster, scale, tile);
            for (int y = 0; y < tile.height; ++y) {
                for (int x = 0; x < tile.width; ++x) {
                    ASSERT_EQ(tile.planes[0][y * tile.stride + x],
                              picture.at(tile.x + x, tile.y + y));
                }
            }
        }
    }
}

TEST(Raster, InterpolatesPlanesExactly) {
    for (const int scale : {2, 4, 8}) {
        Image raster(raster_size(kWidth, scale), raster_size(kHeight, scale), 1);
        for (int j = 0; j < raster.height(); ++j) {
            for (int i = 0; i < raster.width(); ++i) {
                raster.at(i, j) =
                    static_cast<float>(2 * node_place(i, scale) - 3 * node_place(j, scale));
            }
        }
        const Image picture = between(raster, scale);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                ASSERT_NEAR(picture.at(x, y), 2 * (x + 0.5) - 3 * (y + 0.5), 1e-3);
            }
        }
    }
}

// Wings that start 20 pixels from the source, and end hard.
Image wings(int width, int height) {
    Image far(width, height, 1);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double r = std::hypot(x - width / 2, 1.3 * (y - height / 2));
            const double t = std::min(r / 20, 1.0);
            far.at(x, y) = static_cast<float>(t * t * (3 - 2 * t) / (1 + r * r));
        }
    }
    return far;
}

// What a source at (x, y) becomes through the raster.
Image response(const Image& kernel, int scale, int x, int y) {
    Image picture(kWidth, kHeight, 1);
    picture.at(x, y) = 1;
    const Image light = gathered(picture, scale);
    Image raster(light.width(), light.height(), 1);
    for (int j = 0; j < raster.height(); ++j) {
        for (int i = 0; i < raster.width(); ++i) {
            for (int v = 0; v < light.height(); ++v) {
                for (int u = 0; u < light.width(); ++u) {
                    if (light.at(u, v) == 0) continue;
                    const int kx = i - u + kernel.width() / 2;
                    const int ky = j - v + kernel.height() / 2;
                    if (kx < 0 || ky < 0 || kx >= kernel.width() || ky >= kernel.height()) continue;
                    raster.at(i, j) += light.at(u, v) * kernel.at(kx, ky);
                }
            }
        }
    }
    return between(raster, scale);
}

double squares(const Image& kernel, const Image& far, int scale) {
    double sum = 0;
    for (int y = 20; y < 20 + scale; ++y) {
        for (int x = 148; x < 148 + scale; ++x) {
            const Image drawn = response(kernel, scale, x, y);
            for (int j = 0; j < kHeight; ++j) {
                for (int i = 0; i < kWidth; ++i) {
                    const int u = i - x + far.width() / 2;
                    const int v = j - y + far.height() / 2;
                    const bool in = u >= 0 && v >= 0 && u < far.width() && v < far.height();
                    const double truth = in ? static_cast<double>(far.at(u, v)) : 0;
                    sum += std::pow(static_cast<double>(drawn.at(i, j)) - truth, 2);
                }
            }
        }
    }
    return sum;
}

TEST(RasterKernel, KeepsTheSum) {
    for (const int scale : {2, 4, 8}) {
        for (const auto& [width, height] : {std::pair{81, 61}, {80, 64}}) {
            const Image far = wings(width, height);
            const Image kernel = raster_kernel(far, scale);
            double sum = 0;
            double truth = 0;
            for (std::size_t i = 0; i < kernel.pixels(); ++i) {
                sum += static_cast<double>(kernel.plane(0)[i]);
            }
            for (std::size_t i = 0; i < far.pixels(); ++i) {
                truth += static_cast<double>(far.plane(0)[i]);
            }
            EXPECT_NEAR(scale * scale * sum / truth, 1, 1e-5);
        }
    }
}

// No other kernel has a smaller sum of squares: not that of samples, nor its neighbours.
TEST(RasterKernel, IsTheNearest) {
    for (const int scale : {2, 4}) {
        const Image far = wings(61, 21);
        const Image kernel = raster_kernel(far, scale);
        const double least = squares(kernel, far, scale);
        Image samples = kernel;
        for (int y = 0; y < kernel.height(); ++y) {
            for (int x = 0; x < kernel.width(); ++x) {
                const int u = 30 + scale * (x - kernel.width() / 2);
                const int v = 10 + scale * (y - kernel.height() / 2);
                const bool in = u >= 0 && v >= 0 && u < 61 && v < 21;
                samples.at(x, y) = in ? far.at(u, v) : 0;
            }
        }
        EXPECT_LT(least, squares(samples, far, scale));
        for (const float change : {-0.05F, 0.05F}) {
            Image other = kernel;
            other.at(kernel.width() / 2 + 4, kernel.height() / 2 + 1) *= 1 + change;
            EXPECT_LT(least, squares(other, far, scale));
        }
    }
}

TEST(RasterError, IsThatOfWhatIsDrawn) {
    for (const int scale : {2, 4}) {
        const Image far = wings(61, 21);
        const Image kernel = raster_kernel(far, scale);
        double worst = 0;
        for (const int dy : {0, scale / 2}) {
            for (const int dx : {0, scale / 2}) {
                const int x = 148 + dx;
                const int y = 20 + dy;
                const Image drawn = response(kernel, scale, x, y);
                double sum = 0;
                for (int v = 0; v < 21; ++v) {
                    for (int u = 0; u < 61; ++u) {
                        sum += std::abs(static_cast<double>(drawn.at(x + u - 30, y + v - 10)) -
                                        far.at(u, v));
                    }
                }
                worst = std::max(worst, sum);
            }
        }
        EXPECT_NEAR(raster_error(far, kernel, scale, 1), worst, 1e-4 * worst);
        EXPECT_GT(raster_error(far, kernel, scale, 0.1 * worst), 0.1 * worst);
    }
}

}  // namespace
}  // namespace aureole::glare
