// How much of a picture's energy, and how many of its pixels, lie at which brightness: what a limit
// between light that is drawn and light that is not would leave on either side; and where light is.
//
// In two steps, because looking at each pixel costs ten times as much as looking at blocks of them:
// look() takes the sum and the largest value of each block, which bounds every limit from above;
// count() sorts the pixels of those blocks in which the limit may be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "aureole/image/image.h"

namespace aureole::sources {

class BrightnessHistogram {
  public:
    static constexpr int kBlockSide = 16;

    BrightnessHistogram();

    // Replaces what was measured. `light`: finite; brightness is the largest |value| of a pixel's
    // channels, energy the sum of |light| * weight over channels; `weights`: null, or width *
    // height factors >= 0. The same for any number of threads.
    void look(const ConstImageView& light, const float* weights);

    // After look(), of the same light: makes the limits and counts below those of pixels, for
    // shares of `least_share` and more. With `block_step` > 1 an estimate, from every so manieth of
    // the blocks that matter. May be called again. Throws InvalidArgument for block_step < 1, or a
    // share that is not in [0, 1].
    void count(const ConstImageView& light, const float* weights, double least_share,
               int block_step = 1);
    // How many blocks of kBlockSide^2 pixels that looks at, with a step of 1.
    std::size_t blocks_to_count(double least_share) const;

    // Both steps.
    void measure(const ConstImageView& light, const float* weights, double least_share = 0);

    double energy() const { return total_; }

    // Whether a pixel of columns [x0, x1) and rows [y0, y1), which may lie outside the picture, may
    // be above a limit, to blocks.
    bool may_be_above(float limit, int x0, int y0, int x1, int y1) const noexcept;

    // The largest value such that pixels none of whose channels exceeds it hold at most `share` of
    // the energy, to within 5 % of the value, never above it; after look() alone a value that is at
    // least that. Throws InvalidArgument unless `share` is in [0, 1].
    float dim_limit(double share) const;

    // Pixels above a limit that dim_limit() gave; after look() alone a number that is at most that,
    // the blocks with such pixels.
    double pixels_above(float limit) const;

  private:
    struct Block {
        float largest = 0;
        double energy = 0;
        double weight = 0;  // sum over pixels
    };
    struct BlockBin {
        double energy = 0;
        double weight = 0;
        std::size_t blocks = 0;
    };
    struct Bin {
        double energy = 0;
        double pixels = 0;
    };

    // The first bin that a limit for a share may lie in or above, and the blocks that reach it.
    struct Begin {
        std::size_t bin = 0;
        std::size_t blocks = 0;
    };
    Begin begin_of(double least_share) const;
    void look_at_strip(const ConstImageView& light, const float* weights, int row, float* scratch);
    void count_block(const ConstImageView& light, const float* weights, std::size_t block,
                     std::size_t least, Bin* bins) const;

    int channels_ = 0;
    int block_columns_ = 0;
    int block_rows_ = 0;
    std::vector<Block> blocks_;
    std::vector<std::uint32_t> chosen_;  // blocks to count
    std::vector<Bin> bins_;
    std::vector<BlockBin> block_bins_;  // by their largest values
    std::vector<Bin> parts_;            // of fixed groups of blocks, one after another
    std::vector<float> scratch_;        // rows, for each worker
    double total_ = 0;
};

}  // namespace aureole::sources
