// Spectra in bytes: what a book of many kernels stores.
//
// A spectrum of rows x columns numbers (symmetric_fft.h: row-major, ky = 0 .. rows - 1) is cut into
// blocks of one column and 64 rows. Each has a scale, 1/127 of its largest magnitude in half
// precision, and a whole number from -127 to 127 per value. Rounding is noise of one level over the
// whole kernel, .004 to .006 of the rms of its pixels (half precision of every number: 1.4e-4, at
// twice the size). A kernel that spans decades must be divided by its envelope before it is
// transformed. Blocks stand upright because lines across a kernel are narrow in kx: along rows the
// rounding of horizontal streaks would be 3 times as much.
#pragma once

#include <cstddef>
#include <span>

namespace aureole::fourier {

inline constexpr int kBlockRows = 64;

// Scales (of all columns, block by block), then a byte per number, row by row.
constexpr std::size_t byte_spectrum_size(int rows, int columns) {
    const auto blocks = static_cast<std::size_t>((rows + kBlockRows - 1) / kBlockRows);
    return (2 * blocks + static_cast<std::size_t>(rows)) * static_cast<std::size_t>(columns);
}

// `bytes` has byte_spectrum_size() and begins at an even address. Returns the scale of all scales,
// a power of two; 0 if all values are 0. Values must be finite.
float encode_spectrum(std::span<const float> values, int columns, std::byte* bytes);

// sum[i] += factor * value[i] for the rows [first_row, end_row); `sum` begins with first_row.
// `factor` includes the scale.
void add_spectrum(const std::byte* bytes, int rows, int columns, int first_row, int end_row,
                  float factor, float* sum) noexcept;

// Whether all scales are finite, as those of encode_spectrum() are.
bool scales_are_finite(const std::byte* bytes, int rows, int columns) noexcept;

}  // namespace aureole::fourier
