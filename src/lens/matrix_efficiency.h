// How much light a ghost really gets, where linear optics lets too much or too little through.
#pragma once

#include <span>

#include "aureole/lens/trace.h"
#include "lens/matrix_path.h"
#include "lens/traced_ways.h"

namespace aureole::lens {

// What exact rays find open in the entrance plane.
struct ExactBeam {
    static constexpr int kRays = 24;
    double area_mm2 = 0;
    Ray rays[kRays];  // spread evenly over it, of one half of the mirror image that it is
    int ray_count = 0;
};

// Finds the beams of the ghosts of a lens.
class ExactBeams {
  public:
    ExactBeams(const Lens& lens, std::span<const MatrixPath> paths);

    // Of light from `tangent` upwards, with a round iris, by 2048 rays of the d line: right to some
    // tenths of a per cent, to a few where the beam is in pieces.
    ExactBeam find(std::size_t ghost, const MatrixPath& path, double tangent) const;

  private:
    TracedWays ways_;
};

// The area of the beam that linear optics leaves open, mm^2.
double linear_beam(const MatrixPath& path, double tangent);

}  // namespace aureole::lens
