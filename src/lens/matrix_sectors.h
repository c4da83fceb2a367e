// What clips leave of an iris with blades, seen along rays from its middle: fast enough for
// hundreds of ghosts per light.
#pragma once

#include <span>

#include "lens/matrix_ghosts.h"
#include "lens/matrix_open_area.h"

namespace aureole::lens {

// Rays in evenly spaced directions, to where they leave the iris.
struct IrisSectors {
    static constexpr int kCount = 64;
    alignas(64) float u[kCount];
    alignas(64) float v[kCount];
    alignas(64) float reach[kCount];
    // Of straight blades only; else none, and the iris of another crossing counts as round.
    const Iris::Blade* blades = nullptr;
    int blade_count = 0;
    float apothem = 1;

    explicit IrisSectors(const Iris& iris);

    // As open_area() of round clips (ru = rv but for their signs): right to .5 % of the unit disc.
    OpenArea open_area(std::span<const MatrixGhost::Clip> clips) const noexcept;
};

}  // namespace aureole::lens
