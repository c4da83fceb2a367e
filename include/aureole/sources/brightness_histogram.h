// How much of a picture's energy, and how many of its pixels, lie at which brightness: what a limit
// between light that is drawn and light that is not would leave on either side; and where light is.
#pragma once

#include <cstddef>
#include <vector>

#include "aureole/image/image.h"

namespace aureole::sources {

class BrightnessHistogram {
  public:
    BrightnessHistogram();

    // Replaces what was measured. `light`: finite; brightness is the largest |value| of a pixel's
    // channels, energy the sum of |light| * weight over channels; `weights`: null, or width *
    // height factors. Only every `row_step`th row is looked at, for an estimate that counts each of
    // them `row_step` times. Memory grows with the rows looked at. The same for any number of
    // threads. Throws InvalidArgument for row_step < 1.
    void measure(const ConstImageView& light, const float* weights, int row_step = 1);

    double energy() const { return total_; }

    // Whether a pixel of columns [x0, x1) and rows [y0, y1), which may lie outside the picture, may
    // be above a limit, to blocks of kBlockSide pixels; always if not all rows were looked at.
    static constexpr int kBlockSide = 16;
    bool may_be_above(float limit, int x0, int y0, int x1, int y1) const noexcept;
    // Such blocks with a pixel above the limit; 0 if not all rows were looked at.
    double blocks_above(float limit) const noexcept;

    // The largest value such that pixels none of whose channels exceeds it hold at most `share` of
    // the energy, to within 5 % of the value, never above it. Throws InvalidArgument unless `share`
    // is in [0, 1].
    float dim_limit(double share) const;

    // Pixels above a limit that dim_limit() gave.
    double pixels_above(float limit) const;

  private:
    struct Bin {
        double energy = 0;
        double pixels = 0;
    };

    std::vector<Bin> bins_;
    std::vector<Bin> parts_;  // of fixed groups of rows, one after another
    double total_ = 0;
    std::vector<float> blocks_;  // their brightest pixels; empty if not all rows were looked at
    int block_columns_ = 0;
    int block_rows_ = 0;
};

}  // namespace aureole::sources
