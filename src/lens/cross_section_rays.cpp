#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "aureole/base/units.h"
#include "aureole/lens/glass.h"
#include "aureole/lens/trace.h"
#include "lens/cross_section_parts.h"

namespace aureole::lens {
namespace {

constexpr double kRayMm = 0.16;
constexpr double kGhostRayMm = 0.24;

// One ray of the plane of drawing, up to the sensor or to where an aperture ends it.
struct Trail {
    std::vector<SectionPoint> points;
    bool passes = false;
};

// Rays of one direction, told apart by the height at which they cross the plane of the first
// vertex.
class Fan {
  public:
    Fan(const Lens& lens, const Tracer& tracer, const Bounces& bounces, double angle_deg,
        double front_z_mm)
        : lens_(lens),
          tracer_(tracer),
          bounces_(bounces),
          steps_(steps_of(lens, bounces)),
          slope_(std::tan(rad_from_deg(angle_deg))),
          front_z_mm_(front_z_mm) {
        // What meets the clear aperture of the first face.
        const Face& first = lens.faces()[0];
        low_mm_ = HUGE_VAL;
        high_mm_ = -HUGE_VAL;
        for (const SectionPoint& point : face_curve(first, first.semi_aperture_mm)) {
            const double y = point.y_mm + point.z_mm * slope_;
            low_mm_ = std::min(low_mm_, y);
            high_mm_ = std::max(high_mm_, y);
        }
    }

    double low_mm() const { return low_mm_; }
    double high_mm() const { return high_mm_; }

    Trail trail(double y_mm) const {
        std::vector<Vector> path;
        const TracedRay ray = tracer_.trace(bounces_, ray_from_light(0, slope_, 0, y_mm), &path);
        Trail trail;
        trail.points.push_back({front_z_mm_, y_mm - front_z_mm_ * slope_});
        bool open = true;
        for (std::size_t i = 1; i < path.size() && open; ++i) {
            const SectionPoint point = {path[i][2], path[i][1]};
            open = i > steps_.size() || std::abs(point.y_mm) <= aperture_mm(i - 1);
            trail.points.push_back(open ? point : at_rim(trail.points.back(), point, i - 1));
        }
        trail.passes = open && ray.fate == Fate::kArrived;
        return trail;
    }

    // The widest range of heights at which rays pass, to a thousandth of a percent of the front.
    struct Range {
        double low_mm = 0;
        double high_mm = 0;
    };
    std::optional<Range> passing() const {
        constexpr int kSamples = 801;
        const auto height = [&](int i) {
            return low_mm_ + (high_mm_ - low_mm_) * i / (kSamples - 1);
        };
        int best_begin = 0;
        int best_end = 0;
        for (int i = 0, begin = 0; i < kSamples; ++i) {
            if (!trail(height(i)).passes) begin = i + 1;
            if (i + 1 - begin > best_end - best_begin) {
                best_begin = begin;
                best_end = i + 1;
            }
        }
        if (best_end == best_begin) return std::nullopt;
        Range range{height(best_begin), height(best_end - 1)};
        if (best_begin > 0) range.low_mm = edge(range.low_mm, height(best_begin - 1));
        if (best_end < kSamples) range.high_mm = edge(range.high_mm, height(best_end));
        return range;
    }

  private:
    // Apertures are round; a hair of tolerance lets the rays at the very edge through.
    double aperture_mm(std::size_t step) const {
        const auto face = static_cast<std::size_t>(steps_[step].face);
        return lens_.faces()[face].semi_aperture_mm * (1 + 1e-9);
    }

