#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "aureole/base/units.h"
#include "aureole/lens/glass.h"
#include "lens/cross_section_parts.h"
#include "lens/sag.h"

namespace aureole::lens {
namespace {

constexpr double kOutlineMm = 0.2;

// Height of the face above the plane of its vertex; that of the nearest y below where it ends.
double sag_mm(const Face& face, double y_mm) {
    for (const double shrink : {1.0, 1 - 1e-9, 1 - 1e-6, 1 - 1e-4}) {
        const auto hit = intersect(face, {0, y_mm * shrink, 0}, {0, 0, 1});
        if (hit) return hit->point[2];
    }
    return 0;
}

bool exists_at(const Face& face, double y_mm) {
    return intersect(face, {0, y_mm, 0}, {0, 0, 1}).has_value();
}

}  // namespace

double rim_z_mm(const Face& face) { return face.z_mm + sag_mm(face, face.semi_aperture_mm); }

namespace {

// The part of the curve that is not flat, when the glass ends at `half_height_mm`. Makers grind a
// flat from the clear aperture to the edge, unless the other face has come so near by then that
// there is no room; the curve then goes on.
Face with_room(Face face, const Face& other, bool front, double half_height_mm) {
    const double gap = front ? rim_z_mm(other) - rim_z_mm(face) : rim_z_mm(face) - rim_z_mm(other);
    if (gap <= 0 && exists_at(face, half_height_mm)) face.semi_aperture_mm = half_height_mm;
    return face;
}

}  // namespace

std::vector<SectionPoint> face_curve(const Face& face, double half_height_mm) {
    constexpr int kHalf = 48;
    std::vector<SectionPoint> points;
    const double h = std::min(face.semi_aperture_mm, half_height_mm);
    const double edge_z = face.z_mm + sag_mm(face, h);
    if (half_height_mm > h) points.push_back({edge_z, -half_height_mm});
    for (int i = -kHalf; i <= kHalf; ++i) {
        // Denser towards the edge, where a curve may be steep.
        const double y = h * std::sin(0.5 * kPi * i / kHalf);
        points.push_back({face.z_mm + sag_mm(face, y), y});
    }
    if (half_height_mm > h) points.push_back({edge_z, half_height_mm});
    return points;
}

std::vector<Element> elements_of(const Lens& lens) {
    std::vector<Element> elements;
    const auto faces = lens.faces();
    const std::vector<double> index = lens.indices(kLineDNm);
    for (std::size_t k = 0; k + 1 < faces.size(); ++k) {
        const bool glass = std::abs(index[k + 1] - 1) > 1e-6;
        if (!glass || faces[k].stop) continue;
        // A stop inside the glass does not cut it.
        const std::size_t back = faces[k + 1].stop && k + 2 < faces.size() ? k + 2 : k + 1;
        elements.push_back({static_cast<int>(k), static_cast<int>(back), index[k + 1],
                            std::max(faces[k].semi_aperture_mm, faces[back].semi_aperture_mm)});
    }
    return elements;
}

DrawingColor glass_color(double index) {
    // Pale green to blue, even steps of lightness.
    constexpr std::array<std::array<double, 3>, 5> kStops = {{{0.91, 0.96, 0.84},
                                                              {0.74, 0.89, 0.83},
                                                              {0.55, 0.79, 0.84},
                                                              {0.40, 0.65, 0.82},
                                                              {0.31, 0.49, 0.74}}};
    const double t = std::clamp((index - kLeastIndex) / (kMostIndex - kLeastIndex), 0.0, 1.0) *
                     (kStops.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(t), kStops.size() - 2);
    const double w = t - static_cast<double>(i);
    const auto mix = [&](std::size_t c) { return (1 - w) * kStops[i][c] + w * kStops[i + 1][c]; };
    return {mix(0), mix(1), mix(2), 1};
}

void draw_elements(const Lens& lens, const Plate& plate, Drawing& drawing) {
    const auto faces = lens.faces();
    for (const Element& element : elements_of(lens)) {
        const Face& front = faces[static_cast<std::size_t>(element.front)];
        const Face& back = faces[static_cast<std::size_t>(element.back)];
        const double h = element.half_height_mm;
        DrawingArea area;
        for (const SectionPoint& point : face_curve(with_room(front, back, true, h), h)) {
            area.points.push_back(plate.at(point));
        }
        std::vector<SectionPoint> rear = face_curve(with_room(back, front, false, h), h);
        std::reverse(rear.begin(), rear.end());
        for (const SectionPoint& point : rear) area.points.push_back(plate.at(point));
        area.fill = glass_color(element.index);
        area.outline = kInk;
        area.outline_width_mm = kOutlineMm;
        drawing.items.push_back(std::move(area));
    }
}

void draw_stop(const Lens& lens, const Plate& plate, Drawing& drawing) {
    const Face& stop = lens.faces()[static_cast<std::size_t>(lens.stop())];
    const double printed_mm =
        lens.prescription().surfaces[static_cast<std::size_t>(lens.stop())].semi_aperture_mm;
    constexpr double kWedgeMm = 3;  // on the sheet
    constexpr double kHalfWidthMm = 0.7;
    const double tip = stop.semi_aperture_mm;
    const double wedge = tip + kWedgeMm / plate.scale;
    const double outer = std::max(wedge, printed_mm + kWedgeMm / plate.scale);
    for (const double side : {1.0, -1.0}) {
        const DrawingPoint end = plate.at({stop.z_mm, side * outer});
        drawing.items.push_back(
            DrawingLine{{plate.at({stop.z_mm, side * tip}), end}, kInk, 0.45, {}});
        const DrawingPoint root = plate.at({stop.z_mm, side * wedge});
        drawing.items.push_back(DrawingArea{{plate.at({stop.z_mm, side * tip}),
                                             {root.x_mm - kHalfWidthMm, root.y_mm},
                                             {root.x_mm + kHalfWidthMm, root.y_mm}},
                                            kInk,
                                            {},
                                            0});
    }
}

void draw_face_numbers(const Lens& lens, const CrossSectionOptions& options, const Plate& plate,
                       Drawing& drawing) {
    constexpr double kSizeMm = 2;
    constexpr double kRowMm = 2.6;
    constexpr int kRows = 4;
    const auto faces = lens.faces();
    std::array<double, kRows> taken;
    taken.fill(-1e9);
    const double top = plate.axis_y_mm + plate.scale * plate.glass_half_height_mm + 1;
    for (std::size_t k = 0; k < faces.size(); ++k) {
        const Face& face = faces[k];
        const auto is = [&](int other) { return static_cast<int>(k) == other; };
        const bool bounce = options.ghost && (is(options.ghost->far) || is(options.ghost->near));
        const std::string number = std::to_string(k + 1);
        const double width = 0.75 * kSizeMm * static_cast<double>(number.size());
        const DrawingPoint from = plate.at({rim_z_mm(face), -face.semi_aperture_mm});
        // The first row with room; without any, the least crowded.
        std::size_t row = 0;
        while (row + 1 < kRows && from.x_mm - width / 2 < taken[row]) ++row;
        if (from.x_mm - width / 2 < taken[row]) {
            row = static_cast<std::size_t>(std::min_element(taken.begin(), taken.end()) -
                                           taken.begin());
        }
        taken[row] = from.x_mm + width / 2 + 0.3;
        const double base = top + kRowMm * static_cast<double>(row + 1);
        DrawingColor leader = bounce ? kGhostColor : kGrey;
        leader.opacity = bounce ? 0.8 : 0.45;
        drawing.items.push_back(DrawingLine{
            {from, {from.x_mm, base - 0.8 * kSizeMm}}, leader, bounce ? 0.18 : 0.09, {}});
        drawing.items.push_back(DrawingText{{from.x_mm, base},
                                            number,
                                            kSizeMm,
                                            bounce ? kGhostColor : kGrey,
                                            DrawingText::Anchor::kMiddle});
    }
}

double image_half_height_mm(const Lens& lens) {
    constexpr double kHalfDiagonalMm = 21.633;  // of 36 mm x 24 mm
    const double half_field = lens.prescription().field_deg / 2 * kPi / 180;
    if (half_field <= 0) return kHalfDiagonalMm;
    // A wider field than this can only be had with the image compressed, as fisheyes do.
    constexpr double kWidestDeg = 55;
    return lens.efl_mm() *
           (half_field < kWidestDeg * kPi / 180 ? std::tan(half_field) : half_field);
}

void draw_axis_and_image_plane(const Lens& lens, const Plate& plate, Drawing& drawing) {
    const DrawingPoint start = plate.at({plate.front_z_mm, 0});
    const DrawingPoint end = plate.at({plate.back_z_mm, 0});
    drawing.items.push_back(DrawingLine{
        {{start.x_mm - 2, start.y_mm}, {end.x_mm + 3, end.y_mm}}, kGrey, 0.12, {5, 1, 0.6, 1}});
    const double height = image_half_height_mm(lens);
    const bool whole = height <= plate.half_height_mm;
    const double drawn = std::min(height, plate.half_height_mm);
    const DrawingPoint top = plate.at({lens.sensor_z_mm(), drawn});
    const DrawingPoint bottom = plate.at({lens.sensor_z_mm(), -drawn});
    drawing.items.push_back(DrawingLine{{top, bottom}, kInk, 0.5, {}});
    if (whole) {
        for (const DrawingPoint& corner : {top, bottom}) {
            drawing.items.push_back(
                DrawingLine{{corner, {corner.x_mm + 1.5, corner.y_mm}}, kInk, 0.25, {}});
        }
    }
    DrawingText label;
    label.position = {top.x_mm + 2.2, top.y_mm + (whole ? 0.8 : 2.5)};
    label.size_mm = 2.2;
    label.color = kGrey;
    label.text = fmt::format("{}{:.1f} mm", whole ? "" : "to ", height);
    drawing.items.push_back(label);
}

}  // namespace aureole::lens
