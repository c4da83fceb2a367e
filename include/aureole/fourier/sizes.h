// Lengths that our transforms accept: products of 2, 3, 5 and 7.
#pragma once

namespace aureole::fourier {

// Largest supported length.
inline constexpr int kMaxTransformSize = 1 << 20;

// True for n >= 1 with no prime factor above 7.
bool is_smooth(int n) noexcept;

// The smallest 7-smooth number >= n. Throws InvalidArgument unless 1 <= n <= kMaxTransformSize.
int next_smooth(int n);

}  // namespace aureole::fourier
