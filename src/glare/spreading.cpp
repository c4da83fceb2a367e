#include "glare/spreading.h"

#include <algorithm>

#include "glare/cost_model.h"
#include "glare/far_kernel.h"
#include "glare/kernel_sums.h"

namespace aureole::glare {
namespace {

int raster_scale(Resolution resolution) { return resolution == Resolution::kHalf ? 2 : 4; }

}  // namespace

Spreading::Spreading(int width, int height, int channels, const Image& kernel,
                     const GlareOptions& options)
    : width_(width), height_(height), asked_(options.method) {
    if (asked_ == Method::kDirect) direct_kernel_ = kernel;
    const bool automatic = asked_ == Method::kAuto;
    if (options.resolution != Resolution::kFull) {
        if (const auto split =
                split_for_transforms(width, height, kernel, raster_scale(options.resolution))) {
            two_scale_.emplace(width, height, channels, *split);
            share_inside_ = glare::share_inside(width, height, *split);
            report_.raster = {split->scale, split->near_radius, split->error};
            return;
        }
    }
    share_inside_ =
        glare::share_inside(width, height, channels == 3 ? kernel_of_primaries(kernel) : kernel);
    if (asked_ == Method::kDirect) return;
    std::optional<FarKernel> split;
    if (asked_ != Method::kFft) {
        split = find_far_kernel(kernel, kShareOfFarRaster * options.cluster_error);
    }
    if (asked_ == Method::kSprites || automatic) {
        SpriteOptions sprites;
        sprites.error = options.cluster_error;
        sprites.clusters.max_side = options.cluster_side;
        painter_.emplace(width, height, channels, kernel, sprites, split ? &*split : nullptr);
    }
    if ((asked_ == Method::kHybrid || automatic) && split &&
        needed_pixels(width, height, split->near) < needed_pixels(width, height, kernel)) {
        hybrid_.emplace(width, height, channels, options.cluster_error, *split);
    }
    // A hybrid of a kernel without a far part is all transforms.
    if (asked_ == Method::kHybrid && !hybrid_) asked_ = Method::kFft;
    if (asked_ == Method::kFft || automatic) convolver_.emplace(width, height, channels, kernel);
    if (automatic) {
        choice_.emplace(*convolver_, *painter_, hybrid_ ? &*hybrid_ : nullptr, histogram_);
    }
}

int Spreading::padded_width() const {
    if (two_scale_) return two_scale_->padded_width();
    if (convolver_) return convolver_->padded_width();
    return hybrid_ ? hybrid_->convolver().padded_width() : width_;
}
int Spreading::padded_height() const {
    if (two_scale_) return two_scale_->padded_height();
    if (convolver_) return convolver_->padded_height();
    return hybrid_ ? hybrid_->convolver().padded_height() : height_;
}

void Spreading::report_plan(double energy, double error_bound, double energy_cut,
                            std::size_t sprites) {
    report_.error_bound = energy > 0 ? error_bound / energy : 0;
    report_.energy_cut = energy > 0 ? energy_cut / energy : 0;
    report_.sprites = sprites;
}

void Spreading::run_sprites(const ConstImageView& in, const ImageView& out, const float* weights,
                            const SpritePainter::Plan& plan) {
    const SpriteReport& report = plan.report;
    report_plan(report.energy, report.error_bound, report.energy_cut,
                report.sprites + report.far_sprites);
    painter_->draw(in, out, weights, histogram_);
}

void Spreading::run_hybrid(const ConstImageView& in, const ImageView& out, const float* weights,
                           const Hybrid::Plan& plan) {
    report_plan(plan.energy, plan.error_bound, plan.energy_cut, plan.sprites);
    hybrid_->draw(in, out, weights);
}

void Spreading::run(const ConstImageView& in, const ImageView& out, const float* weights) noexcept {
    const double start = clock_seconds();
    report_.method = asked_;
    report_plan(0, 0, 0, 0);
    if (choice_) choice_->choose(in, weights, report_);
    const double chosen = clock_seconds();
    switch (report_.method) {
        case Method::kDirect:
            fourier::convolve_directly(in, direct_kernel_, out, weights);
            return;
        case Method::kSprites:
            if (!choice_) histogram_.measure(in, weights, painter_->dim_share());
            run_sprites(
                in, out, weights,
                choice_ ? choice_->sprites_plan() : painter_->plan(in, weights, histogram_));
            break;
        case Method::kHybrid:
            if (!choice_) histogram_.measure(in, weights, hybrid_->dim_share());
            run_hybrid(in, out, weights,
                       choice_ ? choice_->hybrid_plan() : hybrid_->plan(in, weights, histogram_));
            break;
        default:
            if (two_scale_) {
                report_plan(1, report_.raster.error, 0, 0);
                two_scale_->run(in, out, weights);
            } else {
                convolver_->run(in, out, weights);
            }
    }
    const double end = clock_seconds();
    if (choice_) choice_->observe(end - chosen);
    std::find_if(report_.candidates.begin(), report_.candidates.end(), [this](const auto& c) {
        return c.method == report_.method;
    })->actual_seconds = end - start;
}

}  // namespace aureole::glare
