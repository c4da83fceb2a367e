#include "io/drawing_checks.h"

#include <fmt/format.h>

#include <string>
#include <variant>
#include <vector>

#include "aureole/base/error.h"

namespace aureole::io {
void check_number(const char* what, double value, double least, double most) {
    // Cairo's numbers have 24 bits before the point, and it would wrap around silently.
    if (value >= least && value <= most) return;
    throw InvalidArgument(std::string(what) + " of a drawing", fmt::format("{}", value),
                          fmt::format("must be a number in [{}, {}]", least, most));
}

namespace {

void check_color(const DrawingColor& color) {
    for (const double value : {color.red, color.green, color.blue, color.opacity}) {
        check_number("color", value, 0, 1);
    }
}

void check_points(const std::vector<DrawingPoint>& points) {
    for (const DrawingPoint& point : points) {
        check_number("x_mm", point.x_mm);
        check_number("y_mm", point.y_mm);
    }
}

void check_item(const DrawingArea& area) {
    check_points(area.points);
    check_color(area.fill);
    check_color(area.outline);
    check_number("outline_width_mm", area.outline_width_mm, 0);
}

void check_item(const DrawingLine& line) {
    check_points(line.points);
    check_color(line.color);
    check_number("width_mm", line.width_mm, 0);
    double period_mm = 0;
    for (const double length_mm : line.dash_mm) {
        check_number("dash_mm", length_mm, 0);
        period_mm += length_mm;
    }
    // All zeros would never end.
    if (!line.dash_mm.empty()) check_number("dash_mm, its sum,", period_mm, 1e-3);
}

void check_item(const DrawingText& text) {
    check_points({text.position});
    check_color(text.color);
    check_number("size_mm", text.size_mm, 0.01);
}

void check_item(const DrawingImage& image) {
    check_points({image.corner});
    check_number("width_mm of an image", image.width_mm, 1e-3, kLargestSheetMm);
    check_number("height_mm of an image", image.height_mm, 1e-3, kLargestSheetMm);
    check_number("width in pixels of an image", image.pixels.width(), 1, kMostPixels);
    check_number("height in pixels of an image", image.pixels.height(), 1, kMostPixels);
    check_number("channel count of an image", image.pixels.channels(), 3, 3);
}

}  // namespace

void check_drawing(const Drawing& drawing) {
    check_number("width_mm", drawing.width_mm, 1, kLargestSheetMm);
    check_number("height_mm", drawing.height_mm, 1, kLargestSheetMm);
    check_color(drawing.background);
    for (const auto& item : drawing.items) {
        std::visit([](const auto& one) { check_item(one); }, item);
    }
}

}  // namespace aureole::io
