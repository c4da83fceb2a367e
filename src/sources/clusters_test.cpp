#include "aureole/sources/clusters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"

namespace aureole::sources {
namespace {

using Criterion = ClusterOptions::Criterion;
using Shape = Cluster::Shape;

ClusterOptions similar(int side, bool tree = true) {
    ClusterOptions options;
    options.criterion = Criterion::kSimilarColor;
    options.max_side = side;
    options.tree = tree;
    return options;
}

// A picture from rows of text: '#' is bright.
Image picture_of(const std::vector<std::string>& rows) {
    Image image(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), 3);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const bool bright =
                rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#';
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = bright ? 2.0F + 0.01F * static_cast<float>(c) : 0.0F;
        }
    }
    return image;
}

struct Counts {
    int clusters = 0;
    int singles = 0;
};

Counts count(const Clusters& found) {
    Counts counts;
    for (const Cluster& cluster : found.clusters) {
        ++(cluster.shape == Shape::kCell ? counts.clusters : counts.singles);
    }
    return counts;
}

// A kernel with a peak, wings and needles, of sum 1 in each channel.
Image rough_kernel(int size, unsigned seed) {
    Image kernel(size, size, 3);
    Random random(seed);
    for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const double r2 = std::pow(x - size / 2, 2) + std::pow(y - size / 2, 2);
                kernel.at(x, y, c) = static_cast<float>((0.8 + 0.4 * random.uniform()) /
                                                        std::pow(1 + r2 / (1 + c), 1.2));
                sum += kernel.at(x, y, c);
            }
        }
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) kernel.at(x, y, c) /= static_cast<float>(sum);
        }
    }
    return kernel;
}

// Accumulates sum of e k(x - s) on a canvas that holds every pixel that can be reached.
class Canvas {
  public:
    Canvas(const Image& picture, const Image& kernel)
        : kernel_(kernel),
          reach_(kernel.width() / 2 + 2),
          sums_(picture.width() + 2 * reach_, picture.height() + 2 * reach_, 3) {}

    void add(int x, int y, const std::array<double, 3>& energy) {
        const int half = kernel_.width() / 2;
        for (int c = 0; c < 3; ++c) {
            for (int v = 0; v < kernel_.height(); ++v) {
                for (int u = 0; u < kernel_.width(); ++u) {
                    sums_.at(x + u - half + reach_, y + v - half + reach_, c) += static_cast<float>(
                        energy[static_cast<std::size_t>(c)] * kernel_.at(u, v, c));
                }
            }
        }
    }
    void add(const Cluster& cluster, double sign) {
        std::array<double, 3> energy = {};
        const auto with = [&](double share) {
            for (std::size_t c = 0; c < 3; ++c) energy[c] = sign * share * cluster.energy[c];
            return energy;
        };
        if (cluster.shape == Shape::kCell) {
            const double share = 1.0 / (cluster.side * cluster.side);
            for (int y = 0; y < cluster.side; ++y) {
                for (int x = 0; x < cluster.side; ++x)
                    add(cluster.x + x, cluster.y + y, with(share));
            }
            return;
        }
        const double left = std::floor(cluster.centroid_x - 0.5);
        const double top = std::floor(cluster.centroid_y - 0.5);
        const double fx = cluster.centroid_x - 0.5 - left;
        const double fy = cluster.centroid_y - 0.5 - top;
        for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 2; ++i) {
                add(static_cast<int>(left) + i, static_cast<int>(top) + j,
                    with((i == 0 ? 1 - fx : fx) * (j == 0 ? 1 - fy : fy)));
            }
        }
    }
    double amount() const {
        double sum = 0;
        for (int c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < sums_.pixels(); ++i) sum += std::abs(sums_.plane(c)[i]);
        }
        return sum;
    }

  private:
    const Image& kernel_;
    int reach_;
    Image sums_;
};

// Of the glare of all clusters, from that of every pixel.
double measured_error(const Image& picture, const Image& kernel, const Clusters& found) {
    Canvas canvas(picture, kernel);
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            canvas.add(x, y, {picture.at(x, y, 0), picture.at(x, y, 1), picture.at(x, y, 2)});
        }
    }
    for (const Cluster& cluster : found.clusters) canvas.add(cluster, -1);
    return canvas.amount();
}

