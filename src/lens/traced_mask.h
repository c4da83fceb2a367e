// What stands in the way of the light of traced ghosts, beside housings: the iris in any form, a
// texture in its place, dirt on the front.
#pragma once

#include <optional>

#include "aureole/lens/iris.h"
#include "lens/mesh_mask.h"
#include "lens/traced_ways.h"

namespace aureole::lens {

class TracedMask {
  public:
    // Copies all; `occluder` may be null, `texture` empty (FlareOptions::ghost_texture).
    TracedMask(const Iris& iris, const Occluder* occluder, const Image& texture);

    const Iris& iris() const noexcept { return iris_; }
    IrisField field() const noexcept { return iris_field(iris_); }
    // See ClassifyOptions.
    float inner_radius() const noexcept;
    float outer_radius() const noexcept;
    // Points into this object.
    MeshMask mesh_mask() const noexcept;

  private:
    static void transmit(const void* context, const float* u, const float* v,
                         const float* iris_width, const float* entrance_x, const float* entrance_y,
                         float entrance_width, int count, float* light);
    float texture_at(float u, float v) const noexcept;

    Iris iris_;
    std::optional<Occluder> occluder_;
    Image texture_;
};

}  // namespace aureole::lens
