// The diffraction patterns of one eye, on the pixels around the source that they reach.
#pragma once

#include <cstddef>
#include <optional>

#include "aureole/base/buffer.h"
#include "aureole/base/progress.h"
#include "aureole/eye/anatomy.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/fourier/fft.h"
#include "aureole/image/image.h"
#include "aureole/wave/aperture.h"
#include "aureole/wave/psf.h"
#include "eye/spectral_levels.h"

namespace aureole::eye {

// Draws, transforms and integrates, one pattern after another so that memory stays small.
class Components {
  public:
    Components(const Eye& eye, const wave::KernelGrid& grid, const EyePsfOptions& options,
               Progress* progress, EyePsfTimings* timings, const FieldPosition& field = {});

    // The central part of the kernel's grid that any pattern reaches. All pictures below have
    // this size and the channels of the kernel: 3, or a matrix of 9.
    const wave::KernelGrid& patch() const { return patch_; }
    int channels() const { return 3 * static_cast<int>(lights_.size()); }

    // |F{P}|^2 per pixel. Unit energy over the band.
    Image bloom();

    // H, or nothing if the pupil hides the fibres.
    std::optional<Image> halo();

    struct CoronaAndStreaks {
        std::optional<Image> corona;   // T, not yet normalised (of a matrix: its sum over the
                                       // lights is); nothing without particles
        std::optional<Image> streaks;  // E; nothing without lashes before the pupil
        double blocked_share = 0;      // of the pupil's area, by lashes; 0 behind a closed lid
    };
    // Both at once: their masks are real, so one complex transform carries the two.
    CoronaAndStreaks corona_and_streaks(bool with_corona, bool with_streaks);

  private:
    void finish_stage(double EyePsfTimings::*stage, double fraction);
    void draw_pupil_once();
    std::size_t lit_rows() const { return end_lit_row_ - first_lit_row_; }
    double sum_lit_rows(const Buffer& plane) const;
    // `initial`: in every colour of white.
    Image onto_pixels(const wave::PatternIntegral& pattern, wave::PixelRule rule, float initial);

    const Eye& eye_;
    const EyePsfOptions& options_;
    Progress* progress_;
    EyePsfTimings* timings_;
    FieldPosition field_;
    double stage_start_;
    double fraction_done_ = 0;
    std::vector<std::vector<SpectralLevel>> lights_;
    wave::KernelGrid patch_;
    fourier::Fft2d fft_;
    std::optional<wave::Mask> pupil_;
    std::size_t first_lit_row_ = 0;  // rows of the raster that the pupil touches
    std::size_t end_lit_row_ = 0;
};

}  // namespace aureole::eye
