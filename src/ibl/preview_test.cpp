#include "aureole/ibl/preview.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/error.h"
#include "aureole/ibl/cube_sampler.h"
#include "ibl/preview_test_support.h"

namespace aureole::ibl {
namespace {

// Each side of the world in a colour of its own; ambiguous only on its edges.
CubeMap labelled(int size) {
    return make_environment(size, [](const Direction& d) {
        const CubePoint point = cube_point_of(d);
        Radiance rgb = {};
        rgb[static_cast<std::size_t>(point.face / 2)] = point.face % 2 == 0 ? 1.0F : 0.5F;
        return rgb;
    });
}

TEST(Preview, MirrorShowsTheWorldAroundTheCamera) {
    PreviewOptions options = small_preview();
    options.materials = {kMirror};
    options.roughness = {0};
    options.background = PreviewBackground::kEnvironment;
    const CubeChain chain = {labelled(64)};
    const PreviewChain named = {"a", &chain, {0}};
    const PreviewSheet sheet =
        filter_preview(named, named, preview_table(), white_irradiance(), options);
    const auto expect = [&](double x, double y, const Radiance& rgb) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(sheet.pixels.at(static_cast<int>(sheet.cell_px / 2.0 + 16 * x),
                                        static_cast<int>(sheet.cell_px / 2.0 - 16 * y), c),
                        rgb[static_cast<std::size_t>(c)], 1e-6)
                << x << ' ' << y << ' ' << c;
        }
    };
    // Normals at 45 deg from the view reflect what is at 90 deg.
    expect(0, 0, {0, 0, 1});
    expect(0.7, 0, {1, 0, 0});
    expect(-0.7, 0, {0.5F, 0, 0});
    expect(0, 0.7, {0, 1, 0});
    expect(0, -0.7, {0, 0.5F, 0});
    expect(0.66, 0.66, {0, 0, 0.5F});
    expect(-1.05, 1.05, {0, 0, 0.5F});  // the background is what the camera looks at
}

TEST(Preview, MirrorIsADirectLookup) {
    PreviewOptions options = small_preview();
    options.materials = {kMirror};
    options.roughness = {0};
    const CubeChain chain = {studio_environment(64)};
    const CubeSampler sampler(chain);
    const PreviewChain named = {"a", &chain, {0}};
    const PreviewSheet sheet =
        filter_preview(named, named, preview_table(), white_irradiance(), options);
    int compared = 0;
    for (int y = 0; y < sheet.cell_px; ++y) {
        for (int x = 0; x < sheet.cell_px; ++x) {
            std::array<double, 3> mean = {};
            bool inside = true;
            for (int i = 0; i < 4; ++i) {
                // From the middle of a sphere of 32 pixels in a cell of 38.
                const double u = (x + 0.25 + 0.5 * (i % 2) - 19) / 16;
                const double v = (19 - y - 0.25 - 0.5 * (i > 1 ? 1 : 0)) / 16;
                const double from_view = std::asin(std::min(1.0, std::hypot(u, v)));
                const double azimuth = std::atan2(v, u);
                inside &= std::hypot(u, v) < 1;
                const auto rgb = sampler.sample(
                    {std::sin(2 * from_view) * std::cos(azimuth),
                     std::sin(2 * from_view) * std::sin(azimuth), std::cos(2 * from_view)},
                    0);
                for (std::size_t c = 0; c < 3; ++c) mean[c] += rgb[c] / 4;
            }
            if (!inside) continue;
            ++compared;
            for (int c = 0; c < 3; ++c) {
                const double expected = mean[static_cast<std::size_t>(c)];
                ASSERT_NEAR(sheet.pixels.at(x, y, c), expected, 1e-5 * (expected + 0.01));
            }
        }
    }
    EXPECT_GT(compared, 700);
}

