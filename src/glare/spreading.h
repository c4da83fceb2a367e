// in * PSF by any of the methods.
#pragma once

#include <optional>

#include "aureole/fourier/convolver.h"
#include "aureole/glare/glare.h"
#include "aureole/sources/brightness_histogram.h"
#include "glare/hybrid.h"
#include "glare/method_choice.h"
#include "glare/sprite_painter.h"
#include "glare/two_scale_convolver.h"

namespace aureole::glare {

class Spreading {
  public:
    Spreading(int width, int height, int channels, const Image& kernel,
              const GlareOptions& options);
    Spreading(const Spreading&) = delete;  // the choice refers to the methods
    Spreading& operator=(const Spreading&) = delete;

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
    void run_sprites(const ConstImageView& in, const ImageView& out, const float* weights,
                     const SpritePainter::Plan& plan);
    void run_hybrid(const ConstImageView& in, const ImageView& out, const float* weights,
                    const Hybrid::Plan& plan);
    void report_plan(double energy, double error_bound, double energy_cut, std::size_t sprites);

    int width_;
    int height_;
    std::optional<fourier::Convolver> convolver_;
    std::optional<TwoScaleConvolver> two_scale_;  // in its place at reduced resolution
    Image share_inside_;
    Image direct_kernel_;
    std::optional<SpritePainter> painter_;
    std::optional<Hybrid> hybrid_;
    sources::BrightnessHistogram histogram_;
    std::optional<MethodChoice> choice_;  // kAuto
    Method asked_;
    MethodReport report_;
};

}  // namespace aureole::glare
