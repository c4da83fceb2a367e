// Noise whose spectrum lies within a band and whose value within bounds, known at any time: sines
// of random phases, one frequency in each equal part of the band (Shinozuka & Deodatis 1991,
// "Simulation of stochastic processes by spectral representation").
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "aureole/base/random.h"
#include "aureole/base/units.h"

namespace aureole::eye {

// Streams of the seed of an eye that move it; those below 100 draw it.
enum MotionStream : std::uint64_t {
    kHippusStream = 101,
    kSlowAccommodationStream,
    kFastAccommodationStream,
    kBlinkStream,
    kSaccadeStream,
};

// The generator of one of endlessly many numbered things of a stream. Numbers are mixed (the
// finaliser of SplitMix64; Steele, Lea & Flood 2014), so that neighbours have nothing in common.
inline Random random_of(std::uint64_t seed, MotionStream stream, std::int64_t number) {
    std::uint64_t z = static_cast<std::uint64_t>(number) + 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return Random(seed ^ (z ^ (z >> 31U)), stream);
}

class BandNoise {
  public:
    // Adds `lines` sines of one amplitude between two frequencies.
    void add_band(Random& random, double low_hz, double high_hz, int lines, double amplitude) {
        for (int i = 0; i < lines; ++i) {
            const double hz = low_hz + (high_hz - low_hz) * (i + random.uniform()) / lines;
            lines_.push_back({2 * kPi * hz, random.uniform(0, 2 * kPi), amplitude});
        }
    }

    double at(double time_s) const noexcept {
        double sum = 0;
        for (const Line& line : lines_) {
            sum += line.amplitude * std::sin(line.rad_per_s * time_s + line.phase_rad);
        }
        return sum;
    }

  private:
    struct Line {
        double rad_per_s;
        double phase_rad;
        double amplitude;
    };
    std::vector<Line> lines_;
};

}  // namespace aureole::eye
