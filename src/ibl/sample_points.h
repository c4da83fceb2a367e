// Well spread points of the unit square, from which samples of a lobe are made.
#pragma once

#include <cstdint>

namespace aureole::ibl {

// Both in [0, 1).
struct SquarePoint {
    double x = 0;
    double y = 0;
};

// Binary digits mirrored at the point: van der Corput's sequence.
double radical_inverse(std::uint32_t index);

// Point `index` of Hammersley's set of `count` points (index / count, radical inverse of index).
SquarePoint hammersley(std::uint32_t index, std::uint32_t count);

// Point `index` of the (0, 2)-sequence of Sobol' (Kollig & Keller 2002, "Efficient Multidimensional
// Sampling", section 3): any 2^m points from a multiple of 2^m on are as evenly spread as
// Hammersley's, so a set can grow.
SquarePoint sobol(std::uint32_t index);

// Point `index` of the set number `seed` of `count` correlated multi-jittered points (Kensler 2013,
// "Correlated Multi-Jittered Sampling", Pixar technical memo 13-01): one in each cell of a grid, in
// each of `count` rows and, where `count` fills the grid, in each of `count` columns.
SquarePoint multi_jittered(std::uint32_t index, std::uint32_t count, std::uint32_t seed);

}  // namespace aureole::ibl
