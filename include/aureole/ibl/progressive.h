// The prefiltered environment of prefilter.h, a little better with each frame: for loops that must
// not stall when their environment changes.
//
//     ibl::ProgressiveOptions options;
//     options.roughness = ibl::level_roughness(ibl::RoughnessMapping::kFilament, 5, 256);
//     ibl::ProgressiveFilter filter(256, options);            // once
//     filter.set_environment(environment);                    // when it changes
//     filter.advance_for(1.5);                                // per frame, ms
//     upload(filter.result());                                // per frame, until converged()
//
// Samples follow D (N.L), as FilterMethod::kNlWeighted, so that all weigh the same and the weight
// that a texel carries from frame to frame is their number. docs/environment_sampling.md compares
// the choices below.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

// Where the samples of one pass after another lie.
enum class SampleSequence {
    // Hammersley's set of all the samples aimed at, in an order that leaves every pass, and any
    // power of 2 of passes, evenly spread: the final result is that of drawing them at once.
    kHammersley,
    // Hammersley's set of one pass, turned about the normal and shifted in elevation from pass to
    // pass by multiples of irrational numbers (Roberts 2018, "The Unreasonable Effectiveness of
    // Quasirandom Sequences": R2).
    kRotated,
    // A correlated multi-jittered set per pass (Kensler 2013, "Correlated Multi-Jittered
    // Sampling"), with the number of the pass as its seed.
    kMultiJittered,
};

inline constexpr std::array<std::string_view, 3> kSampleSequenceNames = {"hammersley", "rotated",
                                                                         "multi-jittered"};

// Which number of samples the level is made for that a sample reads: the fewer, the coarser.
enum class SampleLevels {
    // Those aimed at. Early results are noisy, but noise is averaged away by what follows.
    kFinal,
    // Those so far, rounded up to a power of 2. The first passes are as good as they can be, and
    // part of their blur stays in the end.
    kGrowing,
};

inline constexpr std::array<std::string_view, 2> kSampleLevelsNames = {"final", "growing"};

struct ProgressiveOptions {
    // Perceptual roughness of each level, as in PrefilterOptions.
    std::vector<double> roughness;
    SampleSequence sequence = SampleSequence::kHammersley;
    SampleLevels levels = SampleLevels::kFinal;
    // Per texel: when there are as many, the result is final. In [1, 65536]; kHammersley prefers
    // powers of 2.
    int samples = 512;
    // Samples per texel that are added at a time. In [1, 1024].
    int samples_per_pass = 32;
    // If not 0 the result is final, too, when change() falls below this. In [0, 1).
    double tolerance = 0;
    // As in PrefilterOptions.
    double fis_overlap = 1;
    double fis_bias = 0;
};

// One object may be used by one thread at a time; it uses several itself. The result depends on the
// samples that it has, to the bit, and on nothing else: not on threads, time, or what came before
// set_environment().
class ProgressiveFilter {
  public:
    // For environments of `size` texels per side, at first a black one. Throws InvalidArgument for
    // a size outside [1, 16384], no level or more than the full chain, and options out of range.
    ProgressiveFilter(int size, const ProgressiveOptions& options);
    ~ProgressiveFilter();
    ProgressiveFilter(ProgressiveFilter&&) noexcept;
    ProgressiveFilter& operator=(ProgressiveFilter&&) noexcept;

    int size() const noexcept;
    int levels() const noexcept;

    // Starts anew with a finite environment of size(), of which a copy is kept. Until a texel has
    // samples it holds the mean of the environment over it. Allocates nothing, as all below.
    void set_environment(const CubeMap& environment) noexcept;

    // Adds up to this many samples to every texel; what advance_for() left incomplete comes first,
    // and counts.
    void advance(int samples_per_texel) noexcept;
    // Works until another step, of a few tiles, would take longer than is left; at least one step.
    // May end amidst a pass: some texels then have samples_per_pass samples more than others.
    void advance_for(double milliseconds) noexcept;

    // Samples that every texel has.
    int samples() const noexcept;
    // How much the last pass changed the result: the root mean square over a level's texels,
    // relative to the level's mean, of the level that changed most. 1 before the second pass.
    double change() const noexcept;
    // There is nothing left to do.
    bool converged() const noexcept;

    // Levels of roughness 0 are those of the environment.
    const CubeChain& result() const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::ibl