// Smooth blobs of several colours and sizes, and a few single pixels, over black.
Image random_lights(int width, int height, unsigned seed) {
    Image image(width, height, 3);
    Random random(seed);
    for (int light = 0; light < 5; ++light) {
        const double cx = random.uniform(0, width);
        const double cy = random.uniform(0, height);
        const double radius = random.log_uniform(0.4, 8);
        const double hard = random.log_uniform(1, 20);
        const double color[3] = {random.uniform(), random.uniform(), random.uniform()};
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const double r = std::hypot(x + 0.5 - cx, y + 0.5 - cy);
                const double value = 100 / (1 + std::pow(r / radius, 2 * hard)) - 1;
                for (int c = 0; c < 3; ++c) {
                    image.at(x, y, c) += static_cast<float>(std::max(0.0, value) * color[c]);
                }
            }
        }
    }
    return image;
}

// Figure 8 of the paper: 96 bright pixels are 20 clusters of 2 x 2 and 16 single ones; the tree up
// to 4 x 4 is another 20 % better.
TEST(Clusters, CountsAreThoseOfFigure8) {
    const Image picture = picture_of({
        "................",  //
        "....########....",  //
        "....########....",  //
        "....########....",  //
        "..############..",  //
        "..############..",  //
        "..############..",  //
        "..############..",  //
        "....########....",  //
        "....########....",  //
        "....########....",  //
        "................",  //
    });
    int bright = 0;
    for (std::size_t i = 0; i < picture.pixels(); ++i) bright += picture.plane(0)[i] > 0 ? 1 : 0;
    ASSERT_EQ(bright, 96);
    const Counts none = count(find_clusters(picture, nullptr, {}, similar(1)));
    EXPECT_EQ(none.singles, 96);
    const Counts grid = count(find_clusters(picture, nullptr, {}, similar(2, false)));
    EXPECT_EQ(grid.clusters, 20);
    EXPECT_EQ(grid.singles, 16);
    const Counts tree = count(find_clusters(picture, nullptr, {}, similar(4)));
    EXPECT_EQ(tree.singles, 16);
    EXPECT_EQ(tree.clusters + tree.singles, 30);  // 36 / 1.2
}

TEST(Clusters, ColoursThatDifferArePartedInThePaperToo) {
    Image picture = picture_of({"##", "##"});
    EXPECT_EQ(count(find_clusters(picture, nullptr, {}, similar(2))).clusters, 1);
    picture.at(1, 1, 0) = 0.5F;  // 30 % of the mean away
    EXPECT_EQ(count(find_clusters(picture, nullptr, {}, similar(2))).singles, 4);
}

TEST(Clusters, KeepTheEnergyOfBrightPixels) {
    const Image picture = random_lights(50, 37, 3);
    std::vector<float> weights(picture.pixels());
    Random random(5);
    for (float& w : weights) w = static_cast<float>(random.uniform(0.2, 1));
    const KernelRoughness roughness = roughness_of(rough_kernel(21, 1));
    for (const double error : {0.0, 0.01, 0.3}) {
        ClusterOptions options;
        options.error = error;
        options.dim_limit = 5;
        const Clusters found = find_clusters(picture, weights.data(), roughness, options);
        double bright[3] = {};
        double left = 0;
        std::size_t pixels = 0;
        for (std::size_t i = 0; i < picture.pixels(); ++i) {
            const float largest =
                std::max({picture.plane(0)[i], picture.plane(1)[i], picture.plane(2)[i]});
            for (int c = 0; c < 3; ++c) {
                const double e = static_cast<double>(picture.plane(c)[i]) * weights[i];
                (largest > 5 ? bright[c] : left) += e;
            }
            pixels += largest > 5 ? 1 : 0;
        }
        double energy[3] = {};
        for (const Cluster& cluster : found.clusters) {
            for (std::size_t c = 0; c < 3; ++c) energy[c] += cluster.energy[c];
        }
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(energy[c] / bright[c], 1, 1e-6);
        EXPECT_NEAR(found.energy_left, left, 1e-4 * left);
        EXPECT_NEAR(found.energy, bright[0] + bright[1] + bright[2], 1e-6 * found.energy);
        EXPECT_EQ(found.bright_pixels, pixels);
    }
}

