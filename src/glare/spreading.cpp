#include "glare/spreading.h"

#include <algorithm>
#include <utility>

#include "glare/far_kernel.h"

namespace aureole::glare {
namespace {

using Reason = MethodReport::Reason;

// Looking at a whole picture is worth this share of what the fastest sure method costs; else some
// rows decide whether there is hope.
constexpr double kCheapLook = 0.06;
constexpr int kRowStep = 16;
// By how much what some rows show must be above the sure cost: they are a sample.
constexpr double kSureOfSample = 1.5;

MethodReport::Candidate& candidate(MethodReport& report, Method method) {
    return *std::find_if(report.candidates.begin(), report.candidates.end(),
                         [method](const auto& c) { return c.method == method; });
}

int raster_scale(Resolution resolution) { return resolution == Resolution::kHalf ? 2 : 4; }

}  // namespace

Spreading::Spreading(int width, int height, int channels, const Image& kernel,
                     const GlareOptions& options)
    : pixels_(static_cast<double>(width) * height),
      channel_share_(channels / 3.0),
      width_(width),
      height_(height),
      asked_(options.method) {
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
    share_inside_ = glare::share_inside(width, height, kernel);
    if (asked_ == Method::kFft || automatic) convolver_.emplace(width, height, channels, kernel);
    if (asked_ == Method::kDirect || asked_ == Method::kFft) return;
    const std::optional<FarKernel> split =
        find_far_kernel(kernel, kShareOfFarRaster * options.cluster_error);
    const FarKernel* far = split ? &*split : nullptr;
    if (asked_ == Method::kSprites || automatic) {
        SpriteOptions sprites;
        sprites.error = options.cluster_error;
        sprites.clusters.max_side = options.cluster_side;
        painter_.emplace(width, height, channels, kernel, sprites, far);
    }
    if (asked_ == Method::kHybrid || automatic) {
        hybrid_.emplace(width, height, channels, kernel, options.cluster_error, far);
    }
    if (automatic) {
        speed_ = machine_speed();
        fft_seconds_ = transform_seconds(*convolver_);
        hybrid_fft_seconds_ = transform_seconds(hybrid_->convolver());
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

void Spreading::predict(Method method, double seconds) {
    candidate(report_, method).predicted_seconds = seconds;
}

void Spreading::report_plan(double energy, double error_bound, double energy_cut,
                            std::size_t sprites) {
    report_.error_bound = energy > 0 ? error_bound / energy : 0;
    report_.energy_cut = energy > 0 ? energy_cut / energy : 0;
    report_.sprites = sprites;
}

double Spreading::plan_sprites(const ConstImageView& light, const float* weights) {
    sprites_plan_ = painter_->plan(light, weights, histogram_);
    const double passes = pixels_ * (speed_.tile + (painter_->has_far() ? speed_.far : 0));
    return channel_share_ * (passes + speed_.core * sprites_plan_.core_pixels) +
           drawing_seconds(speed_, sprites_plan_.work, light.channels);
}

double Spreading::plan_hybrid(const ConstImageView& light, const float* weights) {
    hybrid_plan_ = hybrid_->plan(light, weights, histogram_);
    const double passes = hybrid_plan_.sprites > 0 ? pixels_ * speed_.far : 0;
    return hybrid_fft_seconds_ + channel_share_ * passes +
           drawing_seconds(speed_, hybrid_plan_.work, light.channels);
}

Spreading::Bright Spreading::bright_above(float limit) const {
    Bright bright;
    bright.pixels = histogram_.pixels_above(limit);
    constexpr double kBlock = sources::BrightnessHistogram::kBlockSide;
    bright.blocks = std::max(histogram_.blocks_above(limit), bright.pixels / (kBlock * kBlock));
    return bright;
}

double Spreading::least_sprites_seconds(const Bright& bright) const {
    const bool far = painter_->has_far();
    const double passes = pixels_ * (speed_.tile + (far ? speed_.far : 0));
    const double side = 2 * painter_->core_radius() + 1;
    // One sprite for each block with light: a guess, and a low one but for a few bright among many
    // dim ones.
    const double sprites = bright.blocks * painter_->typical_area() * speed_.one_tap;
    return channel_share_ * (passes + sprites + bright.blocks * speed_.search * (far ? 2 : 1) +
                             bright.pixels * speed_.core * side * side);
}

double Spreading::least_hybrid_seconds(const Bright& bright) const {
    return hybrid_fft_seconds_ +
           channel_share_ * (pixels_ * speed_.far + bright.blocks * speed_.search);
}

bool Spreading::hopeless(double seconds) const {
    if (least_sprites_seconds(bright_above(painter_->dim_limit(histogram_))) < seconds) {
        return false;
    }
    return !hybrid_->has_far() ||
           least_hybrid_seconds(bright_above(hybrid_->dim_limit(histogram_))) >= seconds;
}

Method Spreading::choose(const ConstImageView& light, const float* weights) {
    const double start = clock_seconds();
    for (auto& c : report_.candidates) c.predicted_seconds = 0;
    double best = fft_seconds_;
    Method method = Method::kFft;
    predict(method, best);
    if (!hybrid_->has_far()) {
        const double seconds = hybrid_fft_seconds_;
        predict(Method::kHybrid, seconds);
        if (seconds < best) {
            best = seconds;
            method = Method::kHybrid;
        }
    }
    const double look = channel_share_ * speed_.histogram * pixels_;
    report_.reason = Reason::kNoGain;
    if (least_sprites_seconds({}) >= best - look &&
        (!hybrid_->has_far() || least_hybrid_seconds({}) >= best - look)) {
        return method;
    }
    report_.reason = Reason::kSample;
    if (look > kCheapLook * best) {
        histogram_.measure(light, weights, kRowStep);
        if (hopeless(kSureOfSample * best)) return method;
    }
    report_.reason = Reason::kHistogram;
    histogram_.measure(light, weights);
    if (hopeless(best)) return method;
    report_.reason = Reason::kPredicted;
    // Once planned, planning is spent: what is left to do decides.
    if (hybrid_->has_far() &&
        least_hybrid_seconds(bright_above(hybrid_->dim_limit(histogram_))) < best) {
        const double seconds = plan_hybrid(light, weights);
        predict(Method::kHybrid, clock_seconds() - start + seconds);
        if (seconds < best) {
            best = seconds;
            method = Method::kHybrid;
        }
    }
    const double before_sprites = clock_seconds();
    if (least_sprites_seconds(bright_above(painter_->dim_limit(histogram_))) < best) {
        const double seconds = plan_sprites(light, weights);
        predict(Method::kSprites, look + clock_seconds() - before_sprites + seconds);
        if (seconds < best) {
            best = seconds;
            method = Method::kSprites;
        }
    }
    return method;
}

void Spreading::run(const ConstImageView& in, const ImageView& out, const float* weights) noexcept {
    const double start = clock_seconds();
    if (asked_ == Method::kDirect) {
        fourier::convolve_directly(in, direct_kernel_, out, weights);
        report_.method = asked_;
        return;
    }
    const bool automatic = asked_ == Method::kAuto;
    report_.method = automatic ? choose(in, weights) : asked_;
    const bool planned = automatic && report_.reason == Reason::kPredicted;
    report_plan(0, 0, 0, 0);
    if (two_scale_) {
        report_plan(1, report_.raster.error, 0, 0);
        two_scale_->run(in, out, weights);
    } else if (report_.method == Method::kFft) {
        convolver_->run(in, out, weights);
    } else if (report_.method == Method::kSprites) {
        if (!planned) {
            histogram_.measure(in, weights);
            plan_sprites(in, weights);
        }
        const SpriteReport& plan = sprites_plan_.report;
        report_plan(plan.energy, plan.error_bound, plan.energy_cut,
                    plan.sprites + plan.far_sprites);
        painter_->draw(in, out, weights, histogram_);
    } else {
        if (!hybrid_->has_far()) {
            report_plan(1, hybrid_->lost(), hybrid_->lost(), 0);
        } else {
            if (!planned) {
                histogram_.measure(in, weights);
                plan_hybrid(in, weights);
            }
            report_plan(hybrid_plan_.energy, hybrid_plan_.error_bound, hybrid_plan_.energy_cut,
                        hybrid_plan_.sprites);
        }
        hybrid_->draw(in, out, weights);
    }
    candidate(report_, report_.method).actual_seconds = clock_seconds() - start;
}

}  // namespace aureole::glare
