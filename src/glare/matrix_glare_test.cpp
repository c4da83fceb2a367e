// Glare with a PSF that leads light from colour to colour.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/glare/glare.h"

namespace aureole::glare {
namespace {

View small_view() {
    View view;
    view.width = 40;
    view.height = 30;
    view.axis_x = 20;
    view.axis_y = 15;
    view.pitch_deg = 0.5;
    view.projection = Projection::kPerspective;
    return view;
}

// Noise whose channels sum as those of such a PSF do.
wave::Psf noise_matrix(const View& view) {
    wave::Psf psf;
    psf.grid = wave::KernelGrid::square(view, 31);
    psf.kernel = Image(31, 31, 9);
    Random random(7);
    for (int channel = 0; channel < 9; ++channel) {
        double sum = 0;
        for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
            const auto value = static_cast<float>(random.normal() / 961);
            psf.kernel.plane(channel)[i] = value;
            sum += static_cast<double>(value);
        }
        const double goal = channel / 3 == channel % 3 ? 0.9 : 0;
        psf.kernel.at(15, 15, channel) += static_cast<float>(goal - sum);
    }
    return psf;
}

Image noise_picture(const View& view) {
    Image picture(view.width, view.height, 3);
    Random random(3);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < picture.pixels(); ++i) {
            picture.plane(c)[i] = static_cast<float>(random.uniform());
        }
    }
    return picture;
}

TEST(MatrixGlare, FftAgreesWithTheDirectSumAndAccountsForTheLight) {
    const View view = small_view();
    const wave::Psf psf = noise_matrix(view);
    const Image in = noise_picture(view);
    GlareOptions options;
    options.threshold = 0.2F;
    options.gain = 1.5F;
    Glare fft(view, 3, psf, options);
    options.method = Method::kDirect;
    Glare direct(view, 3, psf, options);
    Image out(view.width, view.height, 3);
    Image expected(view.width, view.height, 3);
    fft.apply(in, out);
    direct.apply(in, expected);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < in.pixels(); ++i) {
            ASSERT_NEAR(out.plane(c)[i], expected.plane(c)[i], 1e-5F);
        }
    }
    const Energy energy = fft.energy(in, out);
    EXPECT_GT(energy.off_picture, 0.01 * energy.in);
    EXPECT_NEAR(energy.in, energy.out + energy.off_picture, 1e-5 * energy.in);
}

TEST(MatrixGlare, RefusesWhatItCannotDo) {
    const View view = small_view();
    const wave::Psf psf = noise_matrix(view);
    GlareOptions options;
    options.method = Method::kSprites;
    EXPECT_THROW(Glare(view, 3, psf, options), InvalidArgument);
    options.method = Method::kFft;
    options.surround = Surround::kSame;
    EXPECT_THROW(Glare(view, 3, psf, options), InvalidArgument);
}

// Grey pictures are as if they were white.
TEST(MatrixGlare, GreyPicturesSeeTheLuminanceOfWhite) {
    const View view = small_view();
    const wave::Psf matrix = noise_matrix(view);
    wave::Psf white = matrix;
    white.kernel = Image(31, 31, 3);
    for (int channel = 0; channel < 9; ++channel) {
        for (std::size_t i = 0; i < white.kernel.pixels(); ++i) {
            white.kernel.plane(channel % 3)[i] += matrix.kernel.plane(channel)[i];
        }
    }
    const Image picture = noise_picture(view);
    const ConstImageView grey = picture.view().channel_range(0, 1);
    Image out(view.width, view.height, 1);
    Image expected(view.width, view.height, 1);
    Glare(view, 1, matrix).apply(grey, out);
    Glare(view, 1, white).apply(grey, expected);
    for (std::size_t i = 0; i < out.pixels(); ++i) {
        ASSERT_NEAR(out.plane(0)[i], expected.plane(0)[i], 1e-6F);
    }
}

}  // namespace
}  // namespace aureole::glare
