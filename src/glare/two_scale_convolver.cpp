#include "glare/two_scale_convolver.h"

#include <algorithm>

#include "aureole/glare/energy.h"

namespace aureole::glare {
namespace {

// The kernel of the transposed convolution.
Image mirrored(const Image& kernel) {
    Image result(kernel.width(), kernel.height(), kernel.channels());
    for (int c = 0; c < kernel.channels(); ++c) {
        std::reverse_copy(kernel.plane(c), kernel.plane(c) + kernel.pixels(), result.plane(c));
    }
    return result;
}

}  // namespace

TwoScaleConvolver::TwoScaleConvolver(int width, int height, int channels, const FarKernel& kernel)
    : scale_(kernel.scale),
      near_(width, height, channels, kernel.near),
      gatherer_(width, kernel.scale),
      raster_(raster_size(width, kernel.scale), raster_size(height, kernel.scale), channels),
      far_(raster_.width(), raster_.height(), channels, kernel.coarse) {}

void TwoScaleConvolver::run(const ConstImageView& in, const ImageView& out,
                            const float* weights) noexcept {
    gatherer_.run(in, weights, raster_);
    far_.run(raster_, raster_);
    near_.run(in, out, weights);
    add_between(raster_, scale_, weights, out);
}

Image share_inside(int width, int height, const FarKernel& kernel) {
    // near's own, and far's: (B K B^T)^T = B K^T B^T applied to ones.
    FarKernel transposed;
    transposed.scale = kernel.scale;
    transposed.coarse = mirrored(kernel.coarse);
    transposed.near = Image(1, 1, kernel.coarse.channels());
    Image ones(width, height, kernel.coarse.channels());
    std::fill_n(ones.plane(0), ones.pixels() * static_cast<std::size_t>(ones.channels()), 1.0F);
    Image share = share_inside(width, height, kernel.near.view());
    TwoScaleConvolver(width, height, ones.channels(), transposed).run(ones, ones, nullptr);
    for (int c = 0; c < share.channels(); ++c) {
        for (std::size_t i = 0; i < share.pixels(); ++i) share.plane(c)[i] += ones.plane(c)[i];
    }
    return share;
}

double needed_pixels(int width, int height, const ConstImageView& kernel) {
    return (width + static_cast<double>(std::min(kernel.width / 2, width - 1))) *
           (height + static_cast<double>(std::min(kernel.height / 2, height - 1)));
}

std::optional<FarKernel> split_for_transforms(int width, int height, const ConstImageView& kernel,
                                              int scale) {
    std::optional<FarKernel> split = find_far_kernel(kernel, scale, kMostRasterError);
    if (!split) return std::nullopt;
    const double two =
        needed_pixels(width, height, split->near) +
        needed_pixels(raster_size(width, scale), raster_size(height, scale), split->coarse);
    if (two >= needed_pixels(width, height, kernel)) return std::nullopt;
    return split;
}

}  // namespace aureole::glare
