#include "aureole/lens/iris.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/wave/mask_shapes.h"

namespace aureole::lens {
namespace {

constexpr IrisShape kShapes[] = {
    {.blades = 0},
    {.blades = 3},
    {.blades = 5, .rotation_deg = 10},
    {.blades = 6, .rotation_deg = 30, .curvature = .4},
    {.blades = 7, .rotation_deg = -20, .curvature = 1},
    {.blades = 8, .smoothing = .1},
    {.blades = 9, .rotation_deg = 5, .curvature = .6, .smoothing = .1},
    {.blades = 64, .smoothing = .5},
};

// Counts points of a fine raster, tilted so that no edge runs along it.
double area_by_counting(const Iris& iris, int side) {
    const double reach = 1.42 * iris.outer_radius();
    double inside = 0;
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            const double x = reach * ((2 * i + 1.0) / side - 1);
            const double y = reach * ((2 * j + 1.0) / side - 1);
            inside += static_cast<double>(iris.transmission(static_cast<float>(0.8 * x - 0.6 * y),
                                                            static_cast<float>(0.6 * x + 0.8 * y)));
        }
    }
    return inside * 4 * reach * reach / side / side;
}

TEST(Iris, EveryShapeHasTheAreaOfTheUnitDisc) {
    // Counting is right to about (boundary)^.5 (spacing)^1.5, 7e-4 here.
    for (const IrisShape& shape : kShapes) {
        EXPECT_NEAR(area_by_counting(Iris(shape), 1000), kPi, 2e-3)
            << shape.blades << " blades, smoothing " << shape.smoothing;
    }
}

TEST(Iris, PolygonIsThatOfTheApertureShapes) {
    // Oracle: the outlines of wave, drawn with exact coverage. Samples that the edge does not cut
    // must agree; those that it does lie within their own diagonal of the edge.
    for (const IrisShape& shape : kShapes) {
        if (shape.blades == 0 || shape.smoothing > 0) continue;
        const Iris iris(shape);
        wave::Mask mask({.samples = 400, .extent_mm = 4});
        wave::draw(mask, wave::regular_polygon(shape.blades, iris.outer_radius(),
                                               shape.rotation_deg, shape.curvature));
        EXPECT_NEAR(wave::area_mm2(mask), kPi, 2e-4) << shape.blades;
        int cut = 0;
        for (int j = 0; j < 400; ++j) {
            for (int i = 0; i < 400; ++i) {
                const float distance = iris.distance(static_cast<float>(mask.grid.x_mm(i)),
                                                     static_cast<float>(mask.grid.y_mm(j)));
                const float coverage = mask.row(j)[i];
                if (coverage > 0.001F && coverage < 0.999F) {
                    ++cut;
                    EXPECT_NEAR(distance, 1, 0.0072);
                } else {
                    EXPECT_EQ(coverage > 0.5F, distance < 1) << i << " " << j;
                }
            }
        }
        EXPECT_GT(cut, 300);
    }
}

TEST(Iris, CornersAndEdgesOfAHexagonAsDocumented) {
    const Iris iris({.blades = 6});
    const double corner = std::sqrt(kPi / (1.5 * std::numbers::sqrt3));
    EXPECT_NEAR(iris.outer_radius(), corner, 1e-9);
    EXPECT_NEAR(iris.inner_radius(), corner * std::numbers::sqrt3 / 2, 1e-9);
    EXPECT_NEAR(iris.distance(static_cast<float>(corner), 0), 1, 1e-6);
    EXPECT_NEAR(iris.distance(0, static_cast<float>(iris.inner_radius())), 1, 1e-6);
}

TEST(Iris, DistanceGrowsByOnePerUnitAcrossEdges) {
    for (const IrisShape& shape : kShapes) {
        if (shape.smoothing > 0) continue;
        const Iris iris(shape);
        Random random(3);
        for (int i = 0; i < 200; ++i) {
            const double angle = random.uniform(0, 2 * kPi);
            const double radius = random.uniform(0.6, 1.6);
            const auto u = static_cast<float>(radius * std::cos(angle));
            const auto v = static_cast<float>(radius * std::sin(angle));
            constexpr float kStep = 1e-3F;
            const float along_u = iris.distance(u + kStep, v) - iris.distance(u - kStep, v);
            const float along_v = iris.distance(u, v + kStep) - iris.distance(u, v - kStep);
            const float slope = std::hypot(along_u, along_v) / (2 * kStep);
            // Smaller only where the differences straddle a corner.
            EXPECT_LT(slope, 1.001F);
            EXPECT_GT(slope, 0.45F);
        }
    }
}

TEST(Iris, InnerAndOuterRadiiEnclose) {
    for (const IrisShape& shape : kShapes) {
        const Iris iris(shape);
        for (int i = 0; i < 720; ++i) {
            const double angle = i * kPi / 360;
            const auto at = [&](double radius) {
                return iris.distance(static_cast<float>(radius * std::cos(angle)),
                                     static_cast<float>(radius * std::sin(angle)));
            };
            EXPECT_LE(at(iris.inner_radius() - 1e-6), 1.00001F);
            EXPECT_GE(at(iris.outer_radius() + 1e-6), 0.99999F);
        }
    }
}

