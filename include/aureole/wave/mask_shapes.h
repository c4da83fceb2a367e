// Shapes that let light through or block it, drawn with exact area coverage at any raster size.
//
// A Shape is a set of closed outlines in millimetres, independent of any raster. Curves are
// flattened once, to within kFlatteningMm (a fortieth of the shortest visible wavelength), with
// their area kept. draw() then computes for every sample the exact area that the outlines cover
// (signed-area accumulation, as font rasterisers do), so that features far smaller than a sample
// keep their area, and edges of any direction are antialiased by the box filter of the sample.
#pragma once

#include <span>
#include <vector>

#include "aureole/image/image.h"
#include "aureole/wave/aperture.h"

namespace aureole::wave {

inline constexpr double kFlatteningMm = 1e-5;

struct Point {
    double x_mm = 0;
    double y_mm = 0;
};

// Closed outlines; the last point is joined to the first. Counter-clockwise outlines cover,
// clockwise ones cut holes into them.
struct Shape {
    std::vector<std::vector<Point>> outlines;
};

// What drawing does to a mask with value m, coverage c in [0, 1] and the given value v.
enum class Blend {
    kAdd,       // m += v c: coverages that add up, counts of layers
    kMax,       // m = max(m, v c): the union of opaque things
    kMultiply,  // m *= 1 + (v - 1) c: an object of amplitude transmission v in front
                // (0: opaque, -1: a phase of pi)
    kKeep,      // m *= v c: only what lies inside the shape stays
};

// ---- Shapes. All throw InvalidArgument for sizes that are not positive. ----

Shape disc(double radius_mm, Point centre = {});

// One term of a periodic radius: r(phi) = radius (1 + sum amplitude cos(order phi + phase)).
struct RadiusHarmonic {
    int order = 2;
    double amplitude = 0;  // relative to the radius; the sum of magnitudes must stay below 1
    double phase_rad = 0;
};
// A pupil that is not quite round.
Shape irregular_disc(double radius_mm, std::span<const RadiusHarmonic> harmonics,
                     Point centre = {});

// inner_radius_mm in [0, outer_radius_mm).
Shape annulus(double inner_radius_mm, double outer_radius_mm, Point centre = {});

// Semi-axes along x and y before rotation (counter-clockwise).
Shape ellipse(double semi_axis_x_mm, double semi_axis_y_mm, double rotation_deg = 0,
              Point centre = {});

// The common part of two equal discs, with two tips on the y axis before rotation: the slit pupil
// of a cat. Full width and height, width_mm <= height_mm; equal ones are a disc.
Shape vesica(double width_mm, double height_mm, double rotation_deg = 0, Point centre = {});
// (height^2 + width^2) / (4 width): of the discs.
double vesica_radius_mm(double width_mm, double height_mm) noexcept;
double vesica_area_mm2(double width_mm, double height_mm) noexcept;

// Any shape around the origin, every point of which is moved along its direction from there by the
// factor of a periodic radius (above), and which then is scaled to its former area. Throws like
// irregular_disc().
Shape with_harmonics(Shape shape, std::span<const RadiusHarmonic> harmonics);

// Full width and height before rotation; a slit is a narrow rectangle.
Shape rectangle(double width_mm, double height_mm, double rotation_deg = 0, Point centre = {});

// An iris of `blades` >= 3 edges, corners on a circle of the given radius; at rotation 0 one
// corner points along +x. `curvature` in [-1, 1] rounds the blades: 0 straight, 1 the circle
// through the corners, negative bends them inwards.
Shape regular_polygon(int blades, double corner_radius_mm, double rotation_deg = 0,
                      double curvature = 0, Point centre = {});

// A hair: a stroke that starts as a point at `tip` and thickens as the square root of the
// distance until it has its full width after taper_mm.
struct Lash {
    Point tip;
    double direction_deg = 90;    // from the tip towards the root, from +x; 90 hangs from above
    double width_mm = 0.075;      // full width
    double taper_mm = 1.5;        // > 0
    double length_mm = 12;        // >= taper_mm; long enough to leave the aperture
    double curvature_per_mm = 0;  // of the centre line; > 0 turns left on the way to the root
};
Shape lash(const Lash& lash);

// What a lid leaves open: the inside of a circle whose highest (upper lid) or lowest (lower lid)
// point is (0, edge_y_mm). Use with Blend::kKeep.
enum class LidSide { kUpper, kLower };
Shape lid_opening(LidSide side, double edge_y_mm, double curvature_radius_mm = 12);

// ---- Drawing. Cost: the bounding box of the shape, plus its outline. ----

// Throws InvalidArgument if a coordinate is not finite.
void draw(Mask& mask, const Shape& shape, Blend blend = Blend::kAdd, float value = 1);

struct Particle {
    double x_mm = 0;
    double y_mm = 0;
    double radius_mm = 0;
};
// Thousands of small discs, one after another in the order given: the same as draw(disc()) for
// each, without its overhead. Particles outside the mask are ignored. With kKeep only the common
// area of all would stay: InvalidArgument.
void draw_particles(Mask& mask, std::span<const Particle> particles, Blend blend = Blend::kAdd,
                    float value = 1);

// A transmission mask from a picture: its centre lies on the axis, its top is at +y, its width is
// width_mm, its pixels are square. The picture is taken as piecewise constant and averaged
// exactly over each sample; values are clamped to [0, 1]; outside it the mask is 0. One or two
// channels: the first is used; more: the mean of the first three.
// Throws InvalidArgument for an empty picture or a width that is not positive.
Mask image_mask(const ApertureGrid& grid, const ConstImageView& image, double width_mm);

}  // namespace aureole::wave
