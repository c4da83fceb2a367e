// The approximate methods of Glare, against its exact one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/glare/glare.h"

namespace aureole::glare {
namespace {

constexpr int kWidth = 560;
constexpr int kHeight = 530;
const Method kApproximate[] = {Method::kSprites, Method::kHybrid, Method::kAuto};

// Smooth wings across the picture, with some of the energy beyond the kernel.
wave::Psf wide_psf(const View& view, int width, int height, double power = 1.15) {
    wave::Psf psf;
    psf.grid = wave::KernelGrid::full_reach(view);
    psf.grid.width = width;
    psf.grid.height = height;
    psf.kernel = Image(width, height, 3);
    for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const double dx = x - width / 2;
                const double dy = y - height / 2;
                const double streak = std::pow(std::cos(3 * std::atan2(dy, dx)), 20);
                psf.kernel.at(x, y, c) = static_cast<float>(
                    (1 + streak) / std::pow(0.5 + (dx * dx + dy * dy) / (1 + 0.1 * c), power));
                sum += static_cast<double>(psf.kernel.at(x, y, c));
            }
        }
        for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
            psf.kernel.plane(c)[i] *= static_cast<float>(0.95 / sum);
        }
    }
    return psf;
}

View view_of(Projection projection) { return View::from_fov(kWidth, kHeight, 50, projection); }

// Lights from one pixel to twenty, over a ground that holds `ground` of their energy.
Image street(std::uint64_t seed, double ground) {
    Image image(kWidth, kHeight, 3);
    Random random(seed);
    double energy = 0;
    for (int i = 0; i < 8; ++i) {
        const double cx = random.uniform(0, kWidth);
        const double cy = random.uniform(0, kHeight);
        const double radius = random.log_uniform(0.7, 10);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                if (std::hypot(x + 0.5 - cx, y + 0.5 - cy) > radius) continue;
                for (int c = 0; c < 3; ++c) image.at(x, y, c) += 100.0F + 30.0F * (c == i % 3);
                energy += 330;
            }
        }
    }
    const double level = ground * energy / (3.0 * kWidth * kHeight);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            image.plane(c)[i] += static_cast<float>(level * random.uniform(0, 2));
        }
    }
    return image;
}

GlareOptions by(Method method, double error) {
    GlareOptions options;
    options.method = method;
    options.cluster_error = error;
    return options;
}

// Sum of w |a - b| over the sum of w |light|.
double relative_error(const View& view, const Image& a, const Image& b, const Image& light) {
    Image weights(view.width, view.height, 1);
    std::fill_n(weights.plane(0), weights.pixels(), 1.0F);
    if (view.projection == Projection::kPerspective) weights = relative_solid_angles(view);
    double difference = 0;
    double energy = 0;
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < a.pixels(); ++i) {
            const auto w = static_cast<double>(weights.plane(0)[i]);
            difference += w * std::abs(static_cast<double>(a.plane(c)[i]) - b.plane(c)[i]);
            energy += w * std::abs(static_cast<double>(light.plane(c)[i]));
        }
    }
    return difference / energy;
}

void expect_within(const View& view, const wave::Psf& psf, const std::vector<Image>& lights,
                   const std::vector<double>& errors) {
    Glare fft(view, 3, psf);
    Image exact(kWidth, kHeight, 3);
    Image out(kWidth, kHeight, 3);
    for (const Method method : kApproximate) {
        for (const double error : errors) {
            Glare glare(view, 3, psf, by(method, error));
            for (const Image& light : lights) {
                fft.apply(light, exact);
                glare.apply(light, out);
                const MethodReport& report = glare.last();
                EXPECT_LE(report.error_bound, error) << name_of(report.method);
                EXPECT_LE(relative_error(view, out, exact, light), report.error_bound + 2e-6)
                    << name_of(report.method) << " " << error;
                const Energy energy = glare.energy(light, out);
                EXPECT_NEAR((energy.out + energy.off_picture) / energy.in, 1, error + 1e-5)
                    << name_of(report.method);
                EXPECT_GE(energy.off_picture, 0.04 * energy.in);
            }
        }
    }
}

