// What lies in the pupil of a ghost and is not an edge: pictures of an iris, textures, dirt.
#pragma once

#include "aureole/lens/iris.h"

namespace aureole::lens {

// Where a point of the iris was in the entrance plane: (x0 + x_per_u u, y0 + y_per_v v) mm.
struct Entrance {
    float x0 = 0, x_per_u = 0;
    float y0 = 0, y_per_v = 0;
};

struct Pupil {
    const Iris* iris = nullptr;
    const TransmissionPyramid* texture = nullptr;  // over [-1, 1]^2, in place of the iris; or null
    const Occluder* occluder = nullptr;            // or null

    bool has_pictures() const {
        return iris->is_image() || texture != nullptr || occluder != nullptr;
    }
    // Of the iris of one crossing at its own (u, v), if that is a picture; else 1.
    float iris_picture(float u, float v, float footprint) const noexcept;
    // Of all that are pictures at a point of the drawn iris; averaged over a square of side
    // `footprint` in iris units.
    float pictures(const Entrance& entrance, float u, float v, float footprint) const noexcept;
    // Radius of a disc around everything that the drawn iris or texture lets through.
    float outer_radius(float footprint) const noexcept;
};

// From FlareOptions::ghost_texture: its first channel, negative and not finite values as 0.
TransmissionPyramid texture_pyramid(const Image& texture);

}  // namespace aureole::lens
