// Glare of the eye at full, half and quarter resolution, as `aureole glare` applies it by default:
// times of one run, how far the results are apart, and how long it takes to prepare.
// `resolution_bench [1080|2160]`.
#include <fmt/core.h>

#include <cmath>
#include <string>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/glare/glare.h"
#include "aureole/image/view.h"
#include "medians.h"

namespace aureole::bench {
namespace {

// Noise, and lights that are a million times as bright.
Image picture(const View& view) {
    Image image(view.width, view.height, 3);
    Random random(1);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            image.plane(c)[i] = static_cast<float>(random.uniform(0, 2));
        }
    }
    for (int i = 0; i < 20; ++i) {
        const auto x = static_cast<int>(random.uniform(0, view.width));
        const auto y = static_cast<int>(random.uniform(0, view.height));
        for (int c = 0; c < 3; ++c) image.at(x, y, c) = 1e6F;
    }
    return image;
}

double relative_difference(const Image& a, const Image& b, const Image& light) {
    double difference = 0;
    double energy = 0;
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < a.pixels(); ++i) {
            difference += std::abs(static_cast<double>(a.plane(c)[i]) - b.plane(c)[i]);
            energy += static_cast<double>(light.plane(c)[i]);
        }
    }
    return difference / energy;
}

void run(int width, int height) {
    const View view = View::from_fov(width, height, 60, Projection::kPerspective);
    const wave::Psf psf = eye::eye_psf(eye::Eye{}, wave::KernelGrid::full_reach(view));
    const Image light = picture(view);
    std::vector<glare::Glare> glares;
    std::vector<double> planning_ms;
    for (const glare::Resolution resolution :
         {glare::Resolution::kFull, glare::Resolution::kHalf, glare::Resolution::kQuarter}) {
        glare::GlareOptions options;
        options.resolution = resolution;
        const double start = now_ms();
        glares.emplace_back(view, 3, psf, options);
        planning_ms.push_back(now_ms() - start);
    }
    std::vector<Image> results(3, Image(width, height, 3));
    std::vector<std::function<void()>> cases;
    for (std::size_t i = 0; i < glares.size(); ++i) {
        cases.emplace_back([&, i] { glares[i].apply(light, results[i]); });
    }
    const std::vector<double> ms = medians_ms(cases, 9);
    fmt::print("{}x{} RGB, the eye's kernel across the picture\n", width, height);
    fmt::print("{:<8} {:>8} {:>6} {:>11} {:>6} {:>9} {:>9}\n", "", "apply ms", "gain", "prepare ms",
               "near", "error", "bound");
    const char* const names[] = {"full", "half", "quarter"};
    for (std::size_t i = 0; i < glares.size(); ++i) {
        fmt::print("{:<8} {:>8.1f} {:>6.2f} {:>11.0f} {:>6} {:>9.1e} {:>9.1e}\n", names[i], ms[i],
                   ms[0] / ms[i], planning_ms[i], glares[i].last().raster.near_radius,
                   relative_difference(results[i], results[0], light),
                   glares[i].last().error_bound);
    }
}

}  // namespace
}  // namespace aureole::bench

int main(int argc, char** argv) {
    const aureole::ThreadLimit limit(2);
    const std::string height = argc > 1 ? argv[1] : "1080";
    if (height != "1080" && height != "2160") {
        fmt::print(stderr, "usage: resolution_bench [1080|2160]\n");
        return 2;
    }
    if (height == "2160") {
        aureole::bench::run(3840, 2160);
    } else {
        aureole::bench::run(1920, 1080);
    }
    return 0;
}
