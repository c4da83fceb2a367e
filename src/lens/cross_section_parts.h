// What a cross-section is put together from.
#pragma once

#include <string>
#include <vector>

#include "aureole/image/drawing.h"
#include "aureole/lens/cross_section.h"

namespace aureole::lens {

// A point of the plane of drawing, in mm of the lens.
struct SectionPoint {
    double z_mm = 0;
    double y_mm = 0;
};

// How the lens lies on the sheet. The frame is what of the plane is drawn: rays end at it.
struct Plate {
    double scale = 1;        // sheet mm per lens mm
    double origin_x_mm = 0;  // where on the sheet the first vertex is
    double axis_y_mm = 0;
    double front_z_mm = 0;  // the frame
    double back_z_mm = 0;
    double half_height_mm = 0;
    double glass_half_height_mm = 0;  // of the largest face

    DrawingPoint at(const SectionPoint& point) const {
        return {origin_x_mm + scale * point.z_mm, axis_y_mm - scale * point.y_mm};
    }
};

// Ink. The glass is cool and the rays are warm or dark, so that they stand out.
inline constexpr DrawingColor kInk = {0.13, 0.15, 0.18, 1};
inline constexpr DrawingColor kGrey = {0.45, 0.48, 0.52, 1};
inline constexpr DrawingColor kGhostColor = {0.86, 0.05, 0.28, 1};
// Of the way back between the two reflections.
inline constexpr DrawingColor kGhostBackColor = {0.98, 0.52, 0.05, 1};
DrawingColor field_color(std::size_t field, const CrossSectionOptions& options);
DrawingColor glass_color(double index);
// Ends of the scale of colours.
inline constexpr double kLeastIndex = 1.45;
inline constexpr double kMostIndex = 1.95;

// The face as a curve from y = -half_height to half_height, in order; beyond its clear aperture it
// goes on as a flat.
std::vector<SectionPoint> face_curve(const Face& face, double half_height_mm);
// Where its clear aperture ends.
double rim_z_mm(const Face& face);
// Half-heights at which the glass ends, of each element with its faces.
struct Element {
    int front = 0;
    int back = 0;
    double index = 1;  // d line
    double half_height_mm = 0;
};
std::vector<Element> elements_of(const Lens& lens);

void draw_elements(const Lens& lens, const Plate& plate, Drawing& drawing);
void draw_stop(const Lens& lens, const Plate& plate, Drawing& drawing);
// Numbers of the faces, with those of the ghost in its colour.
void draw_face_numbers(const Lens& lens, const CrossSectionOptions& options, const Plate& plate,
                       Drawing& drawing);
// Height of the image: of the stated field, or of a picture of 36 mm x 24 mm.
double image_half_height_mm(const Lens& lens);
void draw_axis_and_image_plane(const Lens& lens, const Plate& plate, Drawing& drawing);

void draw_rays(const Lens& lens, const CrossSectionOptions& options, const Plate& plate,
               Drawing& drawing);

// Title above, scales below: where they are does not depend on the lens.
inline constexpr double kTitleHeightMm = 17;
inline constexpr double kScalesHeightMm = 17;
void draw_title(const Lens& lens, const CrossSectionOptions& options, Drawing& drawing);
void draw_scales(const CrossSectionOptions& options, const Plate& plate, Drawing& drawing);

}  // namespace aureole::lens