    // Where a ray that misses the clear aperture of a face meets the plane of its rim, if that is
    // on its way; else the face as it would go on.
    SectionPoint at_rim(const SectionPoint& from, const SectionPoint& to, std::size_t step) const {
        const Face& face = lens_.faces()[static_cast<std::size_t>(steps_[step].face)];
        const double t = (rim_z_mm(face) - from.z_mm) / (to.z_mm - from.z_mm);
        if (!(t > 0 && t < 1)) return to;
        const SectionPoint rim = {from.z_mm + t * (to.z_mm - from.z_mm),
                                  from.y_mm + t * (to.y_mm - from.y_mm)};
        return std::abs(rim.y_mm) > face.semi_aperture_mm ? rim : to;
    }

    double edge(double passes, double ends) const {
        for (int i = 0; i < 24; ++i) {
            const double middle = 0.5 * (passes + ends);
            (trail(middle).passes ? passes : ends) = middle;
        }
        return passes;
    }

    const Lens& lens_;
    const Tracer& tracer_;
    Bounces bounces_;
    std::vector<Step> steps_;
    double slope_ = 0;
    double front_z_mm_ = 0;
    double low_mm_ = 0, high_mm_ = 0;
};

// The part of a to b inside the frame (Liang and Barsky 1984), or nothing.
std::optional<std::array<SectionPoint, 2>> clipped(const Plate& plate, const SectionPoint& a,
                                                   const SectionPoint& b) {
    double enter = 0;
    double leave = 1;
    const auto cut = [&](double from, double step, double low, double high) {
        if (step == 0) return from >= low && from <= high;
        const double t0 = (low - from) / step;
        const double t1 = (high - from) / step;
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
        return enter <= leave;
    };
    const double dz = b.z_mm - a.z_mm;
    const double dy = b.y_mm - a.y_mm;
    if (!cut(a.z_mm, dz, plate.front_z_mm, plate.back_z_mm) ||
        !cut(a.y_mm, dy, -plate.half_height_mm, plate.half_height_mm)) {
        return std::nullopt;
    }
    const auto at = [&](double t) { return SectionPoint{a.z_mm + t * dz, a.y_mm + t * dy}; };
    return std::array{at(enter), at(leave)};
}

// As one line, or as several where it leaves the frame in between.
void draw_polyline(const Plate& plate, std::span<const SectionPoint> points,
                   const DrawingColor& color, double width_mm, Drawing& drawing) {
    DrawingLine line{{}, color, width_mm, {}};
    const auto finish = [&] {
        if (line.points.size() > 1) drawing.items.push_back(line);
        line.points.clear();
    };
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const auto part = clipped(plate, points[i], points[i + 1]);
        if (!part) {
            finish();
            continue;
        }
        const bool joins = (*part)[0].z_mm == points[i].z_mm && (*part)[0].y_mm == points[i].y_mm;
        if (!joins) finish();
        if (line.points.empty()) line.points.push_back(plate.at((*part)[0]));
        line.points.push_back(plate.at((*part)[1]));
    }
    finish();
}

// Heights of `count` rays across a range; one goes through its middle.
std::vector<double> heights(const Fan::Range& range, int count) {
    std::vector<double> result;
    const double step = (range.high_mm - range.low_mm) / std::max(1, count - 1);
    const double first = count == 1 ? 0.5 * (range.low_mm + range.high_mm) : range.low_mm;
    for (int i = 0; i < count; ++i) result.push_back(first + i * step);
    // Not by a rounding error outside.
    if (count > 1) result.back() = range.high_mm;
    return result;
}

void draw_image_rays(const Fan& fan, int count, const DrawingColor& color, bool ended_too,
                     const Plate& plate, Drawing& drawing) {
    constexpr double kEndedOpacity = 0.33;
    const auto draw = [&](double y_mm) {
        const Trail trail = fan.trail(y_mm);
        DrawingColor ink = color;
        if (!trail.passes) ink.opacity *= kEndedOpacity;
        draw_polyline(plate, trail.points, ink, trail.passes ? kRayMm : 0.6 * kRayMm, drawing);
    };
    const auto passing = fan.passing();
    if (!passing) {
        for (const double y : heights({fan.low_mm(), fan.high_mm()}, count)) draw(y);
        return;
    }
    if (ended_too && count > 1) {
        const double step = (passing->high_mm - passing->low_mm) / (count - 1);
        for (int i = 1; i <= (count + 1) / 2; ++i) {
            if (passing->low_mm - i * step > fan.low_mm()) draw(passing->low_mm - i * step);
            if (passing->high_mm + i * step < fan.high_mm()) draw(passing->high_mm + i * step);
        }
    }
    for (const double y : heights(*passing, count)) draw(y);
}

void draw_ghost_rays(const Fan& fan, const Lens& lens, const CrossSectionOptions& options,
                     const Plate& plate, Drawing& drawing) {
    const std::vector<Step> steps = steps_of(lens, *options.ghost);
    const auto reflects = [](const Step& step) { return step.reflects; };
    const auto first = std::find_if(steps.begin(), steps.end(), reflects);
    const auto second = std::find_if(first + 1, steps.end(), reflects);
    // Points of a trail: the start, then one per step.
    const auto turn = static_cast<std::size_t>(first - steps.begin()) + 1;
    const auto back = static_cast<std::size_t>(second - steps.begin()) + 1;
    const auto passing = fan.passing();
    const Fan::Range range = passing.value_or(Fan::Range{fan.low_mm(), fan.high_mm()});
    for (const double y : heights(range, options.rays_per_field)) {
        const Trail trail = fan.trail(y);
        const std::span<const SectionPoint> points = trail.points;
        const auto part = [&](std::size_t begin, std::size_t end, DrawingColor color) {
            end = std::min(end, points.size() - 1);
            if (begin >= end) return;
            if (!trail.passes) color.opacity *= 0.5;
            draw_polyline(plate, points.subspan(begin, end - begin + 1), color, kGhostRayMm,
                          drawing);
        };
        part(0, turn, kGhostColor);
        part(turn, back, kGhostBackColor);
        part(back, points.size(), kGhostColor);
        for (const std::size_t bounce : {turn, back}) {
            if (bounce >= points.size()) continue;
            const DrawingPoint at = plate.at(points[bounce]);
            DrawingArea dot;
            for (int i = 0; i < 16; ++i) {
                const double angle = 2 * kPi * i / 16;
                dot.points.push_back(
                    {at.x_mm + 0.5 * std::cos(angle), at.y_mm + 0.5 * std::sin(angle)});
            }
            dot.fill = kGhostColor;
            drawing.items.push_back(std::move(dot));
        }
    }
}

}  // namespace

