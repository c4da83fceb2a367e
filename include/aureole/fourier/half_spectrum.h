// Spectra in half precision: what a book of many kernels stores.
//
// Rounding is relative to each number, 2^-12 at most, so that its error in the kernel is noise of
// one level everywhere: 1.4e-4 of the rms of all pixels of the kernel. A kernel that spans decades
// must be divided by its envelope before it is transformed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace aureole::fourier {

// halves[i] = values[i] / scale, rounded to nearest; returns the scale, a power of two that brings
// the largest magnitude into [16384, 32768), so that 29 octaves below it keep their precision.
// 0 if all values are 0. Values must be finite.
float encode_spectrum(std::span<const float> values, std::uint16_t* halves);

// sum[i] += factor * halves[i]; `factor` includes the scale.
void add_spectrum(std::span<const std::uint16_t> halves, float factor, float* sum) noexcept;

}  // namespace aureole::fourier
