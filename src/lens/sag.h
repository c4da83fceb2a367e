// The shape of a face: where a ray meets it, and its normal there.
#pragma once

#include <optional>

#include "aureole/lens/lens.h"
#include "aureole/lens/trace.h"

namespace aureole::lens {

struct Hit {
    Vector point = {};   // relative to the vertex
    Vector normal = {};  // unit, towards +z
};

// Where the line through `origin` (relative to the vertex) meets the sheet of the surface that
// holds the vertex, from the side from which it travels; the origin may lie behind the surface,
// since rays start in the plane of a vertex. nullopt if it does not.
std::optional<Hit> intersect(const Face& face, const Vector& origin, const Vector& direction);

}  // namespace aureole::lens
