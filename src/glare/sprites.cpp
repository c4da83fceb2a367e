#include "aureole/glare/sprites.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "aureole/base/error.h"
#include "aureole/sources/brightness_histogram.h"
#include "glare/far_kernel.h"
#include "glare/sprite_painter.h"

namespace aureole::glare {
namespace {

constexpr int kLargestCellKernel = 1025;

void check(int width, int height, int channels, const ConstImageView& kernel,
           const SpriteOptions& options) {
    if (width < 1 || height < 1) {
        throw InvalidArgument("picture", fmt::format("{}x{}", width, height), "must have pixels");
    }
    if (channels != 1 && channels != 3) {
        throw InvalidArgument("channels", fmt::format("{}", channels), "must be 3, or 1 for grey");
    }
    if (kernel.data == nullptr || kernel.width < 1 || kernel.height < 1 ||
        (kernel.channels != 1 && kernel.channels != channels)) {
        throw InvalidArgument("kernel",
                              fmt::format("{}x{}x{}", kernel.width, kernel.height, kernel.channels),
                              fmt::format("must have pixels, and 1 or {} channels", channels));
    }
    if (!(options.error > 0 && options.error < 1)) {
        throw InvalidArgument("error of sprites", fmt::format("{}", options.error),
                              "must be in (0, 1)");
    }
    if (options.clusters.criterion == sources::ClusterOptions::Criterion::kSimilarColor &&
        std::max(kernel.width, kernel.height) > kLargestCellKernel) {
        throw InvalidArgument(
            "kernel", fmt::format("{}x{}", kernel.width, kernel.height),
            fmt::format("clusters of similar colour take kernels of up to {0} x {0} pixels",
                        kLargestCellKernel));
    }
}

}  // namespace

struct Sprites::Impl {
    sources::BrightnessHistogram histogram;
    SpritePainter painter;
};

Sprites::Sprites(int width, int height, int channels, const ConstImageView& kernel,
                 const SpriteOptions& options) {
    check(width, height, channels, kernel, options);
    std::optional<FarKernel> split;
    if (options.clusters.criterion == sources::ClusterOptions::Criterion::kBoundedError) {
        split = find_far_kernel(kernel, kShareOfFarRaster * options.error);
    }
    impl_ = std::make_unique<Impl>(Impl{
        {}, SpritePainter(width, height, channels, kernel, options, split ? &*split : nullptr)});
}
Sprites::~Sprites() = default;
Sprites::Sprites(Sprites&&) noexcept = default;
Sprites& Sprites::operator=(Sprites&&) noexcept = default;

SpriteReport Sprites::apply(const ConstImageView& light, const ImageView& out,
                            const float* weights) {
    impl_->histogram.measure(light, weights, impl_->painter.dim_share());
    const SpriteReport report = impl_->painter.plan(light, weights, impl_->histogram).report;
    impl_->painter.draw(light, out, weights, impl_->histogram);
    return report;
}

}  // namespace aureole::glare
