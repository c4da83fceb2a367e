// A technical drawing as data: lines, areas, text and pictures in millimetres. Who makes one needs
// no drawing library; io/write_drawing.h turns it into files.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "aureole/image/image.h"

namespace aureole {

// x to the right, y downwards, from the top left corner of the sheet.
struct DrawingPoint {
    double x_mm = 0;
    double y_mm = 0;
};

// Display values (sRGB), 0 to 1.
struct DrawingColor {
    double red = 0, green = 0, blue = 0;
    double opacity = 1;
};

struct DrawingLine {
    std::vector<DrawingPoint> points;
    DrawingColor color;
    double width_mm = 0.2;
    std::vector<double> dash_mm;  // lengths on, off, on...; empty: solid
};

struct DrawingArea {
    std::vector<DrawingPoint> points;  // closed, even-odd
    DrawingColor fill;
    DrawingColor outline;
    double outline_width_mm = 0;  // 0: none
};

struct DrawingText {
    enum class Anchor { kStart, kMiddle, kEnd };
    DrawingPoint position;  // of the base line
    std::string text;       // UTF-8
    double size_mm = 3;     // font size
    DrawingColor color;
    Anchor anchor = Anchor::kStart;
};

struct DrawingImage {
    DrawingPoint corner;  // its upper left
    double width_mm = 0;
    double height_mm = 0;
    Image pixels;  // display values (sRGB) of 3 channels; clipped to [0, 1], enlarged smoothly
};

struct Drawing {
    double width_mm = 0;
    double height_mm = 0;
    DrawingColor background = {1, 1, 1, 1};
    std::string title;
    // Painted in this order.
    std::vector<std::variant<DrawingArea, DrawingLine, DrawingText, DrawingImage>> items;
};

}  // namespace aureole
