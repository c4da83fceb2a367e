// Rows of pixels: from one plane of light to three of colour, and blurring.
#pragma once

namespace aureole::lens {

// plane[x] += weight * sums[x] for each of three planes, and zeroes sums.
void flush_row(float* sums, int count, const float weight[3], float* const planes[3]);

// to[x] += the sum over k of weights[k] from[x + k], k in [0, taps).
void blur_row(const float* from, const float* weights, int taps, int count, float* to);

}  // namespace aureole::lens
