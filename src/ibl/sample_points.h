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

// An order of Hammersley's set of 2^digits points in which it can be drawn little by little: number
// `place` in it is the point of this index. Any 2^m of them from a multiple of 2^m on are evenly
// spread themselves: there is one in each of 2^a x 2^b boxes, a + b = m, where neither a nor b is
// above half of `digits`. `place` < 2^digits, digits <= 31.
std::uint32_t hammersley_index(std::uint32_t place, int digits);

// Point `index` of the set number `seed` of `count` correlated multi-jittered points (Kensler 2013,
// "Correlated Multi-Jittered Sampling", Pixar technical memo 13-01): one in each cell of a grid, in
// each of `count` rows and, where `count` fills the grid, in each of `count` columns.
SquarePoint multi_jittered(std::uint32_t index, std::uint32_t count, std::uint32_t seed);

}  // namespace aureole::ibl