TEST(MethodsSlow, OfLargeKernelsStayWithinTheError) {
    const View view = view_of(Projection::kPerspective);
    const wave::Psf psf = wide_psf(view, 2 * kWidth - 1, 2 * kHeight - 1);
    expect_within(view, psf, {street(1, 0), street(2, 1e-3), street(3, 0.5)}, {0.01});
}

TEST(Methods, OfSmallKernelsStayWithinTheError) {
    const View view = view_of(Projection::kConstantPitch);
    for (const double power : {1.15, 2.0}) {
        expect_within(view, wide_psf(view, 201, 201, power), {street(4, 1e-4)}, {0.01, 0.001});
    }
}

TEST(Methods, HybridOfAKernelWithoutAFarPartIsAllTransforms) {
    const View view = view_of(Projection::kConstantPitch);
    const wave::Psf psf = wide_psf(view, 401, 401, 1.8);
    const Image light = street(5, 0.1);
    Glare exact(view, 3, psf);
    Glare glare(view, 3, psf, by(Method::kHybrid, 0.01));
    Image out(kWidth, kHeight, 3);
    Image truth(kWidth, kHeight, 3);
    exact.apply(light, truth);
    glare.apply(light, out);
    EXPECT_EQ(glare.last().method, Method::kFft);
    EXPECT_EQ(glare.last().energy_cut, 0);
    EXPECT_TRUE(std::equal(out.plane(0), out.plane(0) + 3 * out.pixels(), truth.plane(0)));
}

// Dominant lights alone get their far sprites.
TEST(Methods, HybridDrawsWhatMattersFarAway) {
    const View view = view_of(Projection::kConstantPitch);
    const wave::Psf psf = wide_psf(view, 2 * kWidth - 1, 2 * kHeight - 1);
    Glare exact(view, 3, psf);
    Glare glare(view, 3, psf, by(Method::kHybrid, 0.01));
    Image out(kWidth, kHeight, 3);
    glare.apply(street(6, 1e-3), out);
    EXPECT_LT(glare.padded_width(), exact.padded_width());
    EXPECT_GT(glare.last().sprites, 0U);
    EXPECT_LT(glare.last().sprites, 3000U);
}

// Lights of all brightnesses that drift: those that come to be bright enough for a far part of
// their own must not appear at once.
TEST(MethodsSlow, HybridDoesNotFlicker) {
    const View view = view_of(Projection::kConstantPitch);
    const wave::Psf psf = wide_psf(view, 2 * kWidth - 1, 2 * kHeight - 1);
    Glare glare(view, 3, psf, by(Method::kHybrid, 0.01));
    Image out(kWidth, kHeight, 3);
    std::vector<double> dark;  // mean of a patch that only far light reaches
    for (int frame = 0; frame < 24; ++frame) {
        Image light(kWidth, kHeight, 3);
        Random random(9);
        for (int i = 0; i < 200; ++i) {
            const double x = random.uniform(20, 200) + frame / 16.0;
            const double y = random.uniform(20, 200);
            const double brightness = random.log_uniform(0.1, 100);
            const int left = static_cast<int>(x);
            const auto share = static_cast<float>(x - left);
            for (int c = 0; c < 3; ++c) {
                const auto value = static_cast<float>(brightness);
                light.at(left, static_cast<int>(y), c) += (1 - share) * value;
                light.at(left + 1, static_cast<int>(y), c) += share * value;
            }
        }
        glare.apply(light, out);
        ASSERT_EQ(glare.last().method, Method::kHybrid);
        double sum = 0;
        for (int y = 500; y < 516; ++y) {
            for (int x = 520; x < 536; ++x) sum += static_cast<double>(out.at(x, y, 1));
        }
        dark.push_back(sum);
    }
    for (std::size_t i = 2; i < dark.size(); ++i) {
        EXPECT_LT(std::abs(dark[i] - 2 * dark[i - 1] + dark[i - 2]) / dark[i], 0.008) << i;
    }
}

