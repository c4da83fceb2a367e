#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/ibl/preview.h"

namespace aureole::ibl {
namespace {

constexpr double kMmPerPixel = 0.25;
// In cells.
constexpr double kLabelsWidth = 1.6;
constexpr double kHeadingHeight = 0.25;
constexpr double kText = 0.1;
constexpr double kSmallText = 0.08;
constexpr double kGap = 0.05;
constexpr double kPlateWidth = 0.34;
constexpr double kPlateHeight = 0.105;

constexpr DrawingColor kGround = {0.12, 0.12, 0.12, 1};
constexpr DrawingColor kPlate = {0.12, 0.12, 0.12, 0.75};
constexpr DrawingColor kInk = {0.9, 0.9, 0.9, 1};

DrawingText text(double x_px, double y_px, const std::string& words, double size_px,
                 DrawingText::Anchor anchor) {
    return {{x_px * kMmPerPixel, y_px * kMmPerPixel}, words, size_px * kMmPerPixel, kInk, anchor};
}

// Makes a number readable on any ground.
DrawingArea plate(double left_px, double top_px, double right_px, double bottom_px) {
    DrawingArea area;
    for (const auto& [x, y] : {std::pair{left_px, top_px}, std::pair{right_px, top_px},
                               std::pair{right_px, bottom_px}, std::pair{left_px, bottom_px}}) {
        area.points.push_back({x * kMmPerPixel, y * kMmPerPixel});
    }
    area.fill = kPlate;
    return area;
}

// In whole pixels of the sheet, so that a PNG shows it pixel by pixel.
struct Layout {
    explicit Layout(const PreviewSheet& sheet)
        : cell(sheet.cell_px),
          left(static_cast<int>(std::ceil(kLabelsWidth * cell))),
          top(static_cast<int>(std::ceil(kHeadingHeight * cell))),
          margin(static_cast<int>(std::ceil(kGap * cell))) {}
    double cell;
    int left;
    int top;
    int margin;  // at the right and below
};

std::string percent(double share) {
    const double value = 100 * share;
    return value >= 10 ? fmt::format("{:.0f} %", value)
                       : fmt::format("{:.{}f} %", value, value < 1 ? 2 : 1);
}

}  // namespace

int preview_drawing_width_px(const PreviewSheet& sheet) {
    const Layout layout(sheet);
    return layout.left + sheet.pixels.width() + layout.margin;
}

Drawing preview_drawing(const PreviewSheet& sheet, const Image& display) {
    if (display.width() != sheet.pixels.width() || display.height() != sheet.pixels.height() ||
        display.channels() != 3) {
        throw InvalidArgument(
            "display",
            fmt::format("{} x {} x {}", display.width(), display.height(), display.channels()),
            fmt::format("must be as large as the sheet, {} x {} x 3", sheet.pixels.width(),
                        sheet.pixels.height()));
    }
    const Layout layout(sheet);
    const double cell = layout.cell;
    Drawing drawing;
    drawing.width_mm = kMmPerPixel * preview_drawing_width_px(sheet);
    drawing.height_mm = kMmPerPixel * (layout.top + display.height() + layout.margin);
    drawing.background = kGround;
    drawing.title = "Filtered environment";
    drawing.items.push_back(DrawingImage{{layout.left * kMmPerPixel, layout.top * kMmPerPixel},
                                         display.width() * kMmPerPixel,
                                         display.height() * kMmPerPixel,
                                         display});
    for (std::size_t column = 0; column < sheet.columns.size(); ++column) {
        drawing.items.push_back(text(layout.left + (static_cast<double>(column) + 0.5) * cell,
                                     layout.top - kGap * cell, sheet.columns[column], kText * cell,
                                     DrawingText::Anchor::kMiddle));
    }
    for (std::size_t row = 0; row < sheet.rows.size(); ++row) {
        const double top = layout.top + static_cast<double>(row) * cell;
        const PreviewRow& labels = sheet.rows[row];
        drawing.items.push_back(text(layout.left - kGap * cell, top + (0.5 + kText / 3) * cell,
                                     labels.label, kText * cell, DrawingText::Anchor::kEnd));
        for (std::size_t column = 0; column < labels.difference.size(); ++column) {
            const double right = layout.left + static_cast<double>(column + 1) * cell;
            const double bottom = top + cell;
            drawing.items.push_back(
                plate(right - kPlateWidth * cell, bottom - kPlateHeight * cell, right, bottom));
            drawing.items.push_back(text(right - kGap / 2 * cell, bottom - kGap / 2 * cell,
                                         percent(labels.difference[column]), kSmallText * cell,
                                         DrawingText::Anchor::kEnd));
        }
    }
    return drawing;
}

}  // namespace aureole::ibl
