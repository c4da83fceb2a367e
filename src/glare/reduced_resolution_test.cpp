// Glare whose far part is computed on a raster, against that at full resolution.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/glare/glare.h"

namespace aureole::glare {
namespace {

constexpr int kWidth = 301;  // no multiple of a raster
constexpr int kHeight = 263;
constexpr Resolution kReduced[] = {Resolution::kHalf, Resolution::kQuarter};

View view_of(Projection projection = Projection::kConstantPitch) {
    return View::from_fov(kWidth, kHeight, 50, projection);
}

// A hot centre, six streaks and smooth wings across the picture; 95 % of the energy within.
wave::Psf wide_psf(const View& view) {
    wave::Psf psf;
    psf.grid = wave::KernelGrid::full_reach(view);
    psf.kernel = Image(psf.grid.width, psf.grid.height, 3);
    for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int y = 0; y < psf.grid.height; ++y) {
            for (int x = 0; x < psf.grid.width; ++x) {
                const double dx = x - psf.grid.width / 2;
                const double dy = y - psf.grid.height / 2;
                const double streak = std::pow(std::cos(3 * std::atan2(dy, dx)), 20);
                psf.kernel.at(x, y, c) = static_cast<float>(
                    (1 + streak) / std::pow(0.3 + (dx * dx + dy * dy) / (1 + 0.1 * c), 1.15));
                sum += static_cast<double>(psf.kernel.at(x, y, c));
            }
        }
        for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
            psf.kernel.plane(c)[i] *= static_cast<float>(0.95 / sum);
        }
    }
    return psf;
}

GlareOptions at(Resolution resolution) {
    GlareOptions options;
    options.resolution = resolution;
    return options;
}

// Noise over four decades, small lights and a large one.
Image rough_picture(std::uint64_t seed) {
    Image image(kWidth, kHeight, 3);
    Random random(seed);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            image.plane(c)[i] = static_cast<float>(random.log_uniform(1e-2, 1e2));
        }
    }
    for (int i = 0; i < 20; ++i) {
        image.at(static_cast<int>(random.uniform(0, kWidth)),
                 static_cast<int>(random.uniform(0, kHeight)), i % 3) = 1e5F;
    }
    image.at(0, 0, 1) = 1e5F;
    image.at(kWidth - 1, kHeight - 1, 2) = 1e5F;
    for (int y = 100; y < 140; ++y) {
        for (int x = 50; x < 120; ++x) image.at(x, y, 0) = 3e3F;
    }
    return image;
}

double relative_error(const Image& a, const Image& b, const Image& light, const View& view) {
    const Image weights = relative_solid_angles(view);
    double difference = 0;
    double energy = 0;
    for (int c = 0; c < light.channels(); ++c) {
        for (std::size_t i = 0; i < light.pixels(); ++i) {
            const auto w = static_cast<double>(weights.plane(0)[i]);
            difference += w * std::abs(static_cast<double>(a.plane(c)[i]) - b.plane(c)[i]);
            energy += w * static_cast<double>(light.plane(c)[i]);
        }
    }
    return difference / energy;
}

void expect_same(const Image& a, const Image& b) {
    for (int c = 0; c < a.channels(); ++c) {
        for (std::size_t i = 0; i < a.pixels(); ++i) ASSERT_EQ(a.plane(c)[i], b.plane(c)[i]);
    }
}

TEST(ReducedResolution, StaysWithinTheErrorReported) {
    for (const Projection projection : {Projection::kConstantPitch, Projection::kPerspective}) {
        const View view = view_of(projection);
        const wave::Psf psf = wide_psf(view);
        Glare full(view, 3, psf);
        const Image in = rough_picture(1);
        Image exact(kWidth, kHeight, 3);
        Image out(kWidth, kHeight, 3);
        full.apply(in, exact);
        for (const Resolution resolution : kReduced) {
            Glare glare(view, 3, psf, at(resolution));
            glare.apply(in, out);
            const MethodReport& report = glare.last();
            EXPECT_EQ(report.raster.scale, resolution == Resolution::kHalf ? 2 : 4);
            EXPECT_GT(report.error_bound, 0);
            EXPECT_LE(report.error_bound, 1e-3);
            EXPECT_EQ(report.error_bound, report.raster.error);
            EXPECT_LE(relative_error(out, exact, in, view), report.error_bound);
            EXPECT_LT(glare.padded_width(), full.padded_width());
        }
    }
}

// Pixels next to bright ones keep the contrast they have at full resolution, as do the darkest.
TEST(ReducedResolution, KeepsTextures) {
    const View view = view_of();
    const wave::Psf psf = wide_psf(view);
    const Image in = rough_picture(2);
    Image exact(kWidth, kHeight, 3);
    Image out(kWidth, kHeight, 3);
    Glare(view, 3, psf).apply(in, exact);
    for (const Resolution resolution : kReduced) {
        Glare(view, 3, psf, at(resolution)).apply(in, out);
        for (int c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < in.pixels(); ++i) {
                ASSERT_NEAR(out.plane(c)[i] / exact.plane(c)[i], 1, 4e-3);
            }
        }
    }
}