TEST(Clusters, ErrorStaysBelowItsBound) {
    double tightest = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const Image picture = random_lights(40, 30, seed);
        const Image kernel = rough_kernel(25, seed);
        const KernelRoughness roughness = roughness_of(kernel);
        for (const double error : {0.001, 0.01, 0.1}) {
            ClusterOptions options;
            options.error = error;
            const Clusters found = find_clusters(picture, nullptr, roughness, options);
            const double measured = measured_error(picture, kernel, found);
            EXPECT_LE(found.error_bound, error * found.energy * (1 + 1e-9));
            EXPECT_LE(measured, found.error_bound + 1e-5 * found.energy) << seed << " " << error;
            if (found.error_bound > 1e-3 * found.energy) {
                tightest = std::max(tightest, measured / found.error_bound);
            }
        }
    }
    EXPECT_GT(tightest, 0.1);  // a bound, and not a bound on everything
}

// Light that is even over cells costs nothing in accuracy, however rough the kernel.
TEST(Clusters, EvenCellsAreExact) {
    const Image picture = picture_of(std::vector<std::string>(32, std::string(32, '#')));
    const KernelRoughness roughness = roughness_of(rough_kernel(9, 2));
    ClusterOptions options;
    options.error = 1e-6;
    const Clusters found = find_clusters(picture, nullptr, roughness, options);
    EXPECT_EQ(found.clusters.size(), 4U);
    EXPECT_LT(found.error_bound, 1e-6 * found.energy);
}

TEST(Clusters, SmootherKernelsNeedFewer) {
    const Image picture = random_lights(64, 64, 9);
    ClusterOptions options;
    std::size_t last = picture.pixels() + 1;
    for (const double width : {1.0, 4.0, 16.0}) {
        Image kernel(101, 101, 1);
        double sum = 0;
        for (int y = 0; y < 101; ++y) {
            for (int x = 0; x < 101; ++x) {
                const double r2 = (x - 50) * (x - 50) + (y - 50) * (y - 50);
                kernel.at(x, y) = static_cast<float>(std::exp(-r2 / (2 * width * width)));
                sum += kernel.at(x, y);
            }
        }
        for (std::size_t i = 0; i < kernel.pixels(); ++i) {
            kernel.plane(0)[i] /= static_cast<float>(sum);
        }
        const auto found = find_clusters(picture, nullptr, roughness_of(kernel), options);
        EXPECT_LT(found.clusters.size(), last) << width;
        last = found.clusters.size();
    }
    EXPECT_LT(last * 5, find_clusters(picture, nullptr, {}, similar(1)).clusters.size());
}

// A light that drifts takes its clusters along: their common centroid follows, energy stays.
TEST(Clusters, CentroidFollowsADriftingLight) {
    const auto blob = [](double cx) {
        Image picture(48, 48, 3);
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 48; ++x) {
                const double r2 = std::pow(x + 0.5 - cx, 2) + std::pow(y + 0.5 - 24, 2);
                const auto value = static_cast<float>(50 * std::exp(-r2 / 12));
                for (int c = 0; c < 3; ++c) picture.at(x, y, c) = value;
            }
        }
        return picture;
    };
    Image kernel(61, 61, 1);
    for (int y = 0; y < 61; ++y) {
        for (int x = 0; x < 61; ++x) {
            kernel.at(x, y) = static_cast<float>(
                std::exp(-((x - 30) * (x - 30) + (y - 30) * (y - 30)) / 128.0) / 402.0);
        }
    }
    ClusterOptions options;
    options.error = 0.05;
    for (int step = 0; step <= 32; ++step) {
        const double cx = 20 + step / 16.0;
        const auto found = find_clusters(blob(cx), nullptr, roughness_of(kernel), options);
        double energy = 0;
        double moment = 0;
        for (const Cluster& cluster : found.clusters) {
            energy += cluster.energy[0];
            moment += cluster.energy[0] * cluster.centroid_x;
        }
        EXPECT_NEAR(moment / energy, cx, 1e-4) << step;
        EXPECT_LT(found.clusters.size(), 60U);
    }
}

