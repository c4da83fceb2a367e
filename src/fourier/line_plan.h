// The schedule of one line transform: radices, twiddle factors and the order of its output.
// Independent of the instruction set.
#pragma once

#include <cstddef>
#include <vector>

namespace aureole::fourier {

// One decimation-in-frequency pass over blocks of `length` = `radix` * `stride` elements.
struct LinePass {
    int length;
    int radix;
    int stride;
    // exp(-2 pi i k j / length) for j in [0, stride), k in [1, radix): cos and sin alternating,
    // k fastest.
    std::vector<float> twiddles;
};

// Forward transforms leave their output in the order of the decimation (no reordering pass);
// inverse transforms take that order and give natural order back.
struct LinePlan {
    explicit LinePlan(int length);  // 7-smooth

    int length;
    std::vector<LinePass> passes;  // empty for length 1
    std::vector<int> position;     // where frequency k is stored
};

// The cheapest length >= n for one side of a two-dimensional transform, by the operations of its
// passes, among the 7-smooth lengths up to a few percent above n.
int best_length(int n);

}  // namespace aureole::fourier
