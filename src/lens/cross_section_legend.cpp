#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lens/cross_section_parts.h"

namespace aureole::lens {
namespace {

constexpr double kMarginMm = 8;
constexpr double kTextMm = 2.4;

void write(Drawing& drawing, double x_mm, double y_mm, const std::string& text,
           const DrawingColor& color = kInk, double size_mm = kTextMm,
           DrawingText::Anchor anchor = DrawingText::Anchor::kStart) {
    drawing.items.push_back(DrawingText{{x_mm, y_mm}, text, size_mm, color, anchor});
}

// 1, 2 or 5 times a power of ten, at most `most`.
double round_length(double most) {
    const double decade = std::pow(10, std::floor(std::log10(most)));
    const double digit = most / decade;
    return decade * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

void draw_index_scale(double x_mm, double y_mm, Drawing& drawing) {
    constexpr double kWidthMm = 50;
    constexpr double kHeightMm = 2.4;
    constexpr int kSteps = 50;
    const auto at = [&](double index) {
        return x_mm + kWidthMm * (index - kLeastIndex) / (kMostIndex - kLeastIndex);
    };
    const double step = (kMostIndex - kLeastIndex) / kSteps;
    for (int i = 0; i < kSteps; ++i) {
        const double low = kLeastIndex + i * step;
        DrawingArea bar;
        // A little overlap leaves no gaps between antialiased edges.
        const double right = std::min(at(low + step) + 0.1, x_mm + kWidthMm);
        bar.points = {
            {at(low), y_mm}, {right, y_mm}, {right, y_mm + kHeightMm}, {at(low), y_mm + kHeightMm}};
        bar.fill = glass_color(low + step / 2);
        drawing.items.push_back(std::move(bar));
    }
    drawing.items.push_back(DrawingLine{{{x_mm, y_mm},
                                         {x_mm + kWidthMm, y_mm},
                                         {x_mm + kWidthMm, y_mm + kHeightMm},
                                         {x_mm, y_mm + kHeightMm},
                                         {x_mm, y_mm}},
                                        kInk,
                                        0.12,
                                        {}});
    for (const double tick : {1.5, 1.6, 1.7, 1.8, 1.9}) {
        drawing.items.push_back(DrawingLine{
            {{at(tick), y_mm + kHeightMm}, {at(tick), y_mm + kHeightMm + 0.9}}, kInk, 0.12, {}});
        write(drawing, at(tick), y_mm + kHeightMm + 3.2, fmt::format("{:.1f}", tick), kInk, 2.2,
              DrawingText::Anchor::kMiddle);
    }
    write(drawing, x_mm + kWidthMm + 1.5, y_mm + kHeightMm - 0.3, "index (d line)", kGrey, 2.2);
}

void draw_length_scale(double right_mm, double y_mm, double scale, Drawing& drawing) {
    constexpr double kLongestMm = 45;
    const double length = round_length(kLongestMm / scale);
    const double left = right_mm - length * scale;
    drawing.items.push_back(DrawingLine{{{left, y_mm - 1},
                                         {left, y_mm + 1},
                                         {left, y_mm},
                                         {right_mm, y_mm},
                                         {right_mm, y_mm - 1},
                                         {right_mm, y_mm + 1}},
                                        kInk,
                                        0.25,
                                        {}});
    write(drawing, 0.5 * (left + right_mm), y_mm + 3.9, fmt::format("{:g} mm", length), kInk, 2.2,
          DrawingText::Anchor::kMiddle);
}

}  // namespace

void draw_title(const Lens& lens, const CrossSectionOptions& options, Drawing& drawing) {
    const Prescription& table = lens.prescription();
    const double width = drawing.width_mm - 2 * kMarginMm;
    const std::string name = options.title.empty() ? table.name : options.title;
    // A letter is about 0.6 of its size wide; long names are set smaller.
    const auto fitted = [&](const std::string& text, double size_mm, double width_mm) {
        return std::min(size_mm,
                        width_mm / (0.6 * std::max<double>(1, static_cast<double>(text.size()))));
    };
    write(drawing, kMarginMm, 9, name, kInk, fitted(name, 4.6, width));
    std::string facts = fmt::format("f = {:.4g} mm    f/{:.3g}", lens.efl_mm(), lens.f_number());
    if (table.field_deg > 0) facts += fmt::format("    field {:.3g}°", table.field_deg);
    write(drawing, kMarginMm, 14, facts, kInk, 2.8);
    const std::string& source = table.patent;
    const double rest = width - 0.6 * 2.8 * static_cast<double>(facts.size()) - 4;
    write(drawing, drawing.width_mm - kMarginMm, 14, source, kGrey, fitted(source, 2.4, rest),
          DrawingText::Anchor::kEnd);
}

void draw_scales(const CrossSectionOptions& options, const Plate& plate, Drawing& drawing) {
    const double top = drawing.height_mm - kScalesHeightMm + 5;
    draw_index_scale(kMarginMm, top, drawing);
    draw_length_scale(drawing.width_mm - kMarginMm, top + 1.2, plate.scale, drawing);
    if (options.rays_per_field == 0) return;
    constexpr double kLeftMm = kMarginMm + 76;
    constexpr double kRightMm = kMarginMm + 48;  // room for the scale of lengths
    constexpr double kColumnMm = 17;
    constexpr double kRowMm = 3.4;
    const double room = drawing.width_mm - kRightMm - kLeftMm;
    const auto columns = static_cast<std::size_t>(std::max(1.0, room / kColumnMm));
    const auto entry = [&](std::size_t row, double x_mm, const DrawingColor& color,
                           const std::string& text) {
        const double x = kLeftMm + x_mm;
        const double y = top + kRowMm * static_cast<double>(row);
        drawing.items.push_back(DrawingLine{{{x, y + 1}, {x + 5, y + 1}}, color, 0.5, {}});
        write(drawing, x + 6.2, y + 1.8, text, kInk, 2.2);
    };
    const std::size_t count = options.field_angles_deg.size();
    for (std::size_t i = 0; i < count; ++i) {
        entry(i / columns, kColumnMm * static_cast<double>(i % columns), field_color(i, options),
              fmt::format("{:g}°", options.field_angles_deg[i]));
    }
    if (!options.ghost || count == 0) return;
    const std::size_t row = (count + columns - 1) / columns;
    const int far = options.ghost->far + 1;
    const int near = options.ghost->near + 1;
    entry(row, 0, kGhostColor, fmt::format("ghost {},{}", far, near));
    entry(row, 2 * kColumnMm, kGhostBackColor, fmt::format("back from {} to {}", far, near));
}

}  // namespace aureole::lens