DrawingColor field_color(std::size_t field, const CrossSectionOptions& options) {
    constexpr std::array<DrawingColor, 6> kColors = {{{0.80, 0.10, 0.14, 1},
                                                      {0.30, 0.12, 0.55, 1},
                                                      {0.88, 0.42, 0.00, 1},
                                                      {0.05, 0.40, 0.20, 1},
                                                      {0.72, 0.15, 0.55, 1},
                                                      {0.42, 0.28, 0.10, 1}}};
    DrawingColor color = kColors[field % kColors.size()];
    if (options.ghost) color.opacity = 0.35;
    return color;
}

void draw_rays(const Lens& lens, const CrossSectionOptions& options, const Plate& plate,
               Drawing& drawing) {
    if (options.rays_per_field == 0) return;
    const Tracer tracer(lens, kLineDNm);
    for (std::size_t i = 0; i < options.field_angles_deg.size(); ++i) {
        const Fan fan(lens, tracer, Bounces{}, options.field_angles_deg[i], plate.front_z_mm);
        draw_image_rays(fan, options.rays_per_field, field_color(i, options), !options.ghost, plate,
                        drawing);
    }
    if (!options.ghost || options.field_angles_deg.empty()) return;
    const Fan fan(lens, tracer, *options.ghost, options.field_angles_deg[0], plate.front_z_mm);
    draw_ghost_rays(fan, lens, options, plate, drawing);
}

}  // namespace aureole::lens
