#include "aureole/image/image.h"

#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"

namespace aureole {

Image::Image(int width, int height, int channels)
    : width_(width), height_(height), channels_(channels) {
    if (width <= 0 || height <= 0 || channels <= 0) {
        throw InvalidArgument("image size",
                              std::to_string(width) + "x" + std::to_string(height) + ", " +
                                  std::to_string(channels) + " channels",
                              "all three must be positive");
    }
    data_.resize(pixels() * static_cast<std::size_t>(channels));
}

ImageView Image::view() noexcept {
    return {
        data_.data(), width_, height_, channels_, 1, width_, static_cast<std::ptrdiff_t>(pixels())};
}

ConstImageView Image::view() const noexcept {
    return {
        data_.data(), width_, height_, channels_, 1, width_, static_cast<std::ptrdiff_t>(pixels())};
}

ConstImageView interleaved_view(const float* data, int width, int height, int channels) {
    return {data, width, height, channels, channels, std::ptrdiff_t{width} * channels, 1};
}

ImageView interleaved_view(float* data, int width, int height, int channels) {
    return {data, width, height, channels, channels, std::ptrdiff_t{width} * channels, 1};
}

Image copy(const ConstImageView& view) {
    Image result(view.width, view.height, view.channels);
    parallel_for(static_cast<std::size_t>(view.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int c = 0; c < view.channels; ++c) {
            float* out = result.row(y, c);
            for (int x = 0; x < view.width; ++x) out[x] = view.at(x, y, c);
        }
    });
    return result;
}

}  // namespace aureole
