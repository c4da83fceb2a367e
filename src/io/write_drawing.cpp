// Cairo paints the same calls on all three kinds of sheet; its user space is the sheet in mm.
#include "aureole/io/write_drawing.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <type_traits>

#include "aureole/base/error.h"
#include "io/atomic_file.h"
#include "io/drawing_checks.h"

namespace aureole::io {
namespace {

constexpr double kPointsPerMm = 72 / 25.4;
constexpr int kLeastPixels = 16;

enum class Format { kSvg, kPng, kPdf };

Format format_of(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".svg") return Format::kSvg;
    if (extension == ".png") return Format::kPng;
    if (extension == ".pdf") return Format::kPdf;
    throw InvalidArgument("drawing", path, "must end in .svg, .png or .pdf");
}

// How many bytes the character at `at` has, or 0 if it is no UTF-8 or not to be printed. Neither is
// a reason to draw nothing: names come from files of any age.
std::size_t character_length(const std::string& text, std::size_t at) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(at);
    if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || at + length > text.size()) return 0;
    for (std::size_t i = at + 1; i < at + length; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return 0;
    }
    // Too long for what they mean (Unicode, table 3-7), surrogates, beyond U+10FFFF, no characters.
    const unsigned second = byte(at + 1);
    const bool bad = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                     (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F) ||
                     (first == 0xC2 && second < 0xA0) ||
                     (first == 0xEF && second == 0xBF && byte(at + 2) > 0xBD);
    return bad ? 0 : length;
}

std::string printable(const std::string& text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = character_length(text, at);
        result += length == 0 ? "?" : text.substr(at, length);
        at += std::max<std::size_t>(1, length);
    }
    return result;
}

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

void set_color(cairo_t* cairo, const DrawingColor& color) {
    cairo_set_source_rgba(cairo, color.red, color.green, color.blue, color.opacity);
}

void trace(cairo_t* cairo, const std::vector<DrawingPoint>& points) {
    for (const DrawingPoint& point : points) cairo_line_to(cairo, point.x_mm, point.y_mm);
}

void paint(cairo_t* cairo, const DrawingArea& area) {
    if (area.points.size() < 3) return;
    trace(cairo, area.points);
    cairo_close_path(cairo);
    set_color(cairo, area.fill);
    if (area.outline_width_mm == 0) return cairo_fill(cairo);
    cairo_fill_preserve(cairo);
    set_color(cairo, area.outline);
    cairo_set_line_width(cairo, area.outline_width_mm);
    cairo_set_dash(cairo, nullptr, 0, 0);
    cairo_stroke(cairo);
}

void paint(cairo_t* cairo, const DrawingLine& line) {
    if (line.points.size() < 2 || line.width_mm == 0) return;
    trace(cairo, line.points);
    set_color(cairo, line.color);
    cairo_set_line_width(cairo, line.width_mm);
    cairo_set_dash(cairo, line.dash_mm.data(), static_cast<int>(line.dash_mm.size()), 0);
    cairo_stroke(cairo);
}

void paint(cairo_t* cairo, const DrawingText& text) {
    const std::string letters = printable(text.text);
    cairo_set_font_size(cairo, text.size_mm);
    double x_mm = text.position.x_mm;
    if (text.anchor != DrawingText::Anchor::kStart) {
        cairo_text_extents_t extents;
        cairo_text_extents(cairo, letters.c_str(), &extents);
        const bool middle = text.anchor == DrawingText::Anchor::kMiddle;
        x_mm -= middle ? extents.x_advance / 2 : extents.x_advance;
    }
    set_color(cairo, text.color);
    cairo_move_to(cairo, x_mm, text.position.y_mm);
    cairo_show_text(cairo, letters.c_str());
    cairo_new_path(cairo);
}

std::uint32_t byte_of(float value) {
    // Not a number is 0 too.
    return value > 0 ? static_cast<std::uint32_t>(std::min(value, 1.0F) * 255 + 0.5F) : 0;
}

Surface surface_of(const Image& pixels) {
    Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels.width(), pixels.height()),
                    cairo_surface_destroy);
    unsigned char* data = cairo_image_surface_get_data(surface.get());
    if (data == nullptr) return surface;  // its error reaches whoever paints with it
    for (int y = 0; y < pixels.height(); ++y) {
        // Rows are aligned to whole pixels of 32 bits.
        auto* const row = reinterpret_cast<std::uint32_t*>(data);
        for (int x = 0; x < pixels.width(); ++x) {
            row[x] = byte_of(pixels.at(x, y, 0)) << 16U | byte_of(pixels.at(x, y, 1)) << 8U |
                     byte_of(pixels.at(x, y, 2));
        }
        data += cairo_image_surface_get_stride(surface.get());
    }
    cairo_surface_mark_dirty(surface.get());
    return surface;
}

