#include "aureole/glare/glare.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/random.h"

namespace aureole::glare {
namespace {

// A wide, uneven, coloured kernel with a hot centre; `share` of the energy lies inside.
wave::Psf uneven_psf(const View& view, int size, double share = 0.9) {
    wave::Psf psf;
    psf.grid = wave::KernelGrid::square(view, size);
    psf.kernel = Image(size, size, 3);
    for (int c = 0; c < 3; ++c) {
        Random random(7, static_cast<std::uint64_t>(c));
        double sum = 0;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const double r = std::hypot(x - size / 2, y - size / 2);
                psf.kernel.at(x, y, c) =
                    static_cast<float>(random.uniform(0.5, 1.5) / (0.2 + r * r));
                sum += psf.kernel.at(x, y, c);
            }
        }
        for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
            psf.kernel.plane(c)[i] *= static_cast<float>(share / sum);
        }
        psf.off_kernel_energy[static_cast<std::size_t>(c)] = 1 - share;
    }
    return psf;
}

View small_view(Projection projection = Projection::kPerspective) {
    return View::from_fov(40, 30, 60, projection);
}

Image noise(const View& view) {
    Image image(view.width, view.height, 3);
    Random random(3);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            image.plane(c)[i] = static_cast<float>(random.log_uniform(1e-2, 1e3));
        }
    }
    return image;
}

void expect_near(const Image& actual, const Image& expected, double tolerance) {
    for (int c = 0; c < expected.channels(); ++c) {
        for (std::size_t i = 0; i < expected.pixels(); ++i) {
            ASSERT_NEAR(actual.plane(c)[i], expected.plane(c)[i], tolerance) << "channel " << c;
        }
    }
}

TEST(ShareInside, AgreesWithPlainSums) {
    const View view = View::from_fov(9, 6, 40, Projection::kConstantPitch);
    for (const int size : {1, 5, 17, 31}) {
        const Image kernel = uneven_psf(view, size).kernel;
        const Image share = share_inside(9, 6, kernel);
        for (int c = 0; c < 3; ++c) {
            for (int sy = 0; sy < 6; ++sy) {
                for (int sx = 0; sx < 9; ++sx) {
                    double sum = 0;
                    for (int y = 0; y < 6; ++y) {
                        for (int x = 0; x < 9; ++x) {
                            const int kx = x - sx + size / 2;
                            const int ky = y - sy + size / 2;
                            if (kx < 0 || ky < 0 || kx >= size || ky >= size) continue;
                            sum += kernel.at(kx, ky, c);
                        }
                    }
                    ASSERT_NEAR(share.at(sx, sy, c), sum, 1e-6);
                }
            }
        }
    }
}

TEST(Glare, AgreesWithTheDirectMethod) {
    for (const Projection projection : {Projection::kPerspective, Projection::kConstantPitch}) {
        const View view = small_view(projection);
        for (const int size : {1, 13, 101}) {
            const wave::Psf psf = uneven_psf(view, size);
            const Image in = noise(view);
            Image out(view.width, view.height, 3);
            Image expected(view.width, view.height, 3);
            GlareOptions direct;
            direct.method = Method::kDirect;
            Glare(view, 3, psf).apply(in, out);
            Glare(view, 3, psf, direct).apply(in, expected);
            expect_near(out, expected, 1e-6 * 1000);
        }
    }
}

TEST(Glare, OfAnIdealEyeIsThePicture) {
    const View view = small_view();
    wave::Psf psf;
    psf.grid = wave::KernelGrid::square(view, 1);
    psf.kernel = Image(1, 1, 3);
    for (int c = 0; c < 3; ++c) psf.kernel.at(0, 0, c) = 1;
    Image in = noise(view);
    in.at(3, 3, 1) = -5;  // negative values are light as well
    Image out(view.width, view.height, 3);
    Glare(view, 3, psf).apply(in, out);
    expect_near(out, in, 1e-3);
}

TEST(Glare, AccountsForEveryBitOfEnergy) {
    for (const Projection projection : {Projection::kPerspective, Projection::kConstantPitch}) {
        const View view = small_view(projection);
        const Image in = noise(view);
        Image out(view.width, view.height, 3);
        GlareOptions options;
        options.threshold = 50;
        options.gain = 2.5F;
        options.matte = true;
        std::vector<float> matte(in.pixels(), 1.0F);
        for (std::size_t i = 0; i < matte.size(); i += 3) matte[i] = 0.25F;
        Glare glare(view, 3, uneven_psf(view, 61), options);
        glare.apply(in, out, matte.data());
        const Energy energy = glare.energy(in, out, matte.data());
        EXPECT_NEAR((energy.out + energy.off_picture) / energy.in, 1, 1e-5);
        EXPECT_GT(energy.off_picture, 0.01 * energy.in);
    }
}

