#include "glare/hybrid.h"

#include <algorithm>
#include <utility>

#include "glare/sprite_painter.h"
#include "glare/two_scale_convolver.h"

namespace aureole::glare {
namespace {

// Of the error asked for. Near light is exact, so that the far part has all of it; light too dim
// for it is missing where it should have gone, and nowhere too much.
constexpr double kShareOfDimLight = 0.3;
constexpr double kShareOfCrop = 0.2;
constexpr double kShareOfClusters = 1 - kShareOfFarRaster - kShareOfDimLight - kShareOfCrop;

double padded_pixels(const fourier::Convolver& convolver) {
    return static_cast<double>(convolver.padded_width()) * convolver.padded_height();
}

}  // namespace

Crop crop_of(const ConstImageView& kernel, double share) {
    const KernelProfile profile(kernel);
    // The square of this radius holds all that is less than radius + 1 away.
    const int radius = std::max(0, profile.radius_leaving(share) - 1);
    return {radius, profile.beyond(radius + 1)};
}

ConstImageView cropped(const ConstImageView& kernel, int radius) {
    const int before_x = std::min(radius, kernel.width / 2);
    const int before_y = std::min(radius, kernel.height / 2);
    ConstImageView middle = kernel;
    middle.data += kernel.offset(kernel.width / 2 - before_x, kernel.height / 2 - before_y, 0);
    middle.width = 2 * before_x + 1;
    middle.height = 2 * before_y + 1;
    return middle;
}

Hybrid::Hybrid(int width, int height, int channels, const ConstImageView& kernel, double error,
               const FarKernel* split)
    : error_(error) {
    const Crop crop = crop_of(kernel, error);
    ConstImageView near = cropped(kernel, crop.radius);
    // Even sizes have no middle that a crop could keep.
    if (kernel.width % 2 == 0 || kernel.height % 2 == 0) near = kernel;
    if (split != nullptr &&
        needed_pixels(width, height, split->near) < needed_pixels(width, height, near)) {
        near = split->near;
        far_.emplace(width, height, channels, *split);
    } else if (near.width < kernel.width || near.height < kernel.height) {
        lost_ = crop.lost;
    }
    convolver_.emplace(width, height, channels, near);
    // No kernel is cut for transforms of the same size.
    if (lost_ > 0) {
        fourier::Convolver whole(width, height, channels, kernel);
        if (padded_pixels(whole) <= padded_pixels(*convolver_)) {
            convolver_ = std::move(whole);
            lost_ = 0;
        }
    }
}

double Hybrid::dim_share() const {
    return std::min(1.0, kShareOfDimLight * error_ / far_->share());
}

float Hybrid::dim_limit(const sources::BrightnessHistogram& histogram) const {
    return histogram.dim_limit(dim_share());
}

Hybrid::Plan Hybrid::plan(const ConstImageView& light, const float* weights,
                          const sources::BrightnessHistogram& histogram) {
    Plan plan;
    plan.energy = histogram.energy();
    const FarLayer::Plan distant =
        far_->plan(light, weights, histogram, {.dim = dim_limit(histogram)},
                   kShareOfClusters * error_, kShareOfCrop * error_ * plan.energy);
    const double left_out = far_->share() * distant.energy_left;
    plan.sprites = distant.sprites;
    plan.energy_cut = distant.energy_cut + left_out;
    plan.error_bound = distant.error_bound + left_out;
    plan.work = distant.work;
    planned_ = plan.sprites;
    return plan;
}

void Hybrid::draw(const ConstImageView& light, const ImageView& out,
                  const float* weights) noexcept {
    convolver_->run(light, out, weights);
    if (!far_ || planned_ == 0) return;
    far_->draw();
    far_->add_to(out, weights);
}

}  // namespace aureole::glare
