// Stars as point sources.
#pragma once

#include <span>
#include <vector>

#include "aureole/base/random.h"
#include "scene/camera.h"

namespace aureole::scene {

struct Star {
    Vec3 direction;       // unit vector in the frame of the camera's world
    float magnitude = 0;  // visual
    float temperature_k = 6000;
};

// Stars at random over the sphere's cap `min_cosine` around `axis`, with magnitudes between the
// limits distributed as those of the real sky: N(< m) grows as 10^(0.51 m), 4800 down to 6.
std::vector<Star> random_stars(Vec3 axis, float min_cosine, float brightest, float faintest,
                               Random& random);

// The bright stars around Orion, upright, with Orion's belt in the direction of +z raised by
// elevation_deg.
std::vector<Star> winter_stars(double elevation_deg);

// Adds stars that fall in the picture; `dimming` multiplies their light.
void add_stars(std::span<const Star> stars, const Camera& camera, float dimming, Image& picture);

}  // namespace aureole::scene
