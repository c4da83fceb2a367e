#include "eye/pupil_outline.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::eye {
namespace {

double area_mm2(double diameter_mm) { return kPi * diameter_mm * diameter_mm / 4; }

// Width of the slit of this length and area, at most a disc: the area rises with the width.
double slit_width_mm(double length_mm, double area_mm2) {
    double narrow = 0;
    double wide = length_mm;
    for (int step = 0; step < 52; ++step) {
        const double width = (narrow + wide) / 2;
        (wave::vesica_area_mm2(width, length_mm) < area_mm2 ? narrow : wide) = width;
    }
    return wide;
}

}  // namespace

PupilAxes pupil_axes(const Eye& eye) noexcept {
    const double diameter_mm = eye.pupil_diameter_mm;
    const PupilForm& form = eye.anatomy.pupil;
    if (form.shape == PupilShape::kRound || diameter_mm >= form.iris_mm) {
        return {diameter_mm, diameter_mm};
    }
    if (form.shape == PupilShape::kSlit) {
        return {form.iris_mm, slit_width_mm(form.iris_mm, area_mm2(diameter_mm))};
    }
    const double long_mm = std::min(diameter_mm * std::sqrt(form.axis_ratio), form.iris_mm);
    return {long_mm, diameter_mm * diameter_mm / long_mm};
}

PupilOutline::PupilOutline(const Eye& eye) noexcept
    : shape_(eye.anatomy.pupil.shape), axes_(pupil_axes(eye)) {
    if (axes_.long_mm <= axes_.short_mm) {
        shape_ = PupilShape::kRound;
        return;
    }
    const double rest_deg = shape_ == PupilShape::kSlit ? 90 : 0;
    const double direction = rad_from_deg(rest_deg + eye.anatomy.pupil.rotation_deg);
    axis_x_ = std::cos(direction);
    axis_y_ = std::sin(direction);
    if (shape_ == PupilShape::kSlit) {
        disc_radius_mm_ = wave::vesica_radius_mm(axes_.short_mm, axes_.long_mm);
        disc_offset_mm_ = disc_radius_mm_ - axes_.short_mm / 2;
    }
}

wave::Shape PupilOutline::shape() const {
    const double direction_deg = deg_from_rad(std::atan2(axis_y_, axis_x_));
    switch (shape_) {
        case PupilShape::kRound:
            return wave::disc(axes_.long_mm / 2);
        case PupilShape::kSlit:
            return wave::vesica(axes_.short_mm, axes_.long_mm, direction_deg - 90);
        case PupilShape::kEllipse:
            return wave::ellipse(axes_.long_mm / 2, axes_.short_mm / 2, direction_deg);
    }
    return {};
}

double PupilOutline::support_mm(double direction_x, double direction_y) const {
    const double along = std::abs(direction_x * axis_x_ + direction_y * axis_y_);
    const double across = std::abs(direction_y * axis_x_ - direction_x * axis_y_);
    switch (shape_) {
        case PupilShape::kRound:
            break;
        case PupilShape::kSlit:
            // A tip, or a point of an arc if the direction is among its normals.
            return across * disc_radius_mm_ < disc_offset_mm_
                       ? along * axes_.long_mm / 2
                       : disc_radius_mm_ - across * disc_offset_mm_;
        case PupilShape::kEllipse:
            return std::hypot(along * axes_.long_mm, across * axes_.short_mm) / 2;
    }
    return axes_.long_mm / 2;
}

double PupilOutline::radius_mm(double phi_rad) const {
    const double x = std::cos(phi_rad);
    const double y = std::sin(phi_rad);
    const double along = x * axis_x_ + y * axis_y_;
    const double across = std::abs(y * axis_x_ - x * axis_y_);
    switch (shape_) {
        case PupilShape::kRound:
            break;
        case PupilShape::kSlit: {
            const double middle = across * disc_offset_mm_;
            return std::sqrt(middle * middle + disc_radius_mm_ * disc_radius_mm_ -
                             disc_offset_mm_ * disc_offset_mm_) -
                   middle;
        }
        case PupilShape::kEllipse:
            return 0.5 / std::hypot(along / axes_.long_mm, across / axes_.short_mm);
    }
    return axes_.long_mm / 2;
}

PupilOutline::Chord PupilOutline::vertical_chord(double x_mm) const {
    if (shape_ == PupilShape::kEllipse) {
        // a y^2 + 2 b x y + c x^2 = 1
        const double long2 = axes_.long_mm * axes_.long_mm / 4;
        const double short2 = axes_.short_mm * axes_.short_mm / 4;
        const double a = axis_y_ * axis_y_ / long2 + axis_x_ * axis_x_ / short2;
        const double b = axis_x_ * axis_y_ * (1 / long2 - 1 / short2);
        const double c = axis_x_ * axis_x_ / long2 + axis_y_ * axis_y_ / short2;
        const double root = b * b * x_mm * x_mm - a * (c * x_mm * x_mm - 1);
        if (root <= 0) return {};
        return {(-b * x_mm - std::sqrt(root)) / a, (-b * x_mm + std::sqrt(root)) / a};
    }
    const double radius_mm = round() ? axes_.long_mm / 2 : disc_radius_mm_;
    // Centres on both sides of the long axis; of a round pupil, twice the same.
    Chord chord = {-radius_mm, radius_mm};
    for (const double side : {1.0, -1.0}) {
        const double dx = x_mm + side * disc_offset_mm_ * axis_y_;
        const double y = side * disc_offset_mm_ * axis_x_;
        if (std::abs(dx) >= radius_mm) return {};
        const double half = std::sqrt(radius_mm * radius_mm - dx * dx);
        if (side > 0) {
            chord = {y - half, y + half};
        } else {
            chord = {std::max(chord.low_mm, y - half), std::min(chord.high_mm, y + half)};
        }
    }
    return chord;
}

}  // namespace aureole::eye
