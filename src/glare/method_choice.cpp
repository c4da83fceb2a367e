#include "glare/method_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "aureole/base/units.h"

namespace aureole::glare {
namespace {

using Reason = MethodReport::Reason;
using sources::BrightArea;

constexpr double kNever = std::numeric_limits<double>::infinity();
// Approximate methods must be that much faster: predictions are not better, and transforms exact.
constexpr double kWorthIt = 0.95;
// From so many blocks on, one of kSampleStep is looked at before all of them are.
constexpr std::size_t kManyBlocks = 400;
constexpr int kSampleStep = 8;
// Of what transforms cost: by how much predictions may be wrong before they are corrected.
constexpr double kSurprise = 0.1;
// Sprites for each edge pixel of even lights, and far ones for each block with light, as long as no
// picture has told.
constexpr double kSpritesPerEdgePixel = 0.7;
constexpr double kFarSpritesPerBlock = 0.8;
// Times the search of a block: trees of far clusters are two levels deeper.
constexpr double kFarSearch = 2;
// Of sprites, the others being single pixels and cells.
constexpr double kBetweenPixels = 0.5;

double pixels_of(const fourier::Convolver& convolver) {
    return static_cast<double>(convolver.width()) * convolver.height();
}

double elapsed(double start) { return clock_seconds() - start; }

MethodReport::Candidate& candidate(MethodReport& report, Method method) {
    return *std::find_if(report.candidates.begin(), report.candidates.end(),
                         [method](const auto& c) { return c.method == method; });
}

}  // namespace

double CostCorrection::of(Method method) const {
    return std::exp(pace_ + model_[static_cast<std::size_t>(method)]);
}

void CostCorrection::observe(Method method, double predicted_seconds, double actual_seconds,
                             double matters) {
    constexpr double kLearned = 0.6;  // of each surprise
    constexpr double kMost = 1.4;     // 4 times
    const auto i = static_cast<std::size_t>(method);
    if (!warm_[i]) {
        warm_[i] = true;
        return;
    }
    if (std::abs(actual_seconds - of(method) * predicted_seconds) < matters) return;
    const double seen = std::clamp(std::log(actual_seconds / predicted_seconds), -kMost, kMost);
    const double surprise = kLearned * (seen - pace_ - model_[i]);
    pace_ += 0.5 * surprise;
    model_[i] += 0.5 * surprise;
}

MethodChoice::MethodChoice(fourier::Convolver& convolver, SpritePainter& painter, Hybrid* hybrid,
                           sources::BrightnessHistogram& histogram)
    : painter_(painter),
      hybrid_(hybrid),
      histogram_(histogram),
      pixels_(pixels_of(convolver)),
      channel_share_(convolver.channels() / 3.0),
      speed_(machine_speed()),
      fft_seconds_(transform_seconds(convolver)),
      hybrid_fft_seconds_(hybrid == nullptr ? 0 : transform_seconds(hybrid->convolver())) {
    const int channels = convolver.channels();
    near_speed_ = drawing_speed(painter.near(), channels);
    seconds_per_edge_pixel_ =
        kSpritesPerEdgePixel *
        near_speed_.seconds(
            typical_work(painter.near(), std::sqrt(painter.typical_area() / kPi), kBetweenPixels));
    const auto far_speed = [&](FarLayer* far, DrawingSpeed& speed) {
        if (far == nullptr) return 0.0;
        speed = drawing_speed(far->layer(), channels);
        return kFarSpritesPerBlock *
               speed.seconds(typical_work(far->layer(), far->layer().profile().end(), 1));
    };
    far_seconds_per_block_ = far_speed(painter.far(), far_speed_);
    hybrid_seconds_per_block_ =
        far_speed(hybrid == nullptr ? nullptr : &hybrid->far(), hybrid_far_speed_);
}

double MethodChoice::sprites_seconds(const BrightArea& area) const {
    const bool far = painter_.has_far();
    const double side = 2 * painter_.core_radius() + 1;
    const double passes =
        speed_.pass * pixels_ + speed_.lit * lit_pixels_ + (far ? speed_.far * pixels_ : 0) +
        speed_.core * area.pixels * side * side + speed_.search * area.edge_pixels;
    return channel_share_ * passes + seconds_per_edge_pixel_ * area.edge_pixels +
           far_seconds_per_block_ * area.blocks;
}

double MethodChoice::planned_sprites_seconds() const {
    const SpritePainter::Plan& plan = sprites_plan_;
    const double passes = speed_.pass * pixels_ + speed_.lit * plan.lit_pixels +
                          speed_.core * plan.core_pixels +
                          (painter_.has_far() ? speed_.far * pixels_ : 0);
    return channel_share_ * passes + near_speed_.seconds(plan.near) + far_speed_.seconds(plan.far);
}

double MethodChoice::hybrid_seconds(const BrightArea& area) const {
    return hybrid_fft_seconds_ +
           channel_share_ * (speed_.far * pixels_ + kFarSearch * speed_.search * area.blocks) +
           hybrid_seconds_per_block_ * area.blocks;
}

double MethodChoice::planned_hybrid_seconds() const {
    const double pass = hybrid_plan_.sprites > 0 ? speed_.far * pixels_ : 0;
    return hybrid_fft_seconds_ + channel_share_ * pass +
           hybrid_far_speed_.seconds(hybrid_plan_.work);
}

bool MethodChoice::may_win(double seconds) const { return seconds < enough_; }

void MethodChoice::estimate(const BrightArea& sprites, const BrightArea& hybrid) {
    if (may_win(sprites_left_)) {
        sprites_left_ = correction_.of(Method::kSprites) * sprites_seconds(sprites);
    }
    if (may_win(hybrid_left_)) {
        hybrid_left_ = correction_.of(Method::kHybrid) * hybrid_seconds(hybrid);
    }
}

// At least one pixel in each block whose largest value is above what the limit is at most.
void MethodChoice::estimate_from_blocks() {
    lit_pixels_ = painter_.lit_pixels(histogram_, painter_.dim_limit(histogram_));
    const auto area = [&](const auto& method) {
        const double blocks = histogram_.pixels_above(method.dim_limit(histogram_));
        return BrightArea{blocks, blocks, blocks};
    };
    estimate(area(painter_), may_win(hybrid_left_) ? area(*hybrid_) : BrightArea{});
}

void MethodChoice::estimate_from_pixels(const ConstImageView& light, int block_step,
                                        MethodReport& report) {
    sprites_area_ = {};
    hybrid_area_ = {};
    const bool sprites = may_win(sprites_left_);
    const bool hybrid = may_win(hybrid_left_);
    if (sprites) {
        lit_pixels_ = painter_.lit_pixels(histogram_, painter_.dim_limit(histogram_));
        sprites_area_ = bright_area(light, histogram_, painter_.dim_limit(histogram_), block_step);
    }
    if (hybrid) {
        hybrid_area_ = bright_area(light, histogram_, hybrid_->dim_limit(histogram_), block_step);
    }
    estimate(sprites_area_, hybrid_area_);
    const double looked = elapsed(start_);
    if (sprites) candidate(report, Method::kSprites).predicted_seconds = looked + sprites_left_;
    if (hybrid) candidate(report, Method::kHybrid).predicted_seconds = looked + hybrid_left_;
}

// Of those of the methods that may still be the fastest.
double MethodChoice::least_share() const {
    const double sprites = may_win(sprites_left_) ? painter_.dim_share() : 1.0;
    return may_win(hybrid_left_) ? std::min(sprites, hybrid_->dim_share()) : sprites;
}

void MethodChoice::consider(Method method, double model_seconds, MethodReport& report) {
    const double seconds = correction_.of(method) * model_seconds;
    const bool planned = report.reason == Reason::kPredicted;
    candidate(report, method).predicted_seconds = seconds + (planned ? elapsed(start_) : 0);
    if (seconds >= enough_) return;
    // Among methods that are not exact the fastest is taken; but it must beat transforms by more.
    enough_ = method == Method::kFft ? kWorthIt * seconds : seconds;
    report.method = method;
    chosen_ = method;
    chosen_model_seconds_ = model_seconds;
}

void MethodChoice::choose(const ConstImageView& light, const float* weights, MethodReport& report) {
    start_ = clock_seconds();
    for (auto& c : report.candidates) c.predicted_seconds = 0;
    report.reason = Reason::kNoGain;
    enough_ = kNever;
    consider(Method::kFft, fft_seconds_, report);
    sprites_left_ = 0;
    lit_pixels_ = 0;
    hybrid_left_ = hybrid_ == nullptr ? kNever : 0;
    const auto hopeless = [&] { return !may_win(sprites_left_) && !may_win(hybrid_left_); };
    estimate({}, {});
    if (hopeless()) return;
    report.reason = Reason::kBlocks;
    histogram_.look(light, weights);
    estimate_from_blocks();
    if (hopeless()) return;
    if (histogram_.blocks_to_count(least_share()) >= kManyBlocks) {
        report.reason = Reason::kSample;
        histogram_.count(light, weights, least_share(), kSampleStep);
        estimate_from_pixels(light, kSampleStep, report);
        if (hopeless()) return;
    }
    report.reason = Reason::kHistogram;
    histogram_.count(light, weights, least_share());
    estimate_from_pixels(light, 1, report);
    if (hopeless()) return;
    report.reason = Reason::kPredicted;
    // The more promising one first. Once planned, planning is spent: what is left to do decides.
    if (sprites_left_ < hybrid_left_) {
        plan_sprites(light, weights, report);
        plan_hybrid(light, weights, report);
    } else {
        plan_hybrid(light, weights, report);
        plan_sprites(light, weights, report);
    }
}

void MethodChoice::plan_sprites(const ConstImageView& light, const float* weights,
                                MethodReport& report) {
    if (!may_win(sprites_left_)) return;
    sprites_plan_ = painter_.plan(light, weights, histogram_);
    if (sprites_area_.edge_pixels > 0) {
        seconds_per_edge_pixel_ =
            near_speed_.seconds(sprites_plan_.near) / sprites_area_.edge_pixels;
        far_seconds_per_block_ = far_speed_.seconds(sprites_plan_.far) / sprites_area_.blocks;
    }
    consider(Method::kSprites, planned_sprites_seconds(), report);
}

void MethodChoice::plan_hybrid(const ConstImageView& light, const float* weights,
                               MethodReport& report) {
    if (!may_win(hybrid_left_)) return;
    hybrid_plan_ = hybrid_->plan(light, weights, histogram_);
    if (hybrid_area_.blocks > 0) {
        hybrid_seconds_per_block_ =
            hybrid_far_speed_.seconds(hybrid_plan_.work) / hybrid_area_.blocks;
    }
    consider(Method::kHybrid, planned_hybrid_seconds(), report);
}

void MethodChoice::observe(double seconds) {
    correction_.observe(chosen_, chosen_model_seconds_, seconds, kSurprise * fft_seconds_);
}

}  // namespace aureole::glare