void paint(cairo_t* cairo, const DrawingImage& image) {
    const Surface surface = surface_of(image.pixels);
    cairo_save(cairo);
    cairo_translate(cairo, image.corner.x_mm, image.corner.y_mm);
    cairo_rectangle(cairo, 0, 0, image.width_mm, image.height_mm);
    cairo_clip(cairo);
    cairo_scale(cairo, image.width_mm / image.pixels.width(),
                image.height_mm / image.pixels.height());
    cairo_set_source_surface(cairo, surface.get(), 0, 0);
    // Without this its edge pixels fade out.
    cairo_pattern_set_extend(cairo_get_source(cairo), CAIRO_EXTEND_PAD);
    cairo_paint(cairo);
    cairo_restore(cairo);
}

void paint(cairo_t* cairo, const Drawing& drawing) {
    set_color(cairo, drawing.background);
    cairo_rectangle(cairo, 0, 0, drawing.width_mm, drawing.height_mm);
    cairo_fill(cairo);
    cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_EVEN_ODD);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    // Letters of the same width at any scale, so that all three formats show one layout.
    cairo_font_options_t* const options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(cairo, options);
    cairo_font_options_destroy(options);
    for (const auto& item : drawing.items) {
        std::visit([&](const auto& one) { paint(cairo, one); }, item);
    }
}

cairo_status_t append(void* closure, const unsigned char* data, unsigned length) {
    auto& bytes = *static_cast<std::string*>(closure);
    bytes.append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void check_status(cairo_status_t status, const std::string& path) {
    if (status == CAIRO_STATUS_SUCCESS) return;
    throw FileError(path, std::string("cannot be drawn: ") + cairo_status_to_string(status));
}

Surface make_surface(Format format, const Drawing& drawing, int png_width_px, std::string& bytes) {
    switch (format) {
        case Format::kSvg: {
            Surface surface(cairo_svg_surface_create_for_stream(append, &bytes, drawing.width_mm,
                                                                drawing.height_mm),
                            cairo_surface_destroy);
            cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_MM);
            return surface;
        }
        case Format::kPdf: {
            Surface surface(
                cairo_pdf_surface_create_for_stream(append, &bytes, drawing.width_mm * kPointsPerMm,
                                                    drawing.height_mm * kPointsPerMm),
                cairo_surface_destroy);
            cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE,
                                           printable(drawing.title).c_str());
            // The same drawing is the same file: without the hour at which it was made.
            cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
            return surface;
        }
        default: {
            const double height_px = drawing.height_mm * png_width_px / drawing.width_mm;
            return {cairo_image_surface_create(CAIRO_FORMAT_ARGB32, png_width_px,
                                               std::max(1, static_cast<int>(height_px + 0.5))),
                    cairo_surface_destroy};
        }
    }
}

double units_per_mm(Format format, const Drawing& drawing, int png_width_px) {
    switch (format) {
        case Format::kSvg:
            return 1;
        case Format::kPdf:
            return kPointsPerMm;
        default:
            return png_width_px / drawing.width_mm;
    }
}

std::string encode(Format format, const Drawing& drawing, int png_width_px,
                   const std::string& path) {
    std::string bytes;
    const Surface surface = make_surface(format, drawing, png_width_px, bytes);
    check_status(cairo_surface_status(surface.get()), path);
    {
        const Context cairo(cairo_create(surface.get()), cairo_destroy);
        const double scale = units_per_mm(format, drawing, png_width_px);
        cairo_scale(cairo.get(), scale, scale);
        paint(cairo.get(), drawing);
        check_status(cairo_status(cairo.get()), path);
    }
    if (format == Format::kPng) {
        check_status(cairo_surface_write_to_png_stream(surface.get(), append, &bytes), path);
    }
    cairo_surface_finish(surface.get());
    check_status(cairo_surface_status(surface.get()), path);
    return bytes;
}

// Cairo gives an SVG no title, which is what browsers and screen readers show of it, and an id that
// counts the surfaces of the process.
void finish_svg(std::string& svg, const std::string& title) {
    const std::string id = "<g id=\"surface";
    const std::size_t group = svg.find(id);
    if (group != std::string::npos) svg.replace(group, svg.find('>', group) - group, "<g");
    if (title.empty()) return;
    std::string element = "\n<title>";
    for (const char c : printable(title)) {
        element += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    }
    svg.insert(svg.find('>', svg.find("<svg")) + 1, element + "</title>");
}

}  // namespace

void check_drawing_extension(const std::string& path) { format_of(path); }

void write_drawing(const std::string& path, const Drawing& drawing, int png_width_px) {
    const Format format = format_of(path);
    check_drawing(drawing);
    if (format == Format::kPng) {
        const double height_px = drawing.height_mm * png_width_px / drawing.width_mm;
        if (png_width_px < kLeastPixels || png_width_px > kMostPixels || height_px > kMostPixels) {
            throw InvalidArgument(
                "png_width_px", std::to_string(png_width_px),
                fmt::format("must be in [{}, {}], and the height that goes with it at most {}",
                            kLeastPixels, kMostPixels, kMostPixels));
        }
    }
    AtomicFile file(path);
    std::string bytes = encode(format, drawing, png_width_px, path);
    if (format == Format::kSvg) finish_svg(bytes, drawing.title);
    file.write(bytes.data(), bytes.size());
    file.commit();
}

}  // namespace aureole::io