// To rounding, wherever lights are between the nodes, and at the picture's border.
TEST(ReducedResolution, AccountsForEveryBitOfEnergy) {
    for (const Projection projection : {Projection::kConstantPitch, Projection::kPerspective}) {
        const View view = view_of(projection);
        const wave::Psf psf = wide_psf(view);
        std::vector<float> matte(std::size_t{kWidth} * kHeight, 1.0F);
        for (std::size_t i = 0; i < matte.size(); i += 3) matte[i] = 0.25F;
        for (const Resolution resolution : kReduced) {
            GlareOptions looks = at(resolution);
            looks.threshold = 5;
            looks.gain = 2;
            looks.matte = true;
            Image out(kWidth, kHeight, 3);
            for (const GlareOptions& options : {at(resolution), looks}) {
                const float* factors = options.matte ? matte.data() : nullptr;
                Glare glare(view, 3, psf, options);
                for (const auto& [x, y] : {std::pair{0, 0}, {1, 131}, {150, 132}, {300, 262}}) {
                    Image light(kWidth, kHeight, 3);
                    for (int c = 0; c < 3; ++c) light.at(x, y, c) = 1000;
                    glare.apply(light, out, factors);
                    const Energy energy = glare.energy(light, out, factors);
                    EXPECT_NEAR((energy.out + energy.off_picture) / energy.in, 1, 2e-6);
                }
            }
        }
    }
}

TEST(ReducedResolution, OfAFlatFieldInSurroundingsOfItsOwnIsFlat) {
    for (const Projection projection : {Projection::kConstantPitch, Projection::kPerspective}) {
        const View view = view_of(projection);
        GlareOptions options = at(Resolution::kQuarter);
        options.surround = Surround::kSame;
        Glare glare(view, 1, wide_psf(view), options);
        Image field(kWidth, kHeight, 1);
        std::fill_n(field.plane(0), field.pixels(), 8.0F);
        glare.apply(field, field);
        for (std::size_t i = 0; i < field.pixels(); ++i) {
            ASSERT_NEAR(field.plane(0)[i], 8, 2e-5);
        }
    }
}

TEST(ReducedResolution, WorksInPlaceWithAnyThreadsAndStrides) {
    const View view = view_of(Projection::kPerspective);
    Glare glare(view, 3, wide_psf(view), at(Resolution::kQuarter));
    const Image in = rough_picture(3);
    Image expected(kWidth, kHeight, 3);
    glare.apply(in, expected);
    Image image = in;
    glare.apply(image, image);
    expect_same(image, expected);
    const ThreadLimit one(1);
    glare.apply(in, image);
    expect_same(image, expected);
    std::vector<float> interleaved(in.pixels() * 3);
    const ImageView view3 = interleaved_view(interleaved.data(), kWidth, kHeight, 3);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) view3.at(x, y, c) = in.at(x, y, c);
        }
    }
    glare.apply(view3, view3);
    const Image mixed = copy(view3);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < in.pixels(); ++i) {
            ASSERT_NEAR(mixed.plane(c)[i], expected.plane(c)[i],
                        1e-5F * std::abs(expected.plane(c)[i]));
        }
    }
}

// A kernel as rough as noise has no far part that a raster could hold; a small one has none at all.
TEST(ReducedResolution, IsFullWhereARasterWouldBeWrongOrSaveNothing) {
    const View view = view_of();
    wave::Psf rough = wide_psf(view);
    Random random(4);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < rough.kernel.pixels(); ++i) {
            rough.kernel.plane(c)[i] *= static_cast<float>(random.uniform(0, 2));
        }
    }
    wave::Psf small = wide_psf(View::from_fov(50, 50, view.pitch_deg * 50, view.projection));
    const Image in = rough_picture(5);
    Image exact(kWidth, kHeight, 3);
    Image out(kWidth, kHeight, 3);
    for (const wave::Psf* psf : {&rough, &small}) {
        Glare(view, 3, *psf).apply(in, exact);
        Glare glare(view, 3, *psf, at(Resolution::kHalf));
        glare.apply(in, out);
        EXPECT_EQ(glare.last().raster.scale, 1);
        EXPECT_EQ(glare.last().error_bound, 0);
        expect_same(out, exact);
    }
}

TEST(ReducedResolution, IsForTransformsOnly) {
    const View view = view_of();
    const wave::Psf psf = wide_psf(view);
    for (const Method method :
         {Method::kDirect, Method::kSprites, Method::kHybrid, Method::kAuto}) {
        GlareOptions options = at(Resolution::kHalf);
        options.method = method;
        EXPECT_THROW(Glare(view, 3, psf, options), InvalidArgument);
    }
    for (const Resolution resolution :
         {Resolution::kFull, Resolution::kHalf, Resolution::kQuarter}) {
        EXPECT_EQ(resolution_from_name(name_of(resolution)), resolution);
    }
    EXPECT_THROW(resolution_from_name("eighth"), InvalidArgument);
}

}  // namespace
}  // namespace aureole::glare
