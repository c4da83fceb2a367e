// How much light a ghost really gets, where linear optics lets too much or too little through.
#pragma once

#include "aureole/lens/trace.h"
#include "lens/matrix_path.h"

namespace aureole::lens {

// What exact rays find open in the entrance plane to light from `tangent` upwards, with a round
// iris, by some hundred of them: right to a few per cent.
struct ExactBeam {
    static constexpr int kRays = 6;
    double area_mm2 = 0;
    Ray rays[kRays];  // spread evenly over it, of one half of the mirror image that it is
    int ray_count = 0;
};
ExactBeam exact_beam(const Tracer& tracer, const MatrixPath& path, double tangent);

// The area of the beam that linear optics leaves open, mm^2.
double linear_beam(const MatrixPath& path, double tangent);

}  // namespace aureole::lens