TEST(Iris, SmoothMaximumIsThatOfTheDocument) {
    // Far from corners nothing changes; at a corner, where both blades are equally far, the
    // polynomial adds k / 4.
    const double k = 0.1;
    const Iris iris({.blades = 5, .smoothing = k});
    const double half_angle = kPi / 5;
    for (const double radius : {0.9, 1.0, 1.1}) {
        EXPECT_NEAR(iris.distance(static_cast<float>(radius), 0),
                    1 + radius * std::cos(half_angle) - iris.apothem() + k / 4, 1e-6);
        const auto u = static_cast<float>(radius * std::cos(half_angle));
        const auto v = static_cast<float>(radius * std::sin(half_angle));
        EXPECT_NEAR(iris.distance(u, v), 1 + radius - iris.apothem(), 1e-6);
    }
}

// An L of light in the lower right of a dark picture.
Image letter() {
    Image image(48, 35, 1);
    for (int y = 8; y < 32; ++y) {
        for (int x = 24; x < 45; ++x) {
            if (x < 32) image.at(x, y) = 1;
            if (x >= 32 && y > 25) image.at(x, y) = 0.5F;
        }
    }
    return image;
}

TEST(Iris, PictureIsScaledToTheAreaOfTheUnitDisc) {
    const Iris iris(letter());
    EXPECT_TRUE(iris.is_image());
    EXPECT_NEAR(area_by_counting(iris, 800), kPi, 2e-3);
    // Half a pixel of interpolation included, nothing lies beyond.
    for (int i = 0; i < 360; ++i) {
        const double angle = i * kPi / 180;
        const double radius = iris.outer_radius() + 1e-4;
        EXPECT_EQ(iris.transmission(static_cast<float>(radius * std::cos(angle)),
                                    static_cast<float>(radius * std::sin(angle))),
                  0);
    }
}

TEST(Iris, TopOfThePictureIsAtPositiveV) {
    Image image(9, 9, 1);
    image.at(4, 0) = 1;
    const Iris iris(image);
    const auto far = static_cast<float>(4 * std::sqrt(kPi));  // 4 pixels; one has area pi
    EXPECT_NEAR(iris.image_transmission(0, far, 0), 1, 1e-5);
    EXPECT_EQ(iris.image_transmission(0, -far, 0), 0);
}

TEST(Iris, FootprintKeepsTheSumOfAPicture) {
    // Sampled at its own footprint, whatever that is, the picture keeps its area: as a ghost of
    // any size does on its pixels.
    const Iris iris(letter());
    for (const float step : {0.05F, 0.2F, 0.37F, 0.6F}) {
        double sum = 0;
        const int reach = static_cast<int>(6 / step);
        for (int j = -reach; j <= reach; ++j) {
            for (int i = -reach; i <= reach; ++i) {
                sum += static_cast<double>(
                    iris.image_transmission((static_cast<float>(i) + 0.3F) * step,
                                            (static_cast<float>(j) + 0.1F) * step, step));
            }
        }
        EXPECT_NEAR(sum * static_cast<double>(step * step) / kPi, 1, 0.02) << step;
    }
}

TEST(Iris, BadShapesAndPicturesAreRefused) {
    EXPECT_THROW(Iris({.blades = 2}), InvalidArgument);
    EXPECT_THROW(Iris({.blades = 65}), InvalidArgument);
    EXPECT_THROW(Iris({.blades = 6, .curvature = 1.1}), InvalidArgument);
    EXPECT_THROW(Iris({.blades = 6, .smoothing = -0.1}), InvalidArgument);
    EXPECT_THROW(Iris({.rotation_deg = std::numeric_limits<double>::infinity()}), InvalidArgument);
    EXPECT_THROW(Iris(ConstImageView{}), InvalidArgument);
    EXPECT_THROW(Iris(Image(4, 4, 1)), InvalidArgument);  // black
    Image nan(2, 2, 1);
    nan.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(Iris{nan.view()}, InvalidArgument);
}

TEST(Occluder, SpansItsDiameterAndIsClearBeyond) {
    Image image(20, 10, 3);  // 2 mm per pixel
    for (int c = 0; c < 3; ++c) image.at(19, 0, c) = 0.25F;
    const Occluder occluder(image, 20);
    EXPECT_DOUBLE_EQ(occluder.width_mm(), 40);
    EXPECT_NEAR(occluder.transmission(19, 9, 0), 0.25, 1e-6);
    EXPECT_EQ(occluder.transmission(-19, -9, 0), 0);
    EXPECT_EQ(occluder.transmission(30, 0, 0), 1);
    EXPECT_EQ(occluder.transmission(0, -1e9F, 3), 1);
    EXPECT_THROW(Occluder(image, 0), InvalidArgument);
    EXPECT_THROW(Occluder(ConstImageView{}, 10), InvalidArgument);
    EXPECT_THROW(Occluder(Image(4, 4, 1), 10), InvalidArgument);  // black
}

TEST(Occluder, LargeFootprintAverages) {
    Image image(64, 64, 1);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) image.at(x, y) = (x + y) % 2 == 0 ? 1.0F : 0.0F;
    }
    const Occluder occluder(image, 64);
    EXPECT_NEAR(occluder.transmission(3.3F, 4.1F, 8), 0.5, 1e-6);
}

}  // namespace
}  // namespace aureole::lens
