// The prefiltered environment of the split sum (Karis 2013, "Real Shading in Unreal Engine 4"):
//
//     P(N, a) = sum over L of  E(L) D(N.H, a) (N.L) dw  /  sum over L of  D(N.H, a) (N.L) dw,
//
// with H the half vector of N and L (the view is taken along the normal), D that of GGX (Walter et
// al. 2007, eq. 33), a = alpha = roughness^2. As N.H^2 = (1 + N.L) / 2 then, light from L has the
// weight, but for a constant,
//
//     w(L) = (N.L) / (1 - (1 - a^2) (1 + N.L) / 2)^2        where N.L > 0.
//
// docs/environment_filtering.md derives this and compares the methods.
//
//     ibl::PrefilterOptions options;
//     options.roughness = ibl::level_roughness(ibl::RoughnessMapping::kFilament, 5, 256);
//     ibl::Prefilter prefilter(256, options);                 // once
//     ibl::CubeChain chain = prefilter.make_chain();          // once
//     prefilter.run(environment, chain);                      // per environment
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "aureole/base/progress.h"
#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

enum class FilterMethod {
    // Hierarchical gather over a tree of the environment's texels, one cut of the tree for each
    // tile of 8 x 8 outputs. Deterministic, right for a sun too, and the fastest.
    kGather,
    // 1024 samples per texel by importance sampling of D, without levels: Karis' own code.
    kReference,
    // Filtered importance sampling (Krivanek & Colbert 2008, "Real-time Shading with Filtered
    // Importance Sampling"): few samples, each from a level as coarse as it is spread.
    kFis,
    // The same samples with everything that does not depend on the texel computed beforehand;
    // samples below the horizon are replaced; samples per level.
    kPrecomputed,
    // kPrecomputed with samples drawn from D (N.L), found numerically: all weights are equal.
    kNlWeighted,
    // Sums over every texel, subdivided where the lobe is narrow: the truth. Slow.
    kExact,
};

inline constexpr std::array<std::string_view, 6> kFilterMethodNames = {
    "gather", "reference", "fis", "precomputed", "nl-weighted", "exact"};

// Of kGather: how far its cut of the tree may be from the truth.
enum class FilterQuality { kDraft, kNormal, kHigh };

inline constexpr std::array<std::string_view, 3> kFilterQualityNames = {"draft", "normal", "high"};

struct PrefilterOptions {
    // Perceptual roughness of each level, in [0, 1]; level_roughness() in roughness.h has those of
    // common engines. A level of roughness 0 is the environment itself (level 0) or its mean over
    // each texel (smaller ones).
    std::vector<double> roughness;
    FilterMethod method = FilterMethod::kGather;
    FilterQuality quality = FilterQuality::kNormal;

    // The sampling methods: samples per level, the last value for all levels after it. Empty: 1024
    // for kReference, 32 for the others. In [1, 65536].
    std::vector<int> samples;
    // kFis, kPrecomputed and kNlWeighted read level log4(K w_sample / w_texel) + bias of the
    // environment: K the overlap of neighbouring samples' footprints, > 0. The document's own
    // choice is K = 1, bias = 1 (K = 4, no bias).
    double fis_overlap = 1;
    double fis_bias = 0;
};

// Everything that can be prepared without an environment. One object may be used by one thread at
// a time; it uses several itself, and gives the same bits with any number of them.
class Prefilter {
  public:
    // For environments of `size` texels per side. Throws InvalidArgument for a size outside
    // [1, 16384], no level or more than the full chain, and options out of range.
    Prefilter(int size, const PrefilterOptions& options);
    ~Prefilter();
    Prefilter(Prefilter&&) noexcept;
    Prefilter& operator=(Prefilter&&) noexcept;

    int size() const noexcept;
    int levels() const noexcept;

    // A chain of the sizes that run() fills, all zero.
    CubeChain make_chain() const;

    // Fills all levels. `environment` is finite, of size(); `chain` is as from make_chain() and
    // must not overlap the environment. Allocates nothing.
    void run(const CubeMap& environment, CubeChain& chain) noexcept;
    // The same with progress, and Cancelled (base/error.h) when it asks to stop; `chain` is then
    // undefined.
    void run(const CubeMap& environment, CubeChain& chain, Progress& progress);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::ibl
