// Which frames of a flipbook show an eye, and how much of each.
#pragma once

#include <array>
#include <cstddef>

#include "aureole/eye/flipbook.h"

namespace aureole::eye {

// Evenly spaced nodes.
struct FlipbookAxis {
    int nodes = 1;
    double first = 0;
    double last = 0;

    double at(int node) const noexcept {
        return nodes == 1 ? first : first + (last - first) * node / (nodes - 1);
    }
    // The value lies between nodes low and low + 1; `share` of the second. Clamped to the ends.
    struct Place {
        int low;
        double share;
    };
    Place place(double value) const noexcept;
    int nearest(double value) const noexcept;
};

struct FlipbookAxes {
    explicit FlipbookAxes(const FlipbookRange& range);

    // Particle states of each texture pupil: with open lids, and all.
    int open_states() const noexcept { return lens.nodes + vitreous_phases - 1; }
    int states() const noexcept { return open_states() + (closures.nodes - 1) * covered_phases; }

    FlipbookAxis texture_pupils;
    FlipbookAxis lens;
    int vitreous_phases;
    double vitreous_step_deg;
    int covered_phases;
    FlipbookAxis halo_pupils;  // perhaps without nodes
    FlipbookAxis streak_pupils;
    FlipbookAxis closures;
    // Indices of frames.
    std::size_t first_halo = 0;
    std::size_t first_streaks = 0;
    std::size_t frames = 0;
};

// Frames and their factors; those of factor 0 are left out.
struct FlipbookParts {
    struct Part {
        std::size_t frame;
        double factor;
    };
    void add(std::size_t frame, double factor) noexcept {
        if (factor > 0) parts[count++] = {frame, factor};
    }
    const Part* begin() const noexcept { return parts.data(); }
    const Part* end() const noexcept { return parts.data() + count; }

    std::array<Part, 8> parts = {};
    std::size_t count = 0;
};

std::size_t texture_frame(const FlipbookAxes& axes, const Eye& eye) noexcept;
FlipbookParts halo_parts(const FlipbookAxes& axes, const Eye& eye) noexcept;
FlipbookParts streak_parts(const FlipbookAxes& axes, const Eye& eye) noexcept;

}  // namespace aureole::eye