TEST(Preview, WhiteSurfacesVanishInWhiteLight) {
    PreviewOptions options = small_preview();
    options.materials = {kMirror, kWhitewash};
    options.background = PreviewBackground::kEnvironment;
    const CubeChain chain = unfiltered(16, 4, white);
    const PreviewChain named = {"a", &chain, {0, 0.2, 0.5, 1}};
    const PreviewSheet sheet =
        filter_preview(named, named, preview_table(), white_irradiance(), options);
    for (int row = 0; row < 6; ++row) {
        const float expected = row % 3 == 2 ? 0 : 2;
        for (int y = row * sheet.cell_px; y < (row + 1) * sheet.cell_px; ++y) {
            for (int x = 0; x < sheet.pixels.width(); ++x) {
                for (int c = 0; c < 3; ++c) {
                    ASSERT_NEAR(sheet.pixels.at(x, y, c), expected, 1e-5)
                        << x << ' ' << y << ' ' << row;
                }
            }
        }
    }
}

TEST(Preview, TablesOfBothKindsShowTheSame) {
    const BrdfTable multiscatter(BrdfTableKind::kMultiscatter, preview_table().size());
    const CubeChain chain = unfiltered(16, 2, overcast_environment);
    const PreviewChain named = {"a", &chain, {0, 1}};
    const PreviewOptions options = small_preview();
    const Image one =
        filter_preview(named, named, preview_table(), white_irradiance(), options).pixels;
    const Image other =
        filter_preview(named, named, multiscatter, white_irradiance(), options).pixels;
    for (int y = 0; y < one.height(); ++y) {
        for (int x = 0; x < one.width(); ++x) {
            ASSERT_NEAR(one.at(x, y, 0), other.at(x, y, 0), 1e-5) << x << ' ' << y;
        }
    }
}

TEST(Preview, RoughnessFindsItsLevel) {
    PreviewOptions options = small_preview();
    options.materials = {kMirror};
    options.roughness = {0, 0.1, 0.2, 0.6, 1};
    CubeChain chain;
    for (int level = 0; level < 3; ++level) {
        const auto value = static_cast<float>(std::exp2(level));
        chain.push_back(constant_environment(4 >> level, {value, value, value}));
    }
    const PreviewChain named = {"a", &chain, {0, 0.2, 1}};
    const PreviewSheet sheet =
        filter_preview(named, named, preview_table(), white_irradiance(), options);
    const double expected[] = {1, 1.5, 2, 3, 4};
    for (int column = 0; column < 5; ++column) {
        EXPECT_NEAR(sheet.pixels.at(column * sheet.cell_px + 19, 19, 0), expected[column], 1e-5);
    }
    EXPECT_EQ(sheet.columns[3], "roughness 0.6");
}

TEST(Preview, DifferenceIsThatOfTheRowsAbove) {
    const CubeChain chain = unfiltered(32, 3, studio_environment);
    CubeChain other = chain;
    for (int i = 0; i < 16; ++i) {
        other[1].at(4, i, i, 1) += 1;
        other[1].at(4, i, i, 2) -= 0.01F;
    }
    const PreviewChain a = {"a", &chain, {0, 0.5, 1}};
    const PreviewChain b = {"b", &other, {0, 0.5, 1}};
    const PreviewOptions options = small_preview();

    const PreviewSheet same = filter_preview(a, a, preview_table(), white_irradiance(), options);
    const PreviewSheet sheet = filter_preview(a, b, preview_table(), white_irradiance(), options);
    const int cell = sheet.cell_px;
    float largest = 0;
    for (int row = 2; row < 6; row += 3) {
        for (int y = row * cell; y < (row + 1) * cell; ++y) {
            for (int x = 0; x < sheet.pixels.width(); ++x) {
                for (int c = 0; c < 3; ++c) {
                    ASSERT_EQ(same.pixels.at(x, y, c), 0);
                    const float value = sheet.pixels.at(x, y, c);
                    const float above = std::abs(sheet.pixels.at(x, y - cell, c) -
                                                 sheet.pixels.at(x, y - 2 * cell, c));
                    ASSERT_EQ(value, 10 * above);
                    largest = std::max(largest, value);
                }
            }
        }
        const auto& differences = sheet.rows[static_cast<std::size_t>(row)].difference;
        ASSERT_EQ(differences.size(), options.roughness.size());
        EXPECT_EQ(differences.front(), 0);  // the environment itself
        EXPECT_GT(differences[4], 1e-4);
        EXPECT_EQ(differences.back(), 0);
        for (const double none : same.rows[static_cast<std::size_t>(row)].difference) {
            EXPECT_EQ(none, 0);
        }
    }
    EXPECT_GT(largest, 0.1);
    EXPECT_EQ(sheet.rows[3].label, "plastic: a");
    EXPECT_EQ(sheet.rows[5].label, "plastic: difference x 10");
}

