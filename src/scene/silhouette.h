// Opaque shapes painted over a picture, far ones first, with antialiased edges: leaves, branches,
// fences. What must keep its energy exactly is drawn by coverage.h instead.
#pragma once

#include <vector>

#include "scene/camera.h"
#include "scene/vec.h"

namespace aureole::scene {

// A straight stroke between two ends of different width; a short one is a leaf. Continuous pixel
// coordinates.
struct Stroke {
    Pixel from;
    Pixel to;
    float radius_from;
    float radius_to;
    float depth;  // m, for sorting
    Vec3 radiance;
    // Radiance at one edge relative to the other: strokes are shaded across, from `radiance` times
    // 1 - shading on their left (seen from `from` to `to`) to 1 + shading on their right.
    float shading = 0;
    bool flat = false;  // ends cut square instead of round
};

// Projects a stroke given in the world; returns false behind the camera.
bool project_stroke(const Camera& camera, Vec3 from, Vec3 to, float radius_from, float radius_to,
                    Vec3 radiance, float shading, std::vector<Stroke>& strokes, bool flat = false);

// Sorts by depth and paints.
void paint(std::vector<Stroke>& strokes, Image& picture);

}  // namespace aureole::scene
