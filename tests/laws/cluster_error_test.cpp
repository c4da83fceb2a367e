// The error that sprites, hybrid and auto promise, on pictures of all kinds and with the eye's own
// kernel: what is measured against transforms is never above what is asked for, nor above the bound
// that they report.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "aureole/base/random.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/glare/glare.h"
#include "aureole/image/finite.h"
#include "aureole/image/view.h"
#include "aureole/io/picture.h"

namespace aureole {
namespace {

using glare::Method;

constexpr double kErrors[] = {0.01, 0.001};
// Rounding of transforms, of which the truth is made.
constexpr double kRounding = 2e-6;

// Sum of w |a - b| over the sum of w |light|.
double relative_error(const View& view, const Image& a, const Image& b, const Image& light) {
    const Image weights = relative_solid_angles(view);
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

void expect_bounds_hold(const std::vector<Image>& lights, const std::vector<Method>& methods,
                        int kernel_size) {
    const int width = lights[0].width();
    const int height = lights[0].height();
    const View view = View::from_fov(width, height, 40, Projection::kPerspective);
    const wave::Psf psf =
        eye::eye_psf({}, kernel_size > 0 ? wave::KernelGrid::square(view, kernel_size)
                                         : wave::KernelGrid::full_reach(view));
    glare::Glare fft(view, 3, psf);
    std::vector<Image> exact;
    for (const Image& light : lights) {
        exact.emplace_back(width, height, 3);
        fft.apply(light, exact.back());
    }
    Image out(width, height, 3);
    for (const Method method : methods) {
        for (const double error : kErrors) {
            glare::GlareOptions options;
            options.method = method;
            options.cluster_error = error;
            glare::Glare glare(view, 3, psf, options);
            for (std::size_t i = 0; i < lights.size(); ++i) {
                glare.apply(lights[i], out);
                const double measured = relative_error(view, out, exact[i], lights[i]);
                EXPECT_LE(glare.last().error_bound, error) << name_of(method) << ", picture " << i;
                EXPECT_LE(measured, glare.last().error_bound + kRounding)
                    << name_of(method) << ", picture " << i;
            }
        }
    }
}

constexpr int kWidth = 200;
constexpr int kHeight = 130;

using Color = std::array<float, 3>;

Color random_color(Random& random, double value) {
    Color color;
    for (float& c : color) c = static_cast<float>(value * random.uniform(0.05, 1));
    return color;
}

template <class Value>
Image drawn(const Value& value) {
    Image image(kWidth, kHeight, 3);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                image.at(x, y, c) = static_cast<float>(value(x, y, c));
            }
        }
    }
    return image;
}

void add_disc(Image& image, double cx, double cy, double radius, double softness,
              const Color& color) {
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const double r = std::hypot(x + 0.5 - cx, y + 0.5 - cy);
            const double cover = std::clamp((radius - r) / softness + 0.5, 0.0, 1.0);
            for (std::size_t c = 0; c < 3; ++c) {
                image.at(x, y, static_cast<int>(c)) += static_cast<float>(cover) * color[c];
            }
        }
    }
}

Image of_noise(Random& random) {
    const double spread = random.log_uniform(1.5, 1e4);
    return drawn([&](int, int, int) { return random.log_uniform(1, spread); });
}

Image of_lights(Random& random) {
    Image image(kWidth, kHeight, 3);
    const auto count = static_cast<int>(random.log_uniform(2, 60));
    for (int i = 0; i < count; ++i) {
        add_disc(image, random.uniform(0, kWidth), random.uniform(0, kHeight),
                 random.log_uniform(0.5, 25), random.log_uniform(0.5, 20),
                 random_color(random, random.log_uniform(1, 1e4)));
    }
    return image;
}

// A sky of which a part is below any limit between bright and dim.
Image of_ramp(Random& random) {
    const double decades = random.uniform(1, 6);
    const double turn = random.uniform(0, 1);
    Image image = drawn([&](int x, int y, int c) {
        const double t = turn * x / kWidth + (1 - turn) * y / kHeight;
        return std::pow(10, -decades * t) * (1 + 0.2 * c);
    });
    add_disc(image, random.uniform(0, kWidth), random.uniform(0, kHeight), 2, 1, {50, 40, 30});
    return image;
}

Image of_texture(Random& random) {
    const double period = random.uniform(2, 40);
    const double contrast = random.log_uniform(0.01, 1);
    return drawn([&](int x, int y, int c) {
        const double wave = std::sin(2 * 3.14159 * (x + c) / period) * std::cos(y / period);
        return 1 + contrast * (wave + 0.3 * random.uniform(-1, 1));
    });
}

// Each in a colour of its own.
Image of_single_pixels(Random& random) {
    Image image(kWidth, kHeight, 3);
    const auto count = static_cast<int>(random.log_uniform(1, 3000));
    for (int i = 0; i < count; ++i) {
        const auto x = static_cast<int>(random.uniform(0, kWidth));
        const auto y = static_cast<int>(random.uniform(0, kHeight));
        const Color color = random_color(random, random.log_uniform(1, 1e6));
        for (std::size_t c = 0; c < 3; ++c) image.at(x, y, static_cast<int>(c)) = color[c];
    }
    return image;
}

TEST(ClusterError, IsNeverAboveItsBoundOnTwentyPictures) {
    Random random(20);
    std::vector<Image> lights;
    for (int i = 0; i < 4; ++i) {
        for (const auto& picture : {of_noise, of_lights, of_ramp, of_texture, of_single_pixels}) {
            lights.push_back(picture(random));
        }
    }
    ASSERT_EQ(lights.size(), 20U);
    const std::vector<Method> all = {Method::kSprites, Method::kHybrid, Method::kAuto};
    expect_bounds_hold(lights, all, 65);
    expect_bounds_hold(lights, all, 0);
}

// The middle of a picture, or all of it if that is smaller.
Image middle_of(const ConstImageView& picture, int width, int height) {
    ConstImageView part = picture;
    part.width = std::min(width, picture.width);
    part.height = std::min(height, picture.height);
    part.data +=
        picture.offset((picture.width - part.width) / 2, (picture.height - part.height) / 2, 0);
    return copy(part);
}

TEST(ClusterError, IsNeverAboveItsBoundOnRealPictures) {
    const char* const folder = std::getenv("AUREOLE_TEST_IMAGES");
    if (folder == nullptr) GTEST_SKIP() << "AUREOLE_TEST_IMAGES is not set";
    int found = 0;
    for (const char* name :
         {"venice_sunset_1k.hdr", "still_life.exr", "bright_rings_nan_inf.exr"}) {
        const std::string path = std::string(folder) + "/" + name;
        if (!std::filesystem::exists(path)) continue;
        io::Picture picture = io::read_picture(path);
        if (picture.color_channels() != 3) continue;
        ++found;
        replace_nonfinite(picture.color());
        expect_bounds_hold({middle_of(picture.color(), 400, 300)},
                           {Method::kSprites, Method::kHybrid, Method::kAuto}, 129);
        // Far parts on a raster, and kernels that end early.
        expect_bounds_hold({middle_of(picture.color(), 1024, 512)},
                           {Method::kHybrid, Method::kAuto}, 0);
    }
    if (found == 0) GTEST_SKIP() << "no pictures in AUREOLE_TEST_IMAGES";
}

}  // namespace
}  // namespace aureole
