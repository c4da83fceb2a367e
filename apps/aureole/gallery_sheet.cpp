#include "gallery_sheet.h"

#include <algorithm>
#include <cmath>

namespace aureole::app {
namespace {

constexpr double kMmPerPixel = 0.25;
// In widths of a panel.
constexpr double kGap = 0.025;
constexpr double kTitle = 0.05;
constexpr double kLabel = 0.038;
constexpr double kDetail = 0.03;
constexpr double kTextHeight = 0.11;  // below a panel
constexpr double kTitleHeight = 0.09;

constexpr DrawingColor kGround = {0.12, 0.12, 0.12, 1};
constexpr DrawingColor kFrame = {0.4, 0.4, 0.4, 1};  // a pixel around each panel: some are as grey
                                                     // as the sheet
constexpr DrawingColor kInk = {0.92, 0.92, 0.92, 1};
constexpr DrawingColor kFaintInk = {0.65, 0.65, 0.65, 1};

// In whole pixels, so that a PNG shows panels pixel by pixel.
struct Layout {
    Layout(const std::vector<SheetPanel>& panels, int column_count)
        : columns(std::min(column_count, static_cast<int>(panels.size()))),
          rows((static_cast<int>(panels.size()) + columns - 1) / columns),
          panel_width(panels.front().display.width()),
          panel_height(panels.front().display.height()),
          gap(pixels(kGap)),
          text_height(pixels(kTextHeight)),
          title_height(pixels(kTitleHeight)) {}

    int pixels(double share) const { return static_cast<int>(std::ceil(share * panel_width)); }
    int width() const { return columns * (panel_width + gap) + gap; }
    int height() const { return title_height + rows * (panel_height + text_height); }
    int left(int index) const { return gap + index % columns * (panel_width + gap); }
    int top(int index) const {
        return title_height + index / columns * (panel_height + text_height);
    }

    int columns;
    int rows;
    int panel_width;
    int panel_height;
    int gap;
    int text_height;
    int title_height;
};

DrawingText text(double x_px, double y_px, const std::string& words, double size_px,
                 const DrawingColor& color) {
    return {{x_px * kMmPerPixel, y_px * kMmPerPixel},
            words,
            size_px * kMmPerPixel,
            color,
            DrawingText::Anchor::kStart};
}

DrawingArea frame_around(double left_px, double top_px, const Layout& layout) {
    const double left = (left_px - 1) * kMmPerPixel;
    const double top = (top_px - 1) * kMmPerPixel;
    const double right = left + (layout.panel_width + 2) * kMmPerPixel;
    const double bottom = top + (layout.panel_height + 2) * kMmPerPixel;
    return {{{left, top}, {right, top}, {right, bottom}, {left, bottom}}, kFrame, kFrame, 0};
}

}  // namespace

int contact_sheet_width_px(const std::vector<SheetPanel>& panels, int columns) {
    return Layout(panels, columns).width();
}

Drawing contact_sheet(const std::string& title, const std::vector<SheetPanel>& panels,
                      int columns) {
    const Layout layout(panels, columns);
    const double width = layout.panel_width;
    Drawing drawing;
    drawing.width_mm = kMmPerPixel * layout.width();
    drawing.height_mm = kMmPerPixel * layout.height();
    drawing.background = kGround;
    drawing.title = title;
    drawing.items.emplace_back(text(layout.gap, 0.062 * width, title, kTitle * width, kInk));
    for (int i = 0; i < static_cast<int>(panels.size()); ++i) {
        const SheetPanel& panel = panels[static_cast<std::size_t>(i)];
        const double left = layout.left(i);
        const double bottom = layout.top(i) + layout.panel_height;
        drawing.items.emplace_back(frame_around(left, layout.top(i), layout));
        drawing.items.emplace_back(DrawingImage{{left * kMmPerPixel, layout.top(i) * kMmPerPixel},
                                                width * kMmPerPixel,
                                                layout.panel_height * kMmPerPixel,
                                                panel.display});
        drawing.items.emplace_back(
            text(left, bottom + 0.042 * width, panel.label, kLabel * width, kInk));
        drawing.items.emplace_back(
            text(left, bottom + 0.082 * width, panel.detail, kDetail * width, kFaintInk));
    }
    return drawing;
}

}  // namespace aureole::app
