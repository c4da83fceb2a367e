#include "ibl/sample_points.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace aureole::ibl {
namespace {

constexpr double kPerBit32 = 0x1p-32;

// A well mixed function of two numbers (multiplications and shifts of MurmurHash3's finaliser).
std::uint32_t mixed(std::uint32_t value, std::uint32_t key) {
    value ^= key * 0x9E3779B9U;
    value = (value ^ (value >> 16U)) * 0x85EBCA6BU;
    value = (value ^ (value >> 13U)) * 0xC2B2AE35U;
    return value ^ (value >> 16U);
}

double uniform(std::uint32_t value, std::uint32_t key) { return mixed(value, key) * kPerBit32; }

// A permutation of [0, length), another one for each key, without a table (section 4 of Kensler's
// memo): steps that can be undone, each on the fewest bits that hold `length`, permute that power
// of two; who lands outside goes on until inside.
std::uint32_t permuted(std::uint32_t index, std::uint32_t length, std::uint32_t key) {
    if (length <= 1) return 0;
    const std::uint32_t mask = std::bit_ceil(length) - 1;
    const auto bits = static_cast<std::uint32_t>(std::bit_width(mask));
    const std::uint32_t half = (bits + 1) / 2;
    do {
        for (std::uint32_t round = 0; round < 4; ++round) {
            const std::uint32_t round_key = mixed(key, round + 1);
            index ^= round_key;                       // undone by itself,
            index = index * (round_key | 1U) & mask;  // odd: by the inverse modulo 2^bits,
            index ^= index >> half;                   // from the top bits downwards
        }
    } while (index >= length);
    return index;
}

}  // namespace

double radical_inverse(std::uint32_t index) {
    index = (index << 16U) | (index >> 16U);
    index = ((index & 0x00FF00FFU) << 8U) | ((index & 0xFF00FF00U) >> 8U);
    index = ((index & 0x0F0F0F0FU) << 4U) | ((index & 0xF0F0F0F0U) >> 4U);
    index = ((index & 0x33333333U) << 2U) | ((index & 0xCCCCCCCCU) >> 2U);
    index = ((index & 0x55555555U) << 1U) | ((index & 0xAAAAAAAAU) >> 1U);
    return index * kPerBit32;
}

SquarePoint hammersley(std::uint32_t index, std::uint32_t count) {
    return {static_cast<double>(index) / count, radical_inverse(index)};
}

// Digits of x are those of the index, from the top; digits of y are the same from the bottom. Let
// the first half of the digits of x be rows 0, 1, 2, ... of Pascal's triangle modulo 2, applied to
// the digits of `place`, and the first half of the digits of y rows -1, -2, ...  The first a and b
// of them are a + b consecutive rows, whose first a + b columns have determinant 1 (Vandermonde's,
// divided by factorials): so a + b digits of `place` say in which box a point is, and no two agree.
std::uint32_t hammersley_index(std::uint32_t place, int digits) {
    std::uint32_t index = 0;
    const auto set_bit = [&](int bit, std::uint32_t row) {
        // C(row, k) is odd when no digit of k is missing from row (Lucas' theorem).
        unsigned parity = 0;
        for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(digits); ++k) {
            if ((k & ~row) == 0) parity ^= place >> k;
        }
        index |= (parity & 1U) << bit;
    };
    const int of_x = (digits + 1) / 2;
    for (int a = 0; a < of_x; ++a) set_bit(digits - 1 - a, static_cast<std::uint32_t>(a));
    for (int b = 0; b < digits - of_x; ++b) set_bit(b, ~static_cast<std::uint32_t>(b));
    return index;
}

SquarePoint multi_jittered(std::uint32_t index, std::uint32_t count, std::uint32_t seed) {
    const auto columns = std::max(1U, static_cast<std::uint32_t>(std::sqrt(count)));
    const std::uint32_t rows = (count + columns - 1) / columns;
    const std::uint32_t cell = permuted(index, count, mixed(seed, 0x100));
    const std::uint32_t column = permuted(cell % columns, columns, mixed(seed, 0x200));
    const std::uint32_t sub_column = permuted(cell / columns, rows, mixed(seed, 0x300));
    const double x = (column + (sub_column + uniform(cell, mixed(seed, 0x400))) / rows) / columns;
    const double y = (cell + uniform(cell, mixed(seed, 0x500))) / count;
    constexpr double kBelowOne = 1 - 0x1p-32;
    return {std::min(x, kBelowOne), std::min(y, kBelowOne)};
}

}  // namespace aureole::ibl
