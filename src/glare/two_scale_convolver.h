// Convolution in two parts, k = near + far (far_kernel.h): the near part by transforms at full
// resolution, which need little padding; the far part on a raster of 2 or 4 pixels,
//
//     out = near * in + B K B^T in,
//
// with weights as in fourier/convolver.h. What differs from the whole kernel is far - B K B^T, at
// most FarKernel::error of the light. Energy and centroid of what any pixel sends out are those of
// the kernel, wherever it lies between the nodes.
#pragma once

#include <optional>

#include "aureole/fourier/convolver.h"
#include "glare/far_kernel.h"
#include "glare/raster.h"

namespace aureole::glare {

class TwoScaleConvolver {
  public:
    // For pictures of width x height x channels; the kernel is not kept.
    TwoScaleConvolver(int width, int height, int channels, const FarKernel& kernel);

    // `in` and `out` may be the same memory. Allocates nothing; not to be run from two threads at
    // once.
    void run(const ConstImageView& in, const ImageView& out, const float* weights) noexcept;

    int padded_width() const { return near_.padded_width(); }
    int padded_height() const { return near_.padded_height(); }

  private:
    int scale_;
    fourier::Convolver near_;
    RasterGatherer gatherer_;
    Image raster_;
    fourier::Convolver far_;
};

// For every pixel, the share of its light that run() leaves inside the picture, one plane per
// kernel channel: exactly that, so that energies add up (energy.h).
Image share_inside(int width, int height, const FarKernel& kernel);

// The split for a raster of `scale` pixels with an error of at most kMostRasterError whose
// transforms are smaller than those of the whole kernel; nothing if there is none.
inline constexpr double kMostRasterError = 1e-3;
std::optional<FarKernel> split_for_transforms(int width, int height, const ConstImageView& kernel,
                                              int scale);

// Pixels of the transforms for a kernel of this reach, before sizes are rounded.
double needed_pixels(int width, int height, const ConstImageView& kernel);

}  // namespace aureole::glare
