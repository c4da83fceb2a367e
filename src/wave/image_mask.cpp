#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/wave/mask_shapes.h"

namespace aureole::wave {
namespace {

// The pixels that one sample overlaps along an axis, and by what fraction of the sample.
struct Overlap {
    int first = 0;
    std::vector<float> weights;
};

// Along one axis: sample i covers [(i - n/2 - 1/2) s, (i - n/2 + 1/2) s] + centre in pixels.
std::vector<Overlap> overlaps(int samples, double pixels_per_sample, int pixels) {
    std::vector<Overlap> result(static_cast<std::size_t>(samples));
    for (int i = 0; i < samples; ++i) {
        const double low = (i - samples / 2 - 0.5) * pixels_per_sample + pixels / 2.0;
        const double high = low + pixels_per_sample;
        const auto within = [&](double x) {
            return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(pixels)));
        };
        const int first = within(std::floor(low));
        const int end = within(std::ceil(high));
        Overlap& overlap = result[static_cast<std::size_t>(i)];
        overlap.first = first;
        for (int p = first; p < end; ++p) {
            const double length = std::min(high, p + 1.0) - std::max(low, static_cast<double>(p));
            overlap.weights.push_back(
                static_cast<float>(std::max(0.0, length) / pixels_per_sample));
        }
    }
    return result;
}

}  // namespace

Mask image_mask(const ApertureGrid& grid, const ConstImageView& image, double width_mm) {
    if (image.data == nullptr || image.width < 1 || image.height < 1 || image.channels < 1) {
        throw InvalidArgument("mask picture",
                              std::to_string(image.width) + "x" + std::to_string(image.height),
                              "must have pixels");
    }
    if (!(width_mm > 0) || !std::isfinite(width_mm)) {
        throw InvalidArgument("mask width (mm)", std::to_string(width_mm),
                              "must be positive and finite");
    }
    Mask mask(grid);
    const double pixels_per_sample = grid.spacing_mm() * image.width / width_mm;
    const auto columns = overlaps(grid.samples, pixels_per_sample, image.width);
    // Rows of the picture run downwards, those of the mask upwards.
    const auto rows = overlaps(grid.samples, pixels_per_sample, image.height);
    const int channels = image.channels < 3 ? 1 : 3;
    parallel_for(static_cast<std::size_t>(grid.samples), [&](std::size_t j, int) {
        const Overlap& vertical = rows[j];
        if (vertical.weights.empty()) return;
        std::vector<float> line(static_cast<std::size_t>(image.width), 0.0F);
        for (std::size_t v = 0; v < vertical.weights.size(); ++v) {
            const int y = image.height - 1 - (vertical.first + static_cast<int>(v));
            for (int x = 0; x < image.width; ++x) {
                float value = 0;
                for (int c = 0; c < channels; ++c) value += image.at(x, y, c);
                value /= static_cast<float>(channels);
                line[static_cast<std::size_t>(x)] +=
                    vertical.weights[v] * std::clamp(value, 0.0F, 1.0F);
            }
        }
        float* out = mask.row(static_cast<int>(j));
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const Overlap& horizontal = columns[i];
            float sum = 0;
            for (std::size_t h = 0; h < horizontal.weights.size(); ++h) {
                sum += horizontal.weights[h] * line[static_cast<std::size_t>(horizontal.first) + h];
            }
            out[i] = sum;
        }
    });
    return mask;
}

}  // namespace aureole::wave
