// Glare whose kernel changes over the picture, against sums with the PSF of each source pixel.
#include "aureole/glare/varying_glare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/glare/glare.h"

namespace aureole::glare {
namespace {

Image noise(int width, int height, int channels, std::uint64_t seed, double scale) {
    Image image(width, height, channels);
    Random random(seed);
    for (std::size_t i = 0; i < image.pixels() * static_cast<std::size_t>(channels); ++i) {
        image.plane(0)[i] = static_cast<float>(scale * random.uniform());
    }
    return image;
}

// Unit energy in every colour, 10 % of it off the kernel.
wave::Psf base_psf(const View& view) {
    wave::Psf psf;
    psf.grid = wave::KernelGrid::full_reach(view);
    psf.kernel = noise(psf.grid.width, psf.grid.height, 3, 11, 1);
    for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
            sum += static_cast<double>(psf.kernel.plane(c)[i]);
        }
        for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
            psf.kernel.plane(c)[i] *= static_cast<float>(0.9 / sum);
        }
        psf.off_kernel_energy[static_cast<std::size_t>(c)] = 0.1;
    }
    return psf;
}

wave::VaryingPsf varying_psf(const View& view) {
    wave::VaryingPsf psf{base_psf(view), {{3, 2, {}, {}}, {1, 4, {}, {}}}, view};
    for (std::uint64_t n = 0; n < 6; ++n) {
        psf.parts[0].halves.push_back(fourier::right_half(noise(7, 5, 3, n, 0.02)));
    }
    for (std::uint64_t n = 0; n < 4; ++n) {
        psf.parts[1].halves.push_back(fourier::right_half(noise(21, 21, 3, 20 + n, 4e-4)));
    }
    return psf;
}

TEST(VaryingGlare, IsTheSumOverTheKernelOfEachPixel) {
    for (const Projection projection : {Projection::kPerspective, Projection::kConstantPitch}) {
        const View view = View::from_fov(23, 14, 70, projection);
        const wave::VaryingPsf psf = varying_psf(view);
        const Image in = noise(view.width, view.height, 3, 5, 1);
        VaryingGlare glare(3, psf);
        Image out(view.width, view.height, 3);
        glare.apply(in, out);

        Image expected(view.width, view.height, 3);
        for (int sy = 0; sy < view.height; ++sy) {
            for (int sx = 0; sx < view.width; ++sx) {
                const wave::Psf own = wave::psf_at(psf, sx, sy);
                for (int c = 0; c < 3; ++c) {
                    for (int y = 0; y < view.height; ++y) {
                        for (int x = 0; x < view.width; ++x) {
                            expected.at(x, y, c) += static_cast<float>(
                                view.pixel_solid_angle_sr(sx, sy) /
                                view.pixel_solid_angle_sr(x, y) *
                                static_cast<double>(in.at(sx, sy, c) *
                                                    own.kernel.at(x - sx + own.kernel.width() / 2,
                                                                  y - sy + own.kernel.height() / 2,
                                                                  c)));
                        }
                    }
                }
            }
        }
        for (std::size_t i = 0; i < 3 * out.pixels(); ++i) {
            ASSERT_NEAR(out.plane(0)[i], expected.plane(0)[i], 1e-5F) << i;
        }
    }
}

TEST(VaryingGlare, ConservesEnergy) {
    for (const int channels : {1, 3}) {
        const View view = View::from_fov(60, 40, 60, Projection::kPerspective);
        VaryingGlare glare(channels, varying_psf(view));
        Image picture = noise(60, 40, channels, 3, 1);
        picture.at(59, 0) = 1000;
        const Image in = picture;
        glare.apply(picture, picture);  // in place
        const Energy energy = glare.energy(in, picture);
        EXPECT_NEAR((energy.out + energy.off_picture) / energy.in, 1, 1e-5);
        EXPECT_GT(energy.off_picture, 0.1 * energy.in);
    }
}

TEST(VaryingGlare, WithoutAVaryingPartIsGlare) {
    const View view = View::from_fov(40, 30, 60, Projection::kPerspective);
    const wave::Psf base = base_psf(view);
    const Image in = noise(40, 30, 3, 3, 1);
    Image varying(40, 30, 3);
    VaryingGlare(3, {base, {}, view}).apply(in, varying);
    Image plain(40, 30, 3);
    Glare(view, 3, base).apply(in, plain);
    for (std::size_t i = 0; i < 3 * in.pixels(); ++i) {
        ASSERT_EQ(varying.plane(0)[i], plain.plane(0)[i]);
    }
}

TEST(VaryingGlare, RefusesAnotherView) {
    const View view = View::from_fov(40, 30, 60, Projection::kPerspective);
    wave::VaryingPsf psf = varying_psf(view);
    EXPECT_THROW(VaryingGlare(2, psf), InvalidArgument);
    psf.view = View::from_fov(40, 30, 50, Projection::kPerspective);
    EXPECT_THROW(VaryingGlare(3, psf), InvalidArgument);
}

}  // namespace
}  // namespace aureole::glare
