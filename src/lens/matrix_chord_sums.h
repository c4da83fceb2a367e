// The SIMD part of measuring what clips leave of an iris, compiled per instruction set: chords
// across a line, as many at a time as there are lanes.
#pragma once

#include <span>

namespace aureole::lens {

inline constexpr int kChords = 48;
inline constexpr int kMaxChordLines = 64;

// Where chords lie in [-1, 1], and how much of it each stands for.
struct ChordNodes {
    alignas(64) float position[kChords];
    alignas(64) float weight[kChords];
};

// An iris: across <= slope * along + offset for the first `upper` lines, and
// across >= slope * along + offset for the others.
struct ChordEdges {
    float slope[kMaxChordLines];
    float offset[kMaxChordLines];
    int upper = 0;
    int count = 0;
};

// The part of the line that [-1, 1] is.
struct ChordRange {
    float middle = 0;
    float half = 1;
};

// A disc between two points of the line, or an iris around one, of a signed radius.
struct ChordClip {
    float low = 0, high = 0;
    float center = 0, radius = 1;
};

struct ChordSums {
    float area, along, across;  // the last two are first moments
    int first, last;            // chords that are not empty; if none is, first > last
};

ChordSums sum_chords(const ChordEdges& edges, const ChordNodes& nodes, const ChordRange& range,
                     std::span<const ChordClip> discs, std::span<const ChordClip> irises) noexcept;

}  // namespace aureole::lens