// Eq. 3.2 of the thesis: a pixel of .89 makes none, one of .91 makes (.91 - .9) 10000 = 100, per
// channel; and the glare is added.
TEST(Glare, AddsTheLightAboveATonesThreshold) {
    const View view = small_view(Projection::kConstantPitch);
    const wave::Psf psf = uneven_psf(view, 5, 0.8);
    GlareOptions options;
    options.threshold = 0.9F;
    options.gain = 10000;
    options.source_curve = color::ToneCurve::kNone;
    options.exposure_scale = 2;
    options.added = true;
    Image in(view.width, view.height, 3);
    in.at(20, 15, 0) = 0.91F / 2;
    in.at(20, 15, 1) = 0.89F / 2;
    in.at(20, 15, 2) = 50;  // no more than white
    Image out(view.width, view.height, 3);
    Glare glare(view, 3, psf, options);
    glare.apply(in, out);
    const std::array light = {100.0, 0.0, 1000.0};
    for (int c = 0; c < 3; ++c) {
        for (int y = -2; y <= 2; ++y) {
            for (int x = -2; x <= 2; ++x) {
                const double expected =
                    in.at(20 + x, 15 + y, c) +
                    light[static_cast<std::size_t>(c)] / 2 * psf.kernel.at(2 + x, 2 + y, c);
                ASSERT_NEAR(out.at(20 + x, 15 + y, c), expected, 2e-3) << c;
            }
        }
    }
    const Energy energy = glare.energy(in, out);
    EXPECT_NEAR(energy.added, (100 + 1000) / 2.0, 0.01);
    EXPECT_NEAR(energy.off_picture, 0.2 * energy.added, 0.01);
    EXPECT_NEAR(energy.in + energy.added, energy.out + energy.off_picture, 0.02);
}

TEST(Glare, ACurveKnowsAllChannelsAndTheMatte) {
    const View view = small_view();
    const wave::Psf psf = uneven_psf(view, 9);
    GlareOptions options;
    options.threshold = 0.9F;
    options.source_curve = color::ToneCurve::kHill;
    options.added = true;
    options.matte = true;
    const Image in = noise(view);
    const std::vector<float> none(in.pixels(), 0.0F);
    Image out(view.width, view.height, 3);
    Glare(view, 3, psf, options).apply(in, out, none.data());
    expect_near(out, in, 0);
    // A grey picture makes the glare of its colour.
    GlareOptions bright = options;
    bright.matte = false;
    Image rgb(view.width, view.height, 3);
    for (int c = 0; c < 3; ++c) rgb.at(20, 15, c) = 30;
    Image grey(view.width, view.height, 1);
    grey.at(20, 15, 0) = 30;
    Image grey_out(view.width, view.height, 1);
    Glare(view, 3, psf, bright).apply(rgb, out);
    Glare(view, 1, psf, bright).apply(grey, grey_out);
    const double luminance =
        0.2126 * out.at(22, 15, 0) + 0.7152 * out.at(22, 15, 1) + 0.0722 * out.at(22, 15, 2);
    EXPECT_NEAR(grey_out.at(22, 15, 0), luminance, 1e-5);
}

TEST(Glare, RefusesASurroundWhereNothingIsTakenAway) {
    const View view = small_view();
    GlareOptions options;
    options.added = true;
    options.surround = Surround::kSame;
    EXPECT_THROW(Glare(view, 3, uneven_psf(view, 5), options), InvalidArgument);
    options.surround = Surround::kDark;
    options.exposure_scale = 0;
    EXPECT_THROW(Glare(view, 3, uneven_psf(view, 5), options), InvalidArgument);
}

TEST(Glare, LeavesWhatIsBelowTheThreshold) {
    const View view = small_view();
    const Image in = noise(view);  // at most 1000
    Image out(view.width, view.height, 3);
    GlareOptions options;
    options.threshold = 1000;
    Glare(view, 3, uneven_psf(view, 31), options).apply(in, out);
    expect_near(out, in, 0);
}

