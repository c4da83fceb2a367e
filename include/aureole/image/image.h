// Pictures in memory: 32-bit float, linear, one plane per channel.
#pragma once

#include <cstddef>
#include <vector>

#include "aureole/base/buffer.h"

namespace aureole {

// A read-only picture in anyone's memory. Sample (x, y, c) is
// data[x * pixel_stride + y * row_stride + c * channel_stride]; strides count floats, so both
// planar (pixel_stride 1) and interleaved (channel_stride 1) memory can be seen without copying.
// x runs to the right in [0, width), y downwards in [0, height).
struct ConstImageView {
    const float* data = nullptr;
    int width = 0;
    int height = 0;
    int channels = 0;
    std::ptrdiff_t pixel_stride = 1;
    std::ptrdiff_t row_stride = 0;
    std::ptrdiff_t channel_stride = 0;

    float at(int x, int y, int c) const { return data[offset(x, y, c)]; }
    std::ptrdiff_t offset(int x, int y, int c) const {
        return x * pixel_stride + y * row_stride + c * channel_stride;
    }
    std::size_t pixels() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    // `count` consecutive channels starting at `first`.
    ConstImageView channel_range(int first, int count) const {
        ConstImageView view = *this;
        view.data += first * channel_stride;
        view.channels = count;
        return view;
    }
};

// The same, writable.
struct ImageView {
    float* data = nullptr;
    int width = 0;
    int height = 0;
    int channels = 0;
    std::ptrdiff_t pixel_stride = 1;
    std::ptrdiff_t row_stride = 0;
    std::ptrdiff_t channel_stride = 0;

    float& at(int x, int y, int c) const {
        return data[x * pixel_stride + y * row_stride + c * channel_stride];
    }
    ImageView channel_range(int first, int count) const {
        ImageView view = *this;
        view.data += first * channel_stride;
        view.channels = count;
        return view;
    }
    operator ConstImageView() const {  // NOLINT(google-explicit-constructor)
        return {data, width, height, channels, pixel_stride, row_stride, channel_stride};
    }
};

// Views of interleaved memory (RGBRGB...), tightly packed.
ConstImageView interleaved_view(const float* data, int width, int height, int channels);
ImageView interleaved_view(float* data, int width, int height, int channels);

// An owned picture: planar, tightly packed, initialised to 0. Copy and move as a value.
class Image {
  public:
    Image() = default;
    // Throws InvalidArgument unless width, height and channels are positive.
    Image(int width, int height, int channels);

    int width() const noexcept { return width_; }
    int height() const noexcept { return height_; }
    int channels() const noexcept { return channels_; }
    bool empty() const noexcept { return data_.empty(); }
    std::size_t pixels() const noexcept {
        return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    }

    float* plane(int c) noexcept { return data_.data() + pixels() * static_cast<std::size_t>(c); }
    const float* plane(int c) const noexcept {
        return data_.data() + pixels() * static_cast<std::size_t>(c);
    }
    float* row(int y, int c) noexcept { return plane(c) + row_offset(y); }
    const float* row(int y, int c) const noexcept { return plane(c) + row_offset(y); }
    float& at(int x, int y, int c = 0) noexcept { return row(y, c)[x]; }
    float at(int x, int y, int c = 0) const noexcept { return row(y, c)[x]; }

    ImageView view() noexcept;
    ConstImageView view() const noexcept;
    operator ImageView() noexcept { return view(); }             // NOLINT
    operator ConstImageView() const noexcept { return view(); }  // NOLINT

  private:
    std::size_t row_offset(int y) const noexcept {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
    }
    int width_ = 0;
    int height_ = 0;
    int channels_ = 0;
    std::vector<float, AlignedAllocator<float>> data_;
};

// A planar copy of any view.
Image copy(const ConstImageView& view);

}  // namespace aureole
