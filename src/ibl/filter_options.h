// Checks that PrefilterOptions and ProgressiveOptions have in common; all throw InvalidArgument.
#pragma once

#include <vector>

namespace aureole::ibl {

inline constexpr int kMostSamples = 65536;

// `value` is in [1, most].
void check_count(const char* name, int value, int most);
// The environment's size, the number of levels, and roughness in [0, 1].
void check_levels(int size, const std::vector<double>& roughness);
void check_fis(double overlap, double bias);

}  // namespace aureole::ibl
