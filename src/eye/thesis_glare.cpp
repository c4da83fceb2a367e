#include "aureole/eye/thesis_glare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"

namespace aureole::eye {
namespace {

constexpr int kCentre = kThesisTextureSide / 2;

// Per unit of light and sample of the texture, of light measured in areas of the thesis's samples.
// Its scene of 16:9 is squeezed into a square and padded to twice its size, so that a transform of
// N x N holds N / 2 rows and columns of it; what the transforms leave is the sum over samples /
// N^2. Over N / 2 rows of the texture's N samples in height H, and columns 16 / 9 as wide, that is
// (N / 2)^2 9 / 16 / N^2 = 9 / 64 per H^2.
constexpr double kThesisSum = 9.0 / 64;

// The integral of a tent of unit area around 0, up to x.
double tent_integral(double x) {
    if (x <= -1) return 0;
    if (x >= 1) return 1;
    return x < 0 ? 0.5 * (1 + x) * (1 + x) : 1 - 0.5 * (1 - x) * (1 - x);
}

// What each pixel of a row of `count` pixels, `samples_per_pixel` long and centred on the source,
// takes from the samples of a row of the texture, which is linear between them.
struct PixelWeights {
    int first = 0;
    std::vector<float> weights;
};
std::vector<PixelWeights> pixel_weights(int count, double samples_per_pixel) {
    std::vector<PixelWeights> pixels(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const double middle = kCentre + (i - count / 2) * samples_per_pixel;
        const double from = middle - 0.5 * samples_per_pixel;
        const double to = middle + 0.5 * samples_per_pixel;
        const int first = std::max(0, static_cast<int>(std::floor(from)));
        const int last = std::min(kThesisTextureSide - 1, static_cast<int>(std::ceil(to)));
        auto& pixel = pixels[static_cast<std::size_t>(i)];
        pixel.first = first;
        for (int k = first; k <= last; ++k) {
            pixel.weights.push_back(
                static_cast<float>(tent_integral(to - k) - tent_integral(from - k)));
        }
    }
    return pixels;
}

// The texture integrated over the pixels of `out`.
void integrate(const Image& texture, double samples_per_pixel, Image& out) {
    const auto columns = pixel_weights(out.width(), samples_per_pixel);
    const auto rows = pixel_weights(out.height(), samples_per_pixel);
    Image narrow(out.width(), texture.height(), texture.channels());
    const auto weighted = [](const PixelWeights& pixel, const auto& value) {
        float sum = 0;
        for (std::size_t k = 0; k < pixel.weights.size(); ++k) {
            sum += pixel.weights[k] * value(pixel.first + static_cast<int>(k));
        }
        return sum;
    };
    parallel_for(static_cast<std::size_t>(texture.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int c = 0; c < texture.channels(); ++c) {
            const float* from = texture.row(y, c);
            for (int x = 0; x < out.width(); ++x) {
                narrow.at(x, y, c) =
                    weighted(columns[static_cast<std::size_t>(x)], [&](int k) { return from[k]; });
            }
        }
    });
    parallel_for(static_cast<std::size_t>(out.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int c = 0; c < out.channels(); ++c) {
            for (int x = 0; x < out.width(); ++x) {
                out.at(x, y, c) = weighted(rows[row], [&](int k) { return narrow.at(x, k, c); });
            }
        }
    });
}

double sum_of(const Image& image, int c) {
    double sum = 0;
    std::for_each_n(image.plane(c), image.pixels(),
                    [&](float value) { sum += static_cast<double>(value); });
    return sum;
}

void require(const char* what, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw InvalidArgument(what, fmt::format("{}", value),
                          fmt::format("must be {} to {}", low, high));
}

}  // namespace

void check(const ThesisLook& look) {
    for (const ThesisTone* tone : {&look.bloom, &look.halo, &look.corona, &look.streaks}) {
        require("power", tone->power, 0.01, 10);
        require("threshold", tone->threshold, 0, 1e6);
        require("factor", tone->factor, 0, 1e9);
    }
    const std::array weights = {look.bloom_weight, look.halo_weight, look.streaks_weight,
                                look.corona_weight};
    for (const double weight : weights) require("weight", weight, 0, 1e6);
    require("gratings", look.gratings, 1, 1000);
    require("particles", look.particles, 0, 20000);
    require("eyelashes", look.eyelashes, 0, 100);
    require("wavelengths", look.wavelengths, 2, 1024);
    require("bend", look.bend, 0, 2);
    require("height (deg)", look.height_deg, 1, 120);
}

ThesisGlare thesis_glare(const ThesisLook& look, const ThesisFrames& frames, const View& view,
                         Progress* progress) {
    check(look);
    Image sum(kThesisTextureSide, kThesisTextureSide, 3);
    const struct {
        Component component;
        double weight;
    } parts[] = {{Component::kBloom, look.bloom_weight},
                 {Component::kHalo, look.halo_weight},
                 {Component::kStreaks, look.streaks_weight},
                 {Component::kCorona, look.corona_weight}};
    double done = 0;
    for (const auto& [component, weight] : parts) {
        if (progress != nullptr) {
            progress->report("eye psf", done);
            if (progress->cancelled()) throw Cancelled();
        }
        done += 0.24;
        if (weight == 0) continue;
        const Image texture = thesis_texture(component, look, frames);
        const auto w = static_cast<float>(weight);
        std::transform(texture.plane(0), texture.plane(0) + 3 * texture.pixels(), sum.plane(0),
                       sum.plane(0), [w](float part, float all) { return all + w * part; });
    }
    const std::array<double, 3> total = {sum_of(sum, 0), sum_of(sum, 1), sum_of(sum, 2)};
    if (!(std::min({total[0], total[1], total[2]}) > 0)) {
        throw InvalidArgument("weights of the components leave no glare");
    }
    for (int c = 0; c < 3; ++c) {
        const auto scale = static_cast<float>(1 / total[static_cast<std::size_t>(c)]);
        std::for_each_n(sum.plane(c), sum.pixels(), [scale](float& value) { value *= scale; });
    }

    const double half_height = rad_from_deg(0.5 * look.height_deg);
    const double height_px =
        2 * view.focal_length_px() *
        (view.projection == Projection::kPerspective ? std::tan(half_height) : half_height);
    const double samples_per_pixel = kThesisSamples / height_px;
    const int reach = static_cast<int>(std::ceil((kCentre + 1) / samples_per_pixel));
    ThesisGlare glare;
    glare.psf.grid = wave::KernelGrid::full_reach(view);
    glare.psf.grid.width = std::min(glare.psf.grid.width, 2 * reach + 1);
    glare.psf.grid.height = std::min(glare.psf.grid.height, 2 * reach + 1);
    glare.psf.kernel = Image(glare.psf.grid.width, glare.psf.grid.height, 3);
    integrate(sum, samples_per_pixel, glare.psf.kernel);
    for (int c = 0; c < 3; ++c) {
        glare.psf.off_kernel_energy[static_cast<std::size_t>(c)] =
            std::max(0.0, 1 - sum_of(glare.psf.kernel, c));
    }
    glare.energy = kThesisSum * (total[0] + total[1] + total[2]) / 3 /
                   (kThesisSamples * static_cast<double>(kThesisSamples));
    if (progress != nullptr) progress->report("eye psf", 1);
    return glare;
}

}  // namespace aureole::eye