// Of a room and the same room in a mirror, in both sheets.
TEST(Preview, MirroredWorldIsAMirroredPicture) {
    const auto mirrored = [](int size) {
        const CubeSampler room({interior_environment(size)});
        return make_environment(size, [&](const Direction& d) {
            return room.sample({-d.x, d.y, d.z}, 0);
        });
    };
    const CubeChain chain = {interior_environment(32), interior_environment(16)};
    const CubeChain other = {mirrored(32), mirrored(16)};
    const PreviewChain a = {"a", &chain, {0, 1}};
    const PreviewChain b = {"b", &other, {0, 1}};
    PreviewOptions options = small_preview();
    options.background = PreviewBackground::kEnvironment;
    options.roughness = {0.3};
    const PreviewSheet left = filter_preview(a, a, preview_table(), white_irradiance(), options);
    const PreviewSheet right = filter_preview(b, b, preview_table(), white_irradiance(), options);
    for (int y = 0; y < left.pixels.height(); ++y) {
        for (int x = 0; x < left.cell_px; ++x) {
            const float value = left.pixels.at(x, y, 0);
            ASSERT_NEAR(right.pixels.at(left.cell_px - 1 - x, y, 0), value, 1e-4F * (value + 0.1F));
        }
    }
}

TEST(Preview, ExposureMakesTheMeanOfTheWorldOne) {
    const auto scale_of = [](const CubeMap& environment) {
        PreviewOptions options = small_preview();
        options.sphere_px = 8;
        options.roughness = {0};
        const CubeChain chain = {environment};
        const PreviewChain named = {"a", &chain, {0}};
        return filter_preview(named, named, preview_table(), white_irradiance(), options)
            .exposure_scale;
    };
    EXPECT_NEAR(scale_of(constant_environment(8, {2, 2, 2})), 0.5, 1e-6);
    EXPECT_NEAR(scale_of(constant_environment(8, {0, 0, 1})), 1 / 0.0722, 1e-4);
    const CubeMap lamp = one_texel_environment(8, 2, 4, 4, {0, 5, 0});
    EXPECT_NEAR(scale_of(lamp), 4 * kPi / (5 * 0.7152 * texel_solid_angle_sr(4, 4, 8)), 1e-3);
    EXPECT_EQ(scale_of(CubeMap(4)), 1);
}

TEST(Preview, RefusesWhatIsOutOfRange) {
    const CubeChain chain = unfiltered(8, 2, white);
    const CubeChain none;
    const PreviewChain good = {"good", &chain, {0, 1}};
    const auto refuse = [&](const PreviewChain& named, const PreviewOptions& options) {
        EXPECT_THROW(filter_preview(good, named, preview_table(), white_irradiance(), options),
                     InvalidArgument);
        EXPECT_THROW(
            dominant_direction_preview(named, preview_table(), white_irradiance(), options),
            InvalidArgument);
    };
    const BrdfTable cloth(BrdfTableKind::kCloth, 2);
    EXPECT_THROW(filter_preview(good, good, cloth, white_irradiance(), small_preview()),
                 InvalidArgument);
    refuse({"a", nullptr, {}}, small_preview());
    refuse({"a", &none, {}}, small_preview());
    refuse({"a", &chain, {0}}, small_preview());
    refuse({"a", &chain, {0.1, 1}}, small_preview());
    refuse({"a", &chain, {0, 1.5}}, small_preview());
    PreviewOptions options = small_preview();
    options.roughness = {};
    refuse(good, options);
    options.roughness = {0, std::nan("")};
    refuse(good, options);
    options = small_preview();
    options.materials = {};
    refuse(good, options);
    options.materials = {{"bright", {1.1, 1, 1}, {0, 0, 0}}};
    refuse(good, options);
    options = small_preview();
    options.sphere_px = 4;
    refuse(good, options);
    options = small_preview();
    options.samples_per_side = 0;
    refuse(good, options);
    options = small_preview();
    options.difference_gain = 0;
    refuse(good, options);
}

}  // namespace
}  // namespace aureole::ibl