TEST(Clusters, AreTheSameForAnyNumberOfThreads) {
    const Image picture = random_lights(100, 90, 4);
    const KernelRoughness roughness = roughness_of(rough_kernel(15, 3));
    const auto all = find_clusters(picture, nullptr, roughness);
    const ThreadLimit one(1);
    const auto single = find_clusters(picture, nullptr, roughness);
    ASSERT_EQ(all.clusters.size(), single.clusters.size());
    EXPECT_EQ(all.error_bound, single.error_bound);
    for (std::size_t i = 0; i < all.clusters.size(); ++i) {
        EXPECT_EQ(all.clusters[i].energy, single.clusters[i].energy);
        EXPECT_EQ(all.clusters[i].centroid_x, single.clusters[i].centroid_x);
    }
}

TEST(Clusters, RefuseWhatMakesNoSense) {
    const Image picture(4, 4, 3);
    ClusterOptions options;
    options.max_side = 3;
    EXPECT_THROW(find_clusters(picture, nullptr, {}, options), InvalidArgument);
    options.max_side = 128;
    EXPECT_THROW(find_clusters(picture, nullptr, {}, options), InvalidArgument);
    options = {};
    options.error = -0.1;
    EXPECT_THROW(find_clusters(picture, nullptr, {}, options), InvalidArgument);
    options = {};
    options.dim_limit = std::nanf("");
    EXPECT_THROW(find_clusters(picture, nullptr, {}, options), InvalidArgument);
    EXPECT_THROW(find_clusters(Image(4, 4, 2), nullptr, {}, {}), InvalidArgument);
    EXPECT_THROW(find_clusters({}, nullptr, {}, {}), InvalidArgument);
    EXPECT_THROW(roughness_of({}), InvalidArgument);
    EXPECT_THROW(dim_limit_for(picture, nullptr, 1.5), InvalidArgument);
}

// A box of n x n pixels: sum 1, steps of 1 / n^2 along two sides of n pixels each.
TEST(KernelRoughness, OfABox) {
    constexpr int kSide = 5;
    Image box(kSide, kSide, 1);
    for (std::size_t i = 0; i < box.pixels(); ++i) box.plane(0)[i] = 1.0F / (kSide * kSide);
    const KernelRoughness r = roughness_of(box);
    EXPECT_NEAR(r.sum, 1, 1e-6);
    EXPECT_NEAR(r.variation_x, 2.0 / kSide, 1e-6);
    EXPECT_NEAR(r.variation_y, 2.0 / kSide, 1e-6);
    EXPECT_NEAR(r.curvature_xx, 4.0 / kSide, 1e-6);
    EXPECT_NEAR(r.curvature_yy, 4.0 / kSide, 1e-6);
    EXPECT_NEAR(r.curvature_xy, 4.0 / (kSide * kSide), 1e-6);
}

TEST(DimLimit, LeavesAtMostTheShareAsked) {
    const Image picture = random_lights(60, 50, 8);
    std::vector<float> weights(picture.pixels(), 0.5F);
    double total = 0;
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < picture.pixels(); ++i) total += 0.5 * picture.plane(c)[i];
    }
    const auto below = [&](float limit) {
        double sum = 0;
        for (std::size_t i = 0; i < picture.pixels(); ++i) {
            const float largest =
                std::max({picture.plane(0)[i], picture.plane(1)[i], picture.plane(2)[i]});
            if (largest > limit) continue;
            for (int c = 0; c < 3; ++c) sum += 0.5 * picture.plane(c)[i];
        }
        return sum / total;
    };
    for (const double share : {0.0, 0.001, 0.01, 0.2}) {
        const float limit = dim_limit_for(picture, weights.data(), share);
        EXPECT_LE(below(limit), share + 1e-12);
        EXPECT_GT(below(1.1F * limit + 1e-6F), share) << limit;
    }
}

}  // namespace
}  // namespace aureole::sources
