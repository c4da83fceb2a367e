#include "line_plan.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"
#include "aureole/fourier/sizes.h"

namespace aureole::fourier {
namespace {

// Odd radices first, on the long strides; powers of two last, as eights and fours.
std::vector<int> radices_of(int n) {
    std::vector<int> radices;
    for (const int prime : {7, 5, 3}) {
        for (; n % prime == 0; n /= prime) radices.push_back(prime);
    }
    int twos = 0;
    for (; n % 2 == 0; n /= 2) ++twos;
    while (twos > 0) {
        const int take = twos == 1 ? 1 : (twos == 2 || twos == 4) ? 2 : 3;
        radices.push_back(1 << take);
        twos -= take;
    }
    return radices;
}

// Real operations per element of one butterfly with its twiddles, roughly.
double cost_per_element(int radix) {
    switch (radix) {
        case 2:
            return 5;
        case 3:
            return 9.3;
        case 4:
            return 8.5;
        case 5:
            return 13;
        case 7:
            return 19;
        default:
            return 11.5;
    }
}

// Of a two-dimensional transform whose other dimension is fixed, per element of that dimension:
// a longer line costs its own passes and one more line of the other direction's.
double cost(int n) {
    constexpr double kMemoryPass = 4;       // loads and stores of one pass, in operations
    constexpr double kOtherDirection = 75;  // passes of a typical line of the other direction
    double per_element = kOtherDirection;
    for (const int radix : radices_of(n)) per_element += cost_per_element(radix) + kMemoryPass;
    return per_element * n;
}

}  // namespace

LinePlan::LinePlan(int n) : length(n) {
    int block = n;
    for (const int radix : radices_of(n)) {
        LinePass pass{block, radix, block / radix, {}};
        pass.twiddles.reserve(static_cast<std::size_t>(block) * 2);
        for (int j = 0; j < pass.stride; ++j) {
            for (int k = 1; k < radix; ++k) {
                const double angle = -2 * kPi * static_cast<double>(k) * j / block;
                pass.twiddles.push_back(static_cast<float>(std::cos(angle)));
                pass.twiddles.push_back(static_cast<float>(std::sin(angle)));
            }
        }
        block = pass.stride;
        passes.push_back(std::move(pass));
    }
    // Pass by pass, digit k of the frequency selects the k-th sub-block.
    position.resize(static_cast<std::size_t>(n));
    for (int frequency = 0; frequency < n; ++frequency) {
        int rest = frequency;
        int at = 0;
        for (const LinePass& pass : passes) {
            at += rest % pass.radix * pass.stride;
            rest /= pass.radix;
        }
        position[static_cast<std::size_t>(frequency)] = at;
    }
}

int best_length(int n) {
    int best = next_smooth(n);
    const int longest = std::min(n + n / 16 + 1, kMaxTransformSize);
    for (int candidate = best; candidate <= longest; ++candidate) {
        if (!is_smooth(candidate)) continue;
        if (cost(candidate) < cost(best)) best = candidate;
    }
    return best;
}

}  // namespace aureole::fourier
