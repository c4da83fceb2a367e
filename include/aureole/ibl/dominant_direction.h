// Where to look up maps that were filtered as if the view were along the normal (Lagarde & de
// Rousiers 2014, "Moving Frostbite to Physically Based Rendering", section on image-based lights).
//
// A rough surface reflects most light not from the mirror direction R but from between R and the
// normal N: D is symmetric about the half vector, while N.L and shadowing favour light from above.
// Using this direction instead of R brings the split sum closer to the whole integral. The same in
// GLSL: shaders/ibl/dominant_direction.glsl, installed as ${aureole_SHADER_DIR}/ibl/
// dominant_direction.glsl.
//
// Vectors are of unit length, alpha = roughness^2 in [0, 1]; results are not of unit length.
#pragma once

#include <algorithm>
#include <cmath>

#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

constexpr Direction mixed(const Direction& a, const Direction& b, double share_of_b) {
    const double share_of_a = 1 - share_of_b;
    return {share_of_a * a.x + share_of_b * b.x, share_of_a * a.y + share_of_b * b.y,
            share_of_a * a.z + share_of_b * b.z};
}

// For the prefiltered environment: lerp(N, R, (1 - alpha) (sqrt(1 - alpha) + alpha)), R for a
// mirror and N for alpha = 1.
inline Direction specular_dominant_direction(const Direction& normal, const Direction& reflection,
                                             double alpha) {
    const double smoothness = std::clamp(1 - alpha, 0.0, 1.0);
    return mixed(normal, reflection, smoothness * (std::sqrt(smoothness) + alpha));
}

// For a map of irradiance under Disney's diffuse term (Burley 2012), which is brighter where light
// comes from the side of the viewer: from N a little towards the view. A Lambertian surface looks
// up N itself. (Listing 23 of the paper.)
inline Direction diffuse_dominant_direction(const Direction& normal, const Direction& view,
                                            double alpha) {
    const double n_dot_v = std::max(dot(normal, view), 0.0);
    const double towards_view =
        n_dot_v * (1.02341 * alpha - 1.51174) + (0.755868 - 0.511705 * alpha);
    return mixed(normal, view, std::clamp(towards_view * alpha, 0.0, 1.0));
}

}  // namespace aureole::ibl
