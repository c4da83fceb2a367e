// in * PSF by any of the methods, and the choice between them.
#pragma once

#include <optional>

#include "aureole/fourier/convolver.h"
#include "aureole/glare/glare.h"
#include "aureole/sources/brightness_histogram.h"
#include "glare/cost_model.h"
#include "glare/hybrid.h"
#include "glare/sprite_painter.h"
#include "glare/two_scale_convolver.h"

namespace aureole::glare {

class Spreading {
  public:
    Spreading(int width, int height, int channels, const Image& kernel,
              const GlareOptions& options);

    // Whether run() needs an output that is not its input.
    bool needs_other_memory() const { return !direct_kernel_.empty() || painter_.has_value(); }

    void run(const ConstImageView& in, const ImageView& out, const float* weights) noexcept;

    // For every pixel, the share of its light that stays inside the picture: by the kernel itself,
    // or by what stands for it at reduced resolution.
    const Image& share_inside() const { return share_inside_; }

    const MethodReport& last() const { return report_; }
    int padded_width() const;
    int padded_height() const;

  private:
    // Chooses and plans for one picture.
    Method choose(const ConstImageView& light, const float* weights);
    // Plans; returns the seconds that drawing will take.
    double plan_sprites(const ConstImageView& light, const float* weights);
    double plan_hybrid(const ConstImageView& light, const float* weights);
    // Seconds that are spent at least, or most likely, wherever the light is; looking not included.
    struct Bright {
        double pixels = 0;
        double blocks = 0;  // at least
    };
    Bright bright_above(float limit) const;
    double least_sprites_seconds(const Bright& bright) const;
    double least_hybrid_seconds(const Bright& bright) const;
    // Whether neither sprites nor a far layer can be done in that time; with what histogram_ knows.
    bool hopeless(double seconds) const;
    void predict(Method method, double seconds);
    void report_plan(double energy, double error_bound, double energy_cut, std::size_t sprites);

    double pixels_;
    double channel_share_;  // of three
    int width_;
    int height_;
    std::optional<fourier::Convolver> convolver_;
    std::optional<TwoScaleConvolver> two_scale_;  // in its place at reduced resolution
    Image share_inside_;
    Image direct_kernel_;
    std::optional<SpritePainter> painter_;
    std::optional<Hybrid> hybrid_;
    sources::BrightnessHistogram histogram_;
    // kAuto: what costs how much.
    MachineSpeed speed_;
    double fft_seconds_ = 0;
    double hybrid_fft_seconds_ = 0;
    SpritePainter::Plan sprites_plan_;
    Hybrid::Plan hybrid_plan_;
    Method asked_;
    MethodReport report_;
};

}  // namespace aureole::glare
