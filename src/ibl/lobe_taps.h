// What a texel reads for one roughness: samples of a lobe, each with its level of the environment.
#pragma once

#include <vector>

#include "ibl/lobe.h"
#include "ibl/sampling_kernels.h"

namespace aureole::ibl {

// Which level of an environment a sample reads: log4(overlap w_sample / w_texel) + bias, where
// w_sample = 1 / (samples * density) and w_texel = 4 pi / (6 size^2), the mean of all texels
// (Krivanek & Colbert 2008, eq. 11).
struct FisLevel {
    int size = 0;    // of the environment
    int levels = 1;  // of its chain
    double overlap = 1;
    double bias = 0;

    // In [0, levels - 1].
    double of(double density_per_sr, double samples) const noexcept;
    // log4(overlap / w_texel) + bias as the kernels want it: of() is half of log2(w_sample) + this.
    double log2_offset() const noexcept;
};

// `weight` is what the sample counts in the end.
LobeTap make_tap(const Lobe::Sample& sample, double weight, double level) noexcept;

// Hammersley's set, as many points as it takes until `count` of them have their light above the
// horizon; weights sum to 1.
std::vector<LobeTap> hammersley_taps(const Lobe& lobe, int count, const FisLevel& level);

}  // namespace aureole::ibl
