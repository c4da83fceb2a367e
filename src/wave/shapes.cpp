// Outlines of the shapes, flattened to polygons that keep the area of the curve.
#include <algorithm>
#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/wave/mask_shapes.h"

namespace aureole::wave {
namespace {

using Outline = std::vector<Point>;

void require_positive(const char* what, double value) {
    if (!(value > 0) || !std::isfinite(value)) {
        throw InvalidArgument(what, std::to_string(value), "must be positive and finite");
    }
}

// Chords of an arc of this radius that stay within kFlatteningMm of it, for a full turn. A
// multiple of 4, so that the polygon is symmetric about both axes and the centre.
int chords_per_turn(double radius_mm) {
    const double count = kPi * std::sqrt(radius_mm / (2 * kFlatteningMm));
    return 4 * static_cast<int>(std::clamp(std::ceil(count / 4), 4.0, 16384.0));
}

// Radius of the corners of a regular n-gon that has the area of a circle of radius 1.
double corner_scale(int n) { return std::sqrt((2 * kPi / n) / std::sin(2 * kPi / n)); }

Outline circle(double radius_mm, Point centre) {
    const int n = chords_per_turn(radius_mm);
    const double r = radius_mm * corner_scale(n);
    Outline points;
    points.reserve(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) {
        const double phi = 2 * kPi * k / n;
        points.push_back({centre.x_mm + r * std::cos(phi), centre.y_mm + r * std::sin(phi)});
    }
    return points;
}

// Throws InvalidArgument unless the sum of magnitudes, which is returned, stays below 1.
double checked_magnitude(std::span<const RadiusHarmonic> harmonics) {
    double magnitude = 0;
    for (const RadiusHarmonic& h : harmonics) magnitude += std::abs(h.amplitude);
    if (!(magnitude < 1)) {
        throw InvalidArgument("sum of pupil irregularities", std::to_string(magnitude),
                              "must be below 1");
    }
    return magnitude;
}

double radius_factor(std::span<const RadiusHarmonic> harmonics, double phi) {
    double factor = 1;
    for (const RadiusHarmonic& h : harmonics) {
        factor += h.amplitude * std::cos(h.order * phi + h.phase_rad);
    }
    return factor;
}

// Half of the angle that each of the two arcs spans, seen from the centre of its disc.
double vesica_half_angle(double width_mm, double height_mm) {
    return 2 * std::atan(width_mm / height_mm);
}

double area_mm2(const Shape& shape) {
    double twice = 0;
    for (const Outline& outline : shape.outlines) {
        Point from = outline.back();
        for (const Point& to : outline) {
            twice += from.x_mm * to.y_mm - to.x_mm * from.y_mm;
            from = to;
        }
    }
    return twice / 2;
}

Point rotated(double x, double y, double rotation_deg, Point centre) {
    const double c = std::cos(rad_from_deg(rotation_deg));
    const double s = std::sin(rad_from_deg(rotation_deg));
    return {centre.x_mm + c * x - s * y, centre.y_mm + s * x + c * y};
}

}  // namespace

Shape disc(double radius_mm, Point centre) {
    require_positive("disc radius (mm)", radius_mm);
    return {{circle(radius_mm, centre)}};
}

Shape irregular_disc(double radius_mm, std::span<const RadiusHarmonic> harmonics, Point centre) {
    require_positive("pupil radius (mm)", radius_mm);
    const double magnitude = checked_magnitude(harmonics);
    int highest = 1;
    for (const RadiusHarmonic& h : harmonics) highest = std::max(highest, std::abs(h.order));
    // The curvature radius of the outline is smaller by up to order^2 times the amplitude.
    const int n = std::max(chords_per_turn(radius_mm), 64 * highest) * (magnitude > 0 ? 2 : 1);
    Outline points;
    points.reserve(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) {
        const double phi = 2 * kPi * k / n;
        const double r = radius_mm * corner_scale(n) * radius_factor(harmonics, phi);
        points.push_back({centre.x_mm + r * std::cos(phi), centre.y_mm + r * std::sin(phi)});
    }
    return {{std::move(points)}};
}

Shape annulus(double inner_radius_mm, double outer_radius_mm, Point centre) {
    require_positive("annulus outer radius (mm)", outer_radius_mm);
    if (!(inner_radius_mm >= 0 && inner_radius_mm < outer_radius_mm)) {
        throw InvalidArgument("annulus inner radius (mm)", std::to_string(inner_radius_mm),
                              "must be in [0, outer radius)");
    }
    Shape shape{{circle(outer_radius_mm, centre)}};
    if (inner_radius_mm > 0) {
        Outline hole = circle(inner_radius_mm, centre);
        std::reverse(hole.begin(), hole.end());
        shape.outlines.push_back(std::move(hole));
    }
    return shape;
}

Shape ellipse(double semi_axis_x_mm, double semi_axis_y_mm, double rotation_deg, Point centre) {
    require_positive("ellipse semi-axis (mm)", std::min(semi_axis_x_mm, semi_axis_y_mm));
    require_positive("ellipse semi-axis (mm)", std::max(semi_axis_x_mm, semi_axis_y_mm));
    // An affine image of a circle of the larger radius: chords only come closer to the curve.
    const double major = std::max(semi_axis_x_mm, semi_axis_y_mm);
    Outline points = circle(major, {});
    for (Point& p : points) {
        p = rotated(p.x_mm * (semi_axis_x_mm / major), p.y_mm * (semi_axis_y_mm / major),
                    rotation_deg, centre);
    }
    return {{std::move(points)}};
}

double vesica_radius_mm(double width_mm, double height_mm) noexcept {
    return (height_mm * height_mm + width_mm * width_mm) / (4 * width_mm);
}

double vesica_area_mm2(double width_mm, double height_mm) noexcept {
    const double radius_mm = vesica_radius_mm(width_mm, height_mm);
    const double angle = 2 * vesica_half_angle(width_mm, height_mm);
    return radius_mm * radius_mm * (angle - std::sin(angle));  // two circular segments
}

Shape vesica(double width_mm, double height_mm, double rotation_deg, Point centre) {
    require_positive("vesica width (mm)", width_mm);
    require_positive("vesica height (mm)", height_mm);
    if (width_mm > height_mm) {
        throw InvalidArgument("vesica width (mm)", std::to_string(width_mm),
                              "must be at most the height, " + std::to_string(height_mm));
    }
    constexpr int kFewestChords = 256;  // per arc: a pupil's harmonics turn fast at its waist
    const double radius_mm = vesica_radius_mm(width_mm, height_mm);
    const double half_angle = vesica_half_angle(width_mm, height_mm);
    const int chords = std::max(
        kFewestChords, static_cast<int>(std::ceil(chords_per_turn(radius_mm) * half_angle / kPi)));
    const double offset_mm = radius_mm - width_mm / 2;
    // The area of two segments made of chords, against that of the arcs.
    const double polygon_mm2 =
        radius_mm * radius_mm *
        (chords * std::sin(2 * half_angle / chords) - std::sin(2 * half_angle));
    const double scale = std::sqrt(vesica_area_mm2(width_mm, height_mm) / polygon_mm2);
    Outline points;
    for (const double side : {1.0, -1.0}) {  // the right arc from its lower tip up, then the left
        for (int k = 0; k < chords; ++k) {
            const double angle = half_angle * (2.0 * k / chords - 1);
            points.push_back(rotated(side * scale * (radius_mm * std::cos(angle) - offset_mm),
                                     side * scale * radius_mm * std::sin(angle), rotation_deg,
                                     centre));
        }
    }
    return {{std::move(points)}};
}

Shape with_harmonics(Shape shape, std::span<const RadiusHarmonic> harmonics) {
    checked_magnitude(harmonics);
    const double before = area_mm2(shape);
    for (Outline& outline : shape.outlines) {
        for (Point& point : outline) {
            const double factor = radius_factor(harmonics, std::atan2(point.y_mm, point.x_mm));
            point.x_mm *= factor;
            point.y_mm *= factor;
        }
    }
    const double scale = std::sqrt(before / area_mm2(shape));
    for (Outline& outline : shape.outlines) {
        for (Point& point : outline) {
            point.x_mm *= scale;
            point.y_mm *= scale;
        }
    }
    return shape;
}

Shape rectangle(double width_mm, double height_mm, double rotation_deg, Point centre) {
    require_positive("rectangle width (mm)", width_mm);
    require_positive("rectangle height (mm)", height_mm);
    const double x = width_mm / 2;
    const double y = height_mm / 2;
    return {{{rotated(-x, -y, rotation_deg, centre), rotated(x, -y, rotation_deg, centre),
              rotated(x, y, rotation_deg, centre), rotated(-x, y, rotation_deg, centre)}}};
}

Shape regular_polygon(int blades, double corner_radius_mm, double rotation_deg, double curvature,
                      Point centre) {
    if (blades < 3) {
        throw InvalidArgument("blades", std::to_string(blades), "must be at least 3");
    }
    require_positive("iris radius (mm)", corner_radius_mm);
    if (!(curvature >= -1 && curvature <= 1)) {
        throw InvalidArgument("blade curvature", std::to_string(curvature), "must be in [-1, 1]");
    }
    const double half_angle = kPi / blades;
    const double half_chord = corner_radius_mm * std::sin(half_angle);
    const double bulge = curvature * corner_radius_mm * (1 - std::cos(half_angle));
    int chords = 1;
    if (bulge != 0) {
        const double arc_radius = (half_chord * half_chord + bulge * bulge) / (2 * std::abs(bulge));
        const double arc_angle = 4 * std::atan2(std::abs(bulge), half_chord);
        chords = std::max(
            4, static_cast<int>(std::ceil(chords_per_turn(arc_radius) * arc_angle / (2 * kPi))));
    }
    Outline points;
    for (int blade = 0; blade < blades; ++blade) {
        // In the frame of the blade: the chord runs from (h, -c) to (h, c) at distance h.
        const double middle_deg = rotation_deg + deg_from_rad((2 * blade + 1) * half_angle);
        const double h = corner_radius_mm * std::cos(half_angle);
        for (int k = 0; k < chords; ++k) {
            double x = h;
            double y = half_chord * (2.0 * k / chords - 1);
            if (bulge != 0) {
                // Equal steps along the arc, whose ends are at angles -a and a seen from its
                // centre; a keeps the sign of the bulge.
                const double a = 2 * std::atan2(bulge, half_chord);
                const double radius = half_chord / std::sin(a);
                const double angle = a * (2.0 * k / chords - 1);
                x = h + radius * (std::cos(angle) - std::cos(a));
                y = radius * std::sin(angle);
            }
            points.push_back(rotated(x, y, middle_deg, centre));
        }
    }
    return {{std::move(points)}};
}

Shape lash(const Lash& lash) {
    require_positive("lash width (mm)", lash.width_mm);
    require_positive("lash taper (mm)", lash.taper_mm);
    require_positive("lash length (mm)", lash.length_mm);
    if (lash.length_mm < lash.taper_mm) {
        throw InvalidArgument("lash length (mm)", std::to_string(lash.length_mm),
                              "must be at least the taper, " + std::to_string(lash.taper_mm));
    }
    // Distances t from the tip: t = taper s^2 along the taper, where the half width is
    // proportional to s (straight sides in s, dense where the outline is blunt), then chords of
    // the bent centre line.
    constexpr int kTaperSteps = 48;
    std::vector<double> distances;
    for (int k = 0; k <= kTaperSteps; ++k) {
        const double s = static_cast<double>(k) / kTaperSteps;
        distances.push_back(lash.taper_mm * s * s);
    }
    const double rest = lash.length_mm - lash.taper_mm;
    const double bend = std::abs(lash.curvature_per_mm);
    const double chord = bend > 0 ? std::sqrt(8 * kFlatteningMm / bend) : rest;
    const int steps =
        rest > 0 ? std::clamp(static_cast<int>(std::ceil(rest / std::max(chord, 1e-6))), 1, 4096)
                 : 0;
    for (int k = 1; k <= steps; ++k) distances.push_back(lash.taper_mm + rest * k / steps);

    const double start = rad_from_deg(lash.direction_deg);
    const double curvature = lash.curvature_per_mm;
    Outline right;
    Outline left;
    for (const double t : distances) {
        const double heading = start + curvature * t;
        // Point of the centre line: the integral of (cos, sin) of the heading from 0 to t.
        const double half_turn = curvature * t / 2;
        const double run = t * (std::abs(half_turn) < 1e-6 ? 1 : std::sin(half_turn) / half_turn);
        const double x = lash.tip.x_mm + run * std::cos(start + half_turn);
        const double y = lash.tip.y_mm + run * std::sin(start + half_turn);
        const double half = lash.width_mm / 2 * std::sqrt(std::min(t / lash.taper_mm, 1.0));
        right.push_back({x + half * std::sin(heading), y - half * std::cos(heading)});
        left.push_back({x - half * std::sin(heading), y + half * std::cos(heading)});
    }
    right.insert(right.end(), left.rbegin(), left.rend() - 1);  // both begin at the tip
    return {{std::move(right)}};
}

Shape lid_opening(LidSide side, double edge_y_mm, double curvature_radius_mm) {
    require_positive("lid curvature radius (mm)", curvature_radius_mm);
    const double centre_y =
        side == LidSide::kUpper ? edge_y_mm - curvature_radius_mm : edge_y_mm + curvature_radius_mm;
    return disc(curvature_radius_mm, {0, centre_y});
}

}  // namespace aureole::wave
