// Light sources: given, or found in a picture.
//
// A light is what its ghosts need to know of it: how much energy comes from which direction, over
// what extent. Its shape is kept as second moments, so that joining two lights into one keeps
// energy, centre and size.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "aureole/image/image.h"
#include "aureole/image/view.h"

namespace aureole::sources {

struct Light {
    // Direction: tangents of the angles to the right and up from the optical axis.
    double tan_x = 0;
    double tan_y = 0;
    // Solid angle in sr, and mean radiance over it in linear sRGB, in units of the picture:
    // their product, the irradiance of a plane that faces the light, is what matters and is exact;
    // alone, the radiance tells how bright the light looks. Of a light found in a picture the solid
    // angle is (sum of L dW)^2 / sum of L^2 dW, L the luminance that counts as light: its own for
    // an evenly bright one.
    double solid_angle_sr = 0;
    std::array<float, 3> radiance = {};
    // Second central moments of its shape, in squared tangents. A disc of angular radius a has
    // a^2 / 4 in both on the axis; off it, what that becomes on the plane of tangents.
    double moment_xx = 0;
    double moment_xy = 0;
    double moment_yy = 0;
};

// Luminance times solid angle (Rec. 709 weights).
double luminous_energy(const Light& light);

// A disc of the given angular diameter at continuous pixel position (x, y) of a view, which may
// lie outside the picture. diameter_deg = 0: a point with the solid angle of the pixel on the axis
// and no extent. The solid angle does not depend on the position.
// Throws InvalidArgument for a position that is not finite or, in a view of constant pitch, behind
// the camera (90 deg or more from the axis), a diameter outside [0, 90), a negative radiance.
Light light_at(const View& view, double x, double y, std::array<float, 3> radiance,
               double diameter_deg = 0);
// The same by angles: to the right and up from the axis, each measured in its own plane
// (tan_x = tan(right)). Throws InvalidArgument for a direction 90 deg or more from the axis ("the
// light is behind the camera").
Light light_in_direction(double right_deg, double up_deg, std::array<float, 3> radiance,
                         double diameter_deg, double pixel_solid_angle_sr);

// Where a light is in a view, continuous pixel coordinates.
struct PixelPosition {
    double x = 0, y = 0;
};
PixelPosition position_in(const View& view, const Light& light);

struct FindLightsOptions {
    // Luminance (picture units) from which pixels count as light. They fade in between this and
    // twice this, smoothly, so that nothing pops when a light moves by a part of a pixel or leaves
    // the picture. 0: 16 times the mean luminance of the picture.
    float threshold = 0;
    // At most so many lights, the strongest in energy; the others are dropped.
    int max_lights = 64;
    // Regions whose r.m.s. radius is above this share of the picture's width are cut in two across
    // their longer axis until they are below it, or below one pixel. The sums of energy, first and
    // second moments stay those of the region.
    double max_radius = 0.02;
};

struct FoundLights {
    std::vector<Light> lights;  // strongest first
    float threshold = 0;        // the one in force
    std::size_t regions = 0;    // connected bright regions (8 neighbours)
    double energy_kept = 0;     // luminous_energy of `lights`
    double energy_dropped = 0;  // of those beyond max_lights
};

// `picture` has 3 channels (or 1: grey) and the size of the view. NaN, infinities and negative
// values count as 0; so does what lies 90 deg or more from the axis. Lights stay exactly the same
// for any number of threads. Threshold and cuts move nothing by leaps except where a region grows
// past max_radius, or a light drops out of the strongest max_lights.
// Throws InvalidArgument for another size, no pixels, or options out of range (threshold finite and
// >= 0, max_lights in [1, 100000], max_radius in (0, 1]).
FoundLights find_lights(const ConstImageView& picture, const View& view,
                        const FindLightsOptions& options = {});

}  // namespace aureole::sources
