// Drawing small bright things without losing light: the exact share of every pixel that a shape
// covers.
#pragma once

#include <span>
#include <vector>

#include "aureole/image/image.h"
#include "scene/camera.h"
#include "scene/vec.h"

namespace aureole::scene {

// A convex polygon in continuous pixel coordinates, either way round.
using Polygon = std::vector<Pixel>;

// An ellipse as a polygon of the same area; the half axes are vectors.
Polygon ellipse(Pixel centre, Pixel half_axis_1, Pixel half_axis_2);

// The true projection of a round cone of light around a direction, as a polygon of the same area;
// empty if part of it is behind the camera. radius_deg: between the axis of the cone and its edge.
Polygon cone_outline(const Camera& camera, Vec3 direction, double radius_deg);

double area(const Polygon& polygon);

struct PixelCoverage {
    int x;
    int y;
    float share;  // of the pixel's area, (0, 1]
};

// The pixels of a width x height picture that the polygon touches. Shares add up to the area of
// the polygon inside the picture.
std::vector<PixelCoverage> coverage(const Polygon& polygon, int width, int height);

// Adds a light of one radiance. Lights hide what is behind them, but they outshine it by decades;
// adding keeps the energy of several lights that share a pixel.
void add_light(const Polygon& polygon, Vec3 radiance, Image& picture);

// Adds a source too small to have a shape: `illuminance` (lx, as rgb) from a position, spread over
// the pixels that a pixel-sized square around it covers, so that the sum over pixels of
// value x solid angle is the illuminance.
void add_point(Pixel position, Vec3 illuminance, const View& view, Image& picture);

}  // namespace aureole::scene
