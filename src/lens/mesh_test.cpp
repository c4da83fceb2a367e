// Meshes with known maps: what drawing makes of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "lens/mesh_classify.h"
#include "lens/mesh_divide.h"
#include "lens/mesh_facets.h"
#include "lens/mesh_pieces.h"
#include "lens/mesh_upsample.h"

namespace aureole::lens {
namespace {

struct Point {
    double x, y;
};

// A mesh in memory of its own, over [0, 1]^2 but for the rim, with one unit of power per cell.
class TestMesh {
  public:
    TestMesh(int side, const std::function<Point(double, double)>& map) {
        allocate(side);
        for (int j = 0; j < side; ++j) {
            for (int i = 0; i < side; ++i) {
                const std::ptrdiff_t at = j * mesh.stride + i;
                const double s = (i - 1.0) / (side - 3);
                const double t = (j - 1.0) / (side - 3);
                const Point p = map(s, t);
                mesh.x[at] = static_cast<float>(p.x);
                mesh.y[at] = static_cast<float>(p.y);
                mesh.power[at] = 1;
            }
        }
        options.x1 = options.y1 = kSize;
    }

    void set_iris(const std::function<Point(double, double)>& iris) {
        for (int j = 0; j < mesh.rows; ++j) {
            for (int i = 0; i < mesh.columns; ++i) {
                const Point p = iris((i - 1.0) / (mesh.columns - 3), (j - 1.0) / (mesh.rows - 3));
                mesh.u[j * mesh.stride + i] = static_cast<float>(p.x);
                mesh.v[j * mesh.stride + i] = static_cast<float>(p.y);
            }
        }
    }

    // The radiance of each pixel of a kSize x kSize picture. Draws it in tiles of some rows.
    std::vector<float> draw(int tile_rows = kSize, int factor = 1) {
        classify(mesh, options);
        Mesh* drawn = &mesh;
        TestMesh fine;
        if (factor > 1) {
            fine.allocate(upsampled(mesh.columns, factor));
            upsample(mesh, factor, fine.mesh);
            options.upsampled = true;
            classify(fine.mesh, options);
            drawn = &fine.mesh;
        }
        std::vector<MeshGroup> groups(
            static_cast<std::size_t>(most_groups(drawn->columns, drawn->rows)));
        groups.resize(static_cast<std::size_t>(divide(*drawn, groups.data())));
        facets = pieces = 0;
        for (const MeshGroup& group : groups) ++(group.pieces_i > 0 ? pieces : facets);
        std::vector<float> picture(static_cast<std::size_t>(kSize * kSize));
        std::vector<float> sums(static_cast<std::size_t>((kSize + 2) * (kSize + 2)));
        for (int y0 = 0; y0 < kSize; y0 += tile_rows) {
            MeshTile tile{.sums = sums.data(),
                          .stride = kSize + 2,
                          .x1 = kSize,
                          .y0 = y0,
                          .y1 = std::min(kSize, y0 + tile_rows)};
            std::fill(sums.begin(), sums.end(), 0.0F);
            for (const MeshGroup& group : groups) {
                if (group.pieces_i > 0) {
                    draw_pieces(*drawn, group, mask, tile);
                } else {
                    draw_facets(*drawn, group, mask, tile);
                }
            }
            for (int y = tile.y0; y < tile.y1; ++y) {
                for (int x = 0; x < kSize; ++x) {
                    picture[static_cast<std::size_t>(y * kSize + x)] =
                        sums[static_cast<std::size_t>((y - y0 + 1) * tile.stride + x + 1)];
                }
            }
        }
        return picture;
    }

    // Of all cells that are drawn.
    double energy() const { return (mesh.columns - 3.0) * (mesh.rows - 3.0); }

    static constexpr int kSize = 400;
    Mesh mesh;
    MeshMask mask;
    ClassifyOptions options;
    int facets = 0, pieces = 0;  // groups

  private:
    TestMesh() = default;

    void allocate(int side) {
        mesh.columns = mesh.rows = side;
        mesh.stride = ray_stride(side);
        const auto count = static_cast<std::size_t>(mesh.stride * side + kMeshPadding);
        memory_.assign(kMeshFields * count, 0.0F);
        states_.assign(static_cast<std::size_t>(side * side), 0);
        float** const fields[] = {&mesh.x,     &mesh.y,      &mesh.u,        &mesh.v,    &mesh.clip,
                                  &mesh.power, &mesh.smooth, &mesh.radiance, &mesh.share};
        for (std::size_t k = 0; k < kMeshFields; ++k) *fields[k] = memory_.data() + k * count;
        mesh.state = states_.data();
    }

