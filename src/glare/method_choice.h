// The choice between transforms, sprites and the hybrid, for one picture after the other
// (Method::kAuto).
//
// Each step costs more and knows more; the first that shows that nothing but transforms can be the
// fastest ends it. Predictions are corrected by what the last pictures really cost: the frames of a
// sequence are alike, so that a wrong choice is made once.
#pragma once

#include <array>

#include "aureole/fourier/convolver.h"
#include "aureole/glare/glare.h"
#include "aureole/sources/bright_area.h"
#include "aureole/sources/brightness_histogram.h"
#include "glare/cost_model.h"
#include "glare/hybrid.h"
#include "glare/sprite_painter.h"

namespace aureole::glare {

// How much slower than predicted the methods are. Of each surprise one half is put down to the
// method's model, the other to the pace of the machine, which all methods share; so that a machine
// with other work does not make the method that happens to run look worse than the others.
class CostCorrection {
  public:
    // Factor for what was predicted.
    double of(Method method) const;
    // Predicted without correction. Surprises below `matters` seconds are none: a picture that
    // costs little tells little about one that costs much. The first run of each method is left
    // out: it warms up.
    void observe(Method method, double predicted_seconds, double actual_seconds, double matters);

  private:
    static constexpr std::size_t kMethods = 4;  // by Method, kHybrid being the last
    double pace_ = 0;                           // logarithms
    std::array<double, kMethods> model_ = {};
    std::array<bool, kMethods> warm_ = {};
};

class MethodChoice {
  public:
    // Keeps references; times what it will choose from, for some 100 ms with large pictures.
    // `hybrid`: null where the kernel has no far part.
    MethodChoice(fourier::Convolver& convolver, SpritePainter& painter, Hybrid* hybrid,
                 sources::BrightnessHistogram& histogram);

    // Fills report.method, reason and predicted seconds. Sprites and a hybrid are planned if they
    // are chosen.
    void choose(const ConstImageView& light, const float* weights, MethodReport& report);
    const SpritePainter::Plan& sprites_plan() const { return sprites_plan_; }
    const Hybrid::Plan& hybrid_plan() const { return hybrid_plan_; }

    // What the chosen method took, without choosing.
    void observe(double seconds);

  private:
    // Models, without correction. Before planning: from what is known of the light.
    double sprites_seconds(const sources::BrightArea& area) const;
    double hybrid_seconds(const sources::BrightArea& area) const;
    double planned_sprites_seconds() const;
    double planned_hybrid_seconds() const;

    bool may_win(double estimated_seconds) const;
    // What sprites and a hybrid will take, from what is known of the light.
    // Methods that are ruled out stay so.
    void estimate(const sources::BrightArea& sprites, const sources::BrightArea& hybrid);
    void estimate_from_blocks();
    void estimate_from_pixels(const ConstImageView& light, int block_step, MethodReport& report);
    double least_share() const;

    // Chooses if it is below enough_.
    void consider(Method method, double model_seconds, MethodReport& report);
    void plan_sprites(const ConstImageView& light, const float* weights, MethodReport& report);
    void plan_hybrid(const ConstImageView& light, const float* weights, MethodReport& report);

    SpritePainter& painter_;
    Hybrid* hybrid_;
    sources::BrightnessHistogram& histogram_;
    double pixels_;
    double channel_share_;  // of three
    MachineSpeed speed_;
    DrawingSpeed near_speed_;
    DrawingSpeed far_speed_;
    DrawingSpeed hybrid_far_speed_;
    double fft_seconds_ = 0;
    double hybrid_fft_seconds_ = 0;
    // Of sprites, for each edge pixel, and of far ones, for each block with light: as they were
    // with the last picture for which they were planned.
    double seconds_per_edge_pixel_ = 0;
    double far_seconds_per_block_ = 0;
    double hybrid_seconds_per_block_ = 0;

    CostCorrection correction_;
    SpritePainter::Plan sprites_plan_;
    Hybrid::Plan hybrid_plan_;
    Method chosen_ = Method::kFft;
    double chosen_model_seconds_ = 0;

    // Of the picture that is being chosen for, corrected: seconds that a method must be below to be
    // chosen, and what those will at least, or most likely, take that depend on the light.
    double enough_ = 0;
    double sprites_left_ = 0;
    double hybrid_left_ = 0;
    double lit_pixels_ = 0;
    sources::BrightArea sprites_area_;
    sources::BrightArea hybrid_area_;
    double start_ = 0;
};

}  // namespace aureole::glare
