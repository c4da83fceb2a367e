// How well a PSF that is blended over the picture follows the one computed for each position.
#pragma once

#include "aureole/image/image.h"

namespace aureole::wave {

struct FieldError {
    int positions = 0;
    double l1 = 0;    // sum over positions of |blend - truth|, over the truth's energy
    double mean = 0;  // mean over the positions of each one's own ratio, where the truth has energy
    double worst = 0;  // largest of these
};

// Sums it up, position by position.
class FieldErrorSum {
  public:
    // `half_blend` (fourier/kernel_nodes.h) and `truth`, of 3 channels, have the source in their
    // middle; where the truth is larger the blend is 0. Without the source's own pixel, unless
    // `with_source`.
    void add(const Image& half_blend, const Image& truth, bool with_source = true);
    FieldError error() const;

  private:
    FieldError sum_;
    double energy_ = 0;
    int lit_ = 0;
};

}  // namespace aureole::wave
