// The faces of cube_map.h as arithmetic, for kernels: a point of a face looks along
// axis + s * right + t * down.
#pragma once

#include <array>

#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

struct FaceFrame {
    float axis[3];
    float right[3];
    float down[3];
};

inline constexpr std::array<FaceFrame, kFaces> kFaceFrames = {{
    {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
    {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
}};

}  // namespace aureole::ibl