    std::vector<float> memory_;
    std::vector<std::uint8_t> states_;
};

double sum(const std::vector<float>& picture) {
    double total = 0;
    for (const float value : picture) total += value;
    return total;
}

// A square of `size` pixels, turned about the middle of the picture.
std::function<Point(double, double)> turned_square(double size, double angle_deg) {
    const double c = size * std::cos(angle_deg / 57.29578);
    const double s = size * std::sin(angle_deg / 57.29578);
    return [=](double u, double v) {
        return Point{200.3 + c * (u - 0.5) - s * (v - 0.5), 199.6 + s * (u - 0.5) + c * (v - 0.5)};
    };
}

// Largest deviation from the mean in the middle of the picture, relative.
double unevenness(const std::vector<float>& picture, int reach) {
    double low = 1e9;
    double high = 0;
    for (int y = 200 - reach; y < 200 + reach; ++y) {
        for (int x = 200 - reach; x < 200 + reach; ++x) {
            const double value = picture[static_cast<std::size_t>(y * TestMesh::kSize + x)];
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    return (high - low) / (high + low);
}

TEST(Mesh, FacetsTileWithoutGapsOrOverlaps) {
    for (const double angle_deg : {0.0, 17.0, 45.0}) {
        TestMesh mesh(40, turned_square(260, angle_deg));
        const std::vector<float> picture = mesh.draw();
        EXPECT_GT(mesh.facets, 0);
        // All of 150 x 150 pixels would show one that is missing or drawn twice.
        EXPECT_LT(unevenness(picture, 75), 1e-4) << angle_deg;
        EXPECT_NEAR(sum(picture) / mesh.energy(), 1, 2e-4) << angle_deg;
    }
}

// Rectangles in the place of turned squares make a faint pattern.
TEST(Mesh, PiecesAreEven) {
    for (const double angle_deg : {0.0, 10.0, 22.0, 30.0, 45.0}) {
        for (const double cell_px : {0.3, 0.45, 0.8, 1.1, 1.4}) {
            TestMesh mesh(150, turned_square(147 * cell_px, angle_deg));
            const std::vector<float> picture = mesh.draw();
            EXPECT_EQ(mesh.facets, 0);
            const int reach = static_cast<int>(40 * cell_px);
            EXPECT_LT(unevenness(picture, reach), 0.045)
                << angle_deg << " deg, " << cell_px << " px";
            EXPECT_NEAR(sum(picture) / mesh.energy(), 1, 3e-4);
        }
    }
}

// x = a s^2 folds at s = 0: both sides of it add up to a density of 2 / (2 sqrt(a x)).
TEST(Mesh, FoldsAddUpAndKeepEnergy) {
    for (const int factor : {1, 3}) {
        TestMesh mesh(40, [](double s, double t) {
            return Point{40.4 + 280 * std::pow(2 * s - 1, 2), 60.7 + 250 * t};
        });
        const std::vector<float> picture = mesh.draw(TestMesh::kSize, factor);
        EXPECT_GT(mesh.facets, 0) << factor;
        EXPECT_GT(mesh.pieces, 0) << factor;
        EXPECT_NEAR(sum(picture) / mesh.energy(), 1, 3e-4) << factor;
        for (int x = 43; x < 300; ++x) {
            // The mean over the pixel, by the integral.
            const double share = std::sqrt((x + 1 - 40.4) / 280) - std::sqrt((x - 40.4) / 280);
            const double expected = mesh.energy() / 250 * share;
            const double value = picture[static_cast<std::size_t>(180 * TestMesh::kSize + x)];
            // Pieces are a pixel wide, which shows where the density bends most.
            EXPECT_NEAR(value / expected, 1, x < 60 ? 0.08 : 0.012) << factor << " x " << x;
        }
    }
}

// Where facets and pieces meet, at the border of what is fit for facets, nothing shows.
TEST(Mesh, BothWaysOfDrawingFitTogether) {
    TestMesh mesh(70, [](double s, double t) {
        const double bend = 0.35 * std::sin(3 * s) * std::sin(2.5 * t);
        return Point{30 + 300 * s + 60 * bend, 30 + 300 * t - 90 * bend * s};
    });
    const std::vector<float> both = mesh.draw();
    EXPECT_GT(mesh.facets, 0);
    EXPECT_GT(mesh.pieces, 0);
    for (int y = 60; y < 300; ++y) {
        for (int x = 60; x < 300; ++x) {
            const auto at = [&](int dx, int dy) {
                return both[static_cast<std::size_t>((y + dy) * TestMesh::kSize + x + dx)];
            };
            // The second difference of a smooth field is far below a hundredth of it.
            EXPECT_LT(std::abs(at(-2, 0) + at(2, 0) - 2 * at(0, 0)), 0.02F * at(0, 0)) << x << y;
            EXPECT_LT(std::abs(at(0, -2) + at(0, 2) - 2 * at(0, 0)), 0.02F * at(0, 0)) << x << y;
        }
    }
}

TEST(Mesh, TilesAreThePicture) {
    TestMesh mesh(60, [](double s, double t) {
        return Point{40 + 280 * std::pow(2 * s - 1, 2) + 30 * t, 50 + 250 * t + 20 * s};
    });
    const std::vector<float> whole = mesh.draw();
    const std::vector<float> tiled = mesh.draw(32);
    for (std::size_t k = 0; k < whole.size(); ++k) {
        EXPECT_NEAR(tiled[k], whole[k], 1e-5 * (1 + whole[k])) << k;
    }
}

// A disc has its area, whichever way it is drawn.
TEST(Mesh, ApertureEdgesAreUnbiased) {
    for (const double size : {80.0, 300.0}) {
        TestMesh mesh(64, turned_square(size, 11));
        mesh.set_iris([](double s, double t) { return Point{2.3 * (s - 0.5), 2.3 * (t - 0.5)}; });
        EXPECT_NEAR(sum(mesh.draw()) / (mesh.energy() * 3.14159265 / (2.3 * 2.3)), 1, 1e-3) << size;
    }
}

TEST(Mesh, UpsamplingKeepsVerticesAndEnergy) {
    TestMesh mesh(30, [](double s, double t) {
        return Point{50 + 250 * s + 20 * s * t, 60 + 230 * t + 25 * s * s};
    });
    const double once = sum(mesh.draw());
    const double finer = sum(mesh.draw(TestMesh::kSize, 4));
    EXPECT_NEAR(finer / once, 1, 2e-4);
}

}  // namespace
}  // namespace aureole::lens