TEST(Methods, WorkInPlaceAndWithThresholdAndMatte) {
    const View view = view_of(Projection::kPerspective);
    const wave::Psf psf = wide_psf(view, 101, 101);
    const Image light = street(7, 0.01);
    std::vector<float> matte(light.pixels(), 1.0F);
    for (std::size_t i = 0; i < matte.size(); i += 2) matte[i] = 0.5F;
    for (const Method method : kApproximate) {
        for (const bool looks : {false, true}) {
            GlareOptions options = by(method, 0.01);
            options.threshold = looks ? 20.0F : 0.0F;
            options.matte = looks;
            const float* factors = looks ? matte.data() : nullptr;
            Glare glare(view, 3, psf, options);
            Image separate(kWidth, kHeight, 3);
            glare.apply(light, separate, factors);
            const Method used = glare.last().method;
            Image image = light;
            glare.apply(image, image, factors);
            if (glare.last().method != used) continue;  // kAuto, on a busy machine
            for (int c = 0; c < 3; ++c) {
                for (std::size_t i = 0; i < image.pixels(); ++i) {
                    ASSERT_EQ(image.plane(c)[i], separate.plane(c)[i]) << name_of(used);
                }
            }
            options.method = Method::kFft;
            Image exact(kWidth, kHeight, 3);
            Glare(view, 3, psf, options).apply(light, exact, factors);
            EXPECT_LE(relative_error(view, separate, exact, light), 0.01);
        }
    }
}

TEST(Methods, OfDarknessGiveDarkness) {
    const View view = view_of(Projection::kConstantPitch);
    for (const Method method : kApproximate) {
        Glare glare(view, 3, wide_psf(view, 65, 65), by(method, 0.01));
        Image out = street(8, 1);
        glare.apply(Image(kWidth, kHeight, 3), out);
        for (std::size_t i = 0; i < out.pixels(); ++i) ASSERT_EQ(out.plane(1)[i], 0);
        EXPECT_LE(glare.last().error_bound, 0.01);
    }
}

TEST(Methods, AutoReportsWhatItChose) {
    const View view = view_of(Projection::kConstantPitch);
    const wave::Psf psf = wide_psf(view, 65, 65);
    Glare glare(view, 3, psf, by(Method::kAuto, 0.01));
    Image out(kWidth, kHeight, 3);
    glare.apply(street(9, 1), out);  // a ground that only transforms can do
    const MethodReport& report = glare.last();
    EXPECT_NE(report.method, Method::kSprites);
    EXPECT_NE(report.method, Method::kAuto);
    EXPECT_NE(report.reason, MethodReport::Reason::kAsked);
    for (const auto& candidate : report.candidates) {
        if (candidate.method == Method::kFft) {
            EXPECT_GT(candidate.predicted_seconds, 0);
        }
        EXPECT_EQ(candidate.actual_seconds > 0, candidate.method == report.method);
    }
    Glare fft(view, 3, psf);
    fft.apply(out, out);
    EXPECT_EQ(fft.last().reason, MethodReport::Reason::kAsked);
    EXPECT_EQ(fft.last().error_bound, 0);
}

TEST(Methods, HaveNames) {
    for (const Method method :
         {Method::kFft, Method::kDirect, Method::kSprites, Method::kHybrid, Method::kAuto}) {
        EXPECT_EQ(method_from_name(name_of(method)), method);
    }
    const View view = view_of(Projection::kConstantPitch);
    const wave::Psf psf = wide_psf(view, 5, 5);
    EXPECT_THROW(Glare(view, 3, psf, by(Method::kSprites, 0)), InvalidArgument);
    EXPECT_THROW(Glare(view, 3, psf, by(Method::kAuto, 1)), InvalidArgument);
    GlareOptions options;
    options.cluster_side = 24;
    EXPECT_THROW(Glare(view, 3, psf, options), InvalidArgument);
}

}  // namespace
}  // namespace aureole::glare
