// A kernel prepared for drawing: a smooth part for clusters, a small rough core that is applied
// pixel by pixel, the means over cells, and where its ends may be cut.
#pragma once

#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/image/image.h"
#include "aureole/sources/clusters.h"

namespace aureole::glare {

// Planes with zeros around them, for unaligned vector reads that begin or end one pixel outside.
class PaddedKernel {
  public:
    static constexpr int kMargin = 1;

    PaddedKernel() = default;
    explicit PaddedKernel(const ConstImageView& kernel);

    int width() const { return width_; }
    int height() const { return height_; }
    std::ptrdiff_t stride() const { return stride_; }
    // Of pixel (0, 0); readable from (-1, -1) to (width, height).
    const float* plane(int c) const;

  private:
    int width_ = 0;
    int height_ = 0;
    std::ptrdiff_t stride_ = 0;
    std::size_t plane_size_ = 0;
    Buffer data_;
};

// Sprites fade out over the last part of their radius, smoothly (smoothstep): no edge shows where
// they end.
inline constexpr double kFadeFrom = 0.75;  // of the radius

// How much of a kernel is lost if it fades out at a distance from its centre, and how bright it is
// there.
class KernelProfile {
  public:
    explicit KernelProfile(const ConstImageView& kernel);

    // Distances are whole pixels; from end() on there is nothing.
    int end() const { return static_cast<int>(largest_.size()); }
    // Sum of |k| that is lost if the kernel is faded out to `radius`, the largest of all channels;
    // 0 from end() on, where it is not faded.
    double lost(int radius) const;
    // The largest |k| from a radius below end() on.
    double largest_from(int radius) const { return largest_[static_cast<std::size_t>(radius)]; }
    // The least radius from which on no |k| exceeds `value`.
    int radius_below(double value) const;
    // The least radius with which at most `sum` is lost.
    int radius_losing(double sum) const;

  private:
    std::vector<double> largest_;  // |k| from this distance on
    std::vector<double> lost_;
};

// k = smooth + core: `core` ends `core_radius` pixels from the centre, where `smooth` has a rounded
// top instead of the peak. core_radius 0: no core, smooth is k.
struct SplitKernel {
    Image smooth;
    Image core;  // (2 core_radius + 1) square; empty for 0
};
SplitKernel split_kernel(const ConstImageView& kernel, int core_radius);

// The mean of the kernel over side x side shifts to the right and down: (width + side - 1) wide.
Image cell_kernel(const ConstImageView& kernel, int side);

}  // namespace aureole::glare