TEST(Glare, OfGainZeroIsThePicture) {
    const View view = small_view();
    const Image in = noise(view);
    Image out(view.width, view.height, 3);
    GlareOptions options;
    options.gain = 0;
    Glare(view, 3, uneven_psf(view, 31), options).apply(in, out);
    expect_near(out, in, 0);
}

TEST(Glare, OfAMatteIsThatOfThePixelsItSelects) {
    const View view = small_view();
    const Image in = noise(view);
    std::vector<float> matte(in.pixels());
    matte[15 * 40 + 20] = 1;
    Image only(view.width, view.height, 3);
    for (int c = 0; c < 3; ++c) only.at(20, 15, c) = in.at(20, 15, c);
    const wave::Psf psf = uneven_psf(view, 31);
    Image glare_of_one(view.width, view.height, 3);
    Glare(view, 3, psf).apply(only, glare_of_one);
    GlareOptions options;
    options.matte = true;
    Image out(view.width, view.height, 3);
    Glare(view, 3, psf, options).apply(in, out, matte.data());
    Image expected = in;
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < in.pixels(); ++i) {
            expected.plane(c)[i] += glare_of_one.plane(c)[i] - only.plane(c)[i];
        }
    }
    expect_near(out, expected, 1e-3);
}

TEST(Glare, OfAFlatFieldInSurroundingsOfItsOwnIsFlat) {
    for (const Projection projection : {Projection::kPerspective, Projection::kConstantPitch}) {
        const View view = small_view(projection);
        Image in(view.width, view.height, 3);
        for (int c = 0; c < 3; ++c) std::fill_n(in.plane(c), in.pixels(), 8.0F);
        Image out(view.width, view.height, 3);
        GlareOptions options;
        options.surround = Surround::kSame;
        Glare glare(view, 3, uneven_psf(view, 31), options);
        glare.apply(in, out);
        expect_near(out, in, 1e-5);
        const Energy energy = glare.energy(in, out);
        EXPECT_NEAR((energy.out + energy.off_picture) / (energy.in + energy.from_surround), 1,
                    1e-5);
        EXPECT_GT(energy.from_surround, 0.05 * energy.in);
    }
}

// Surroundings add nothing where the border is out of the kernel's reach.
TEST(Glare, OfSurroundingsEndsAtTheKernelsReach) {
    const View view = small_view();
    const wave::Psf psf = uneven_psf(view, 9, 1.0);
    const Image in = noise(view);
    Image dark(view.width, view.height, 3);
    Image same(view.width, view.height, 3);
    GlareOptions options;
    Glare(view, 3, psf, options).apply(in, dark);
    options.surround = Surround::kSame;
    Glare(view, 3, psf, options).apply(in, same);
    EXPECT_NEAR(same.at(20, 15, 1) / dark.at(20, 15, 1), 1, 0.02);  // solid angles vary by that
    EXPECT_GT(same.at(0, 0, 1), 1.1F * dark.at(0, 0, 1));
}

TEST(Glare, WorksInPlace) {
    const View view = small_view();
    for (const float threshold : {0.0F, 20.0F}) {
        GlareOptions options;
        options.threshold = threshold;
        Glare glare(view, 3, uneven_psf(view, 31), options);
        Image image = noise(view);
        Image expected(view.width, view.height, 3);
        glare.apply(image, expected);
        glare.apply(image, image);
        expect_near(image, expected, 0);
    }
}

TEST(Glare, RefusesWhatDoesNotFit) {
    const View view = small_view();
    const wave::Psf psf = uneven_psf(view, 5);
    EXPECT_THROW(Glare(view, 2, psf), InvalidArgument);
    EXPECT_THROW(Glare(View::from_fov(40, 30, 50, Projection::kPerspective), 3, psf),
                 InvalidArgument);
    EXPECT_THROW(Glare(small_view(Projection::kConstantPitch), 3, psf), InvalidArgument);
    GlareOptions options;
    options.threshold = -1;
    EXPECT_THROW(Glare(view, 3, psf, options), InvalidArgument);
    options.threshold = 0;
    options.gain = std::nanf("");
    EXPECT_THROW(Glare(view, 3, psf, options), InvalidArgument);
    EXPECT_THROW(method_from_name("sprite"), InvalidArgument);
    EXPECT_THROW(surround_from_name("mirror"), InvalidArgument);
}

}  // namespace
}  // namespace aureole::glare
