// Random numbers that are the same on every machine and compiler (std::normal_distribution and
// friends are not). Generator: PCG-XSH-RR 64/32, O'Neill 2014, "PCG: A Family of Simple Fast
// Space-Efficient Statistically Good Algorithms for Random Number Generation".
#pragma once

#include <cmath>
#include <cstdint>

#include "aureole/base/units.h"

namespace aureole {

class Random {
  public:
    // Different streams of one seed are independent sequences: give each use its own.
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
        : state_(0), increment_((stream << 1U) | 1U) {
        next_bits();
        state_ += seed;
        next_bits();
    }

    std::uint32_t next_bits() {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005ULL + increment_;
        const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
        const auto rotation = static_cast<std::uint32_t>(old >> 59U);
        return (shifted >> rotation) | (shifted << ((32U - rotation) & 31U));
    }

    // Uniform in [0, 1).
    double uniform() { return next_bits() * 0x1p-32; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    // Uniform in the logarithm; low > 0.
    double log_uniform(double low, double high) {
        return low * std::exp(std::log(high / low) * uniform());
    }
    // Standard normal (Box & Muller 1958).
    double normal() {
        const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
        return radius * std::cos(2.0 * kPi * uniform());
    }

  private:
    std::uint64_t state_;
    std::uint64_t increment_;
};

}  // namespace aureole
