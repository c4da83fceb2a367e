#include "glare/hybrid.h"

#include <algorithm>

#include "glare/sprite_painter.h"

namespace aureole::glare {
namespace {

// Of the error asked for. Near light is exact, so that the far part has all of it; light too dim
// for it is missing where it should have gone, and nowhere too much.
constexpr double kShareOfDimLight = 0.3;
constexpr double kShareOfCrop = 0.02;
constexpr double kShareOfClusters = 1 - kShareOfFarRaster - kShareOfDimLight - kShareOfCrop;

}  // namespace

Hybrid::Hybrid(int width, int height, int channels, double error, const FarKernel& split)
    : error_(error),
      far_(width, height, channels, split),
      convolver_(width, height, channels, split.near) {}

double Hybrid::dim_share() const { return std::min(1.0, kShareOfDimLight * error_ / far_.share()); }

float Hybrid::dim_limit(const sources::BrightnessHistogram& histogram) const {
    return histogram.dim_limit(dim_share()) / 2;
}

Hybrid::Plan Hybrid::plan(const ConstImageView& light, const float* weights,
                          const sources::BrightnessHistogram& histogram) {
    Plan plan;
    plan.energy = histogram.energy();
    const FarLayer::Plan distant =
        far_.plan(light, weights, histogram,
                  {.dim = dim_limit(histogram), .full = histogram.dim_limit(dim_share())},
                  kShareOfClusters * error_, kShareOfCrop * error_ * plan.energy);
    const double left_out = far_.share() * distant.energy_left;
    plan.sprites = distant.sprites;
    plan.energy_cut = distant.energy_cut + left_out;
    plan.error_bound = distant.error_bound + left_out;
    plan.work = distant.work;
    planned_ = plan.sprites;
    return plan;
}

void Hybrid::draw(const ConstImageView& light, const ImageView& out,
                  const float* weights) noexcept {
    convolver_.run(light, out, weights);
    if (planned_ == 0) return;
    far_.draw();
    far_.add_to(out, weights);
}

}  // namespace aureole::glare
