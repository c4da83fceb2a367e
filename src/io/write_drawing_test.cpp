#include "aureole/io/write_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/color/rgb.h"
#include "aureole/io/picture.h"
#include "io/test_support.h"

namespace aureole::io {
namespace {

constexpr DrawingColor kRed = {1, 0, 0, 1};
constexpr DrawingColor kBlue = {0, 0, 1, 1};
constexpr DrawingColor kBlack = {0, 0, 0, 1};

// 100 mm x 50 mm: a red square from (10, 10) to (30, 30), a blue bar along y = 40 from x = 10 to
// 90, 4 mm wide, and a word that ends at x = 90.
Drawing sheet() {
    Drawing drawing;
    drawing.width_mm = 100;
    drawing.height_mm = 50;
    drawing.title = "1 < 2 & more";
    drawing.items.push_back(DrawingArea{{{10, 10}, {30, 10}, {30, 30}, {10, 30}}, kRed, {}, 0});
    drawing.items.push_back(DrawingLine{{{10, 40}, {90, 40}}, kBlue, 4, {}});
    DrawingText text{{90, 20}, "HHHH", 8, kBlack, DrawingText::Anchor::kEnd};
    drawing.items.push_back(text);
    return drawing;
}

std::size_t count(const std::string& text, const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        ++found;
    }
    return found;
}

// Every element that opens is closed, in order; attributes are quoted. Enough of XML for files
// without comments or CDATA.
bool well_formed(const std::string& text) {
    std::vector<std::string> open;
    bool had_root = false;
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
        const std::size_t end = text.find('>', at);
        if (end == std::string::npos) return false;
        const std::string tag = text.substr(at + 1, end - at - 1);
        at = end;
        if (tag.empty() || tag.find('<') != std::string::npos || count(tag, "\"") % 2 != 0) {
            return false;
        }
        if (tag.front() == '?') continue;
        if (tag.front() == '/') {
            if (open.empty() || open.back() != tag.substr(1)) return false;
            open.pop_back();
        } else if (tag.back() != '/') {
            if (open.empty() && had_root) return false;
            had_root = true;
            open.push_back(tag.substr(0, tag.find_first_of(" \n")));
        }
    }
    for (std::size_t at = text.find('&'); at != std::string::npos; at = text.find('&', at + 1)) {
        const std::string entity = text.substr(at, text.find(';', at) - at + 1);
        if (entity.size() > 6 || entity.back() != ';') return false;
    }
    return had_root && open.empty();
}

TEST(WriteDrawing, SvgHoldsEveryItemAsAPathInMillimetres) {
    const TemporaryFolder folder;
    const std::string path = folder.file("sheet.svg");
    write_drawing(path, sheet());
    const std::string svg = read_bytes(path);
    EXPECT_TRUE(well_formed(svg)) << svg;
    EXPECT_NE(svg.find("width=\"100mm\" height=\"50mm\""), std::string::npos) << svg;
    EXPECT_NE(svg.find("viewBox=\"0 0 100 50\""), std::string::npos) << svg;
    EXPECT_NE(svg.find("<title>1 &lt; 2 &amp; more</title>"), std::string::npos) << svg;
    // Behind the definition of the letters: two paths and four uses of one letter.
    const std::string body = svg.substr(svg.find("</defs>"));
    EXPECT_EQ(count(body, "<path "), 2U) << svg;
    EXPECT_EQ(count(body, "<use "), 4U) << svg;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"sheet.svg"});
}

// Means over the mm squares around a point, as display values.
double mean(const Picture& picture, double pixels_per_mm, double x_mm, double y_mm, int channel,
            double radius_mm = 1) {
    double sum = 0;
    int n = 0;
    const auto pixel = [&](double mm) { return static_cast<int>(std::lround(mm * pixels_per_mm)); };
    for (int y = pixel(y_mm - radius_mm); y < pixel(y_mm + radius_mm); ++y) {
        for (int x = pixel(x_mm - radius_mm); x < pixel(x_mm + radius_mm); ++x) {
            sum += picture.image().at(x, y, channel);
            ++n;
        }
    }
    return sum / n;
}

TEST(WriteDrawing, PngHasTheInkWhereItShould) {
    const TemporaryFolder folder;
    const std::string path = folder.file("sheet.PNG");
    write_drawing(path, sheet(), 400);
    const Picture picture = read_picture(path);
    ASSERT_EQ(picture.image().width(), 400);
    ASSERT_EQ(picture.image().height(), 200);
    const auto color = [&](double x_mm, double y_mm) {
        return std::vector<double>{mean(picture, 4, x_mm, y_mm, 0), mean(picture, 4, x_mm, y_mm, 1),
                                   mean(picture, 4, x_mm, y_mm, 2)};
    };
    const std::vector<double> red = {1, 0, 0};
    const std::vector<double> blue = {0, 0, 1};
    const std::vector<double> white = {1, 1, 1};
    EXPECT_EQ(color(11, 11), red);
    EXPECT_EQ(color(29, 29), red);
    EXPECT_EQ(color(8, 20), white);
    EXPECT_EQ(color(32, 20), white);
    EXPECT_EQ(color(50, 40), blue);
    EXPECT_EQ(color(11, 39.1), blue);
    EXPECT_EQ(color(89, 40.9), blue);
    EXPECT_EQ(color(50, 43), white);
    EXPECT_EQ(color(8, 40), white);
    // Four letters of at least half an em each, ending at x = 90 and standing on y = 20.
    EXPECT_LT(mean(picture, 4, 80, 17, 0, 3), 0.9);
    EXPECT_LT(mean(picture, 4, 86, 17, 0, 3), 0.9);
    EXPECT_EQ(color(92, 17), white);
    EXPECT_EQ(color(85, 22), white);
}

TEST(WriteDrawing, DashesLeaveGaps) {
    const TemporaryFolder folder;
    Drawing drawing = sheet();
    std::get<DrawingLine>(drawing.items[1]).dash_mm = {10, 10};
    write_drawing(folder.file("dashed.png"), drawing, 400);
    const Picture picture = read_picture(folder.file("dashed.png"));
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(mean(picture, 4, 15 + 10 * i, 40, 0), i % 2 == 0 ? 0 : 1) << i;
    }
}

TEST(WriteDrawing, OverlapsAreEvenOddAndOpacityMixes) {
    const TemporaryFolder folder;
    Drawing drawing = sheet();
    drawing.items.clear();
    // A square in a square in one contour, both clockwise: the middle is wound around twice.
    drawing.items.push_back(DrawingArea{{{10, 10},
                                         {40, 10},
                                         {40, 40},
                                         {10, 40},
                                         {10, 10},
                                         {20, 20},
                                         {30, 20},
                                         {30, 30},
                                         {20, 30},
                                         {20, 20}},
                                        kBlack,
                                        {},
                                        0});
    DrawingColor half = kBlack;
    half.opacity = 0.5;
    drawing.items.push_back(DrawingLine{{{50, 25}, {90, 25}}, half, 10, {}});
    write_drawing(folder.file("mix.png"), drawing, 400);
    const Picture picture = read_picture(folder.file("mix.png"));
    EXPECT_EQ(mean(picture, 4, 15, 25, 0), 0);
    EXPECT_EQ(mean(picture, 4, 25, 25, 0), 1);
    // Half of white in display values; read_picture() makes it linear: ((0.5 + 0.055) / 1.055)^2.4.
    EXPECT_NEAR(mean(picture, 4, 70, 25, 0), 0.2140, 0.003);
}

// One pixel per mm in the image and in the PNG.
TEST(WriteDrawing, ImagesKeepTheirPixelsPlaceAndOrder) {
    const TemporaryFolder folder;
    Drawing drawing = sheet();
    DrawingImage image{{50, 10}, 20, 10, Image(20, 10, 3)};
    for (int y = 0; y < 10; ++y) {
        for (int x = 0; x < 20; ++x) {
            image.pixels.at(x, y, 0) = static_cast<float>(x) / 19;
            image.pixels.at(x, y, 1) = static_cast<float>(y) / 9;
            image.pixels.at(x, y, 2) = x < y ? 2.0F : -1.0F;
        }
    }
    image.pixels.at(3, 3, 0) = std::nanf("");
    drawing.items.clear();
    drawing.items.push_back(image);
    write_drawing(folder.file("image.png"), drawing, 100);
    const Picture picture = read_picture(folder.file("image.png"));
    for (int y = 0; y < 50; ++y) {
        for (int x = 0; x < 100; ++x) {
            const bool inside = x >= 50 && x < 70 && y >= 10 && y < 20;
            for (int c = 0; c < 3; ++c) {
                float expected = 1;
                if (inside) {
                    expected = image.pixels.at(x - 50, y - 10, c);
                    expected = expected > 0 ? std::min(expected, 1.0F) : 0;
                }
                const float value = color::srgb_encode(picture.image().at(x, y, c));
                ASSERT_NEAR(value, expected, 0.51 / 255) << x << ' ' << y << ' ' << c;
            }
        }
    }
    // At any other scale the edges stay as they are.
    write_drawing(folder.file("large.png"), drawing, 750);
    const Picture large = read_picture(folder.file("large.png"));
    EXPECT_EQ(large.image().at(375, 149, 1), 1);
    EXPECT_EQ(large.image().at(524, 75, 0), 1);
    EXPECT_EQ(large.image().at(376, 76, 0), 0);
}

TEST(WriteDrawing, ImagesAreInEveryFormat) {
    const TemporaryFolder folder;
    Drawing drawing = sheet();
    drawing.items.push_back(DrawingImage{{50, 10}, 20, 10, Image(20, 10, 3)});
    write_drawing(folder.file("image.svg"), drawing);
    write_drawing(folder.file("image.pdf"), drawing);
    const std::string svg = read_bytes(folder.file("image.svg"));
    EXPECT_TRUE(well_formed(svg)) << svg;
    EXPECT_EQ(count(svg, "data:image/png;base64,"), 1U) << svg;
    EXPECT_NE(read_bytes(folder.file("image.pdf")).find("/Subtype /Image"), std::string::npos);
}

TEST(WriteDrawing, PdfIsAPdfWithItsTitle) {
    const TemporaryFolder folder;
    const std::string path = folder.file("sheet.pdf");
    write_drawing(path, sheet());
    const std::string pdf = read_bytes(path);
    EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
    EXPECT_NE(pdf.find("%%EOF"), std::string::npos);
    EXPECT_NE(pdf.find("/Title (1 < 2 & more)"), std::string::npos);
    EXPECT_EQ(pdf.find("CreationDate"), std::string::npos);
    // 100 mm and 50 mm in points of 1/72 inch.
    EXPECT_NE(pdf.find("/MediaBox [ 0 0 283.46"), std::string::npos) << pdf.substr(0, 2000);
}

TEST(WriteDrawing, WhatCannotBeDrawnIsNamedAndLeavesNothing) {
    const TemporaryFolder folder;
    const std::string good = folder.file("good.svg");
    const auto refuse = [&](const std::string& path, const Drawing& drawing, int width,
                            const std::vector<std::string>& words) {
        try {
            write_drawing(path, drawing, width);
            ADD_FAILURE() << "accepted " << path;
        } catch (const InvalidArgument& error) {
            for (const std::string& word : words) {
                EXPECT_THAT(error.what(), testing::HasSubstr(word));
            }
        }
        EXPECT_TRUE(folder.names().empty());
    };
    refuse(folder.file("sheet.gif"), sheet(), 1600, {"sheet.gif", ".svg, .png or .pdf"});
    refuse(folder.file("sheet"), sheet(), 1600, {"sheet", ".svg, .png or .pdf"});
    refuse(folder.file("a.png"), sheet(), 15, {"png_width_px = 15", "[16, 20000]"});
    refuse(folder.file("a.png"), sheet(), 20001, {"png_width_px = 20001", "[16, 20000]"});

    Drawing drawing = sheet();
    drawing.width_mm = 0;
    refuse(good, drawing, 1600, {"width_mm of a drawing = 0"});
    drawing = sheet();
    drawing.height_mm = 2000;
    refuse(folder.file("high.png"), drawing, 1600, {"png_width_px = 1600", "height"});
    drawing = sheet();
    std::get<DrawingArea>(drawing.items[0]).points[2].y_mm = std::nan("");
    refuse(good, drawing, 1600, {"y_mm of a drawing = nan"});
    drawing = sheet();
    std::get<DrawingLine>(drawing.items[1]).points[1].x_mm =
        std::numeric_limits<double>::infinity();
    refuse(good, drawing, 1600, {"x_mm of a drawing = inf"});
    drawing = sheet();
    std::get<DrawingLine>(drawing.items[1]).dash_mm = {0, 0};
    refuse(good, drawing, 1600, {"dash_mm", "= 0"});
    drawing = sheet();
    std::get<DrawingText>(drawing.items[2]).color.opacity = 2;
    refuse(good, drawing, 1600, {"color of a drawing = 2"});
    drawing = sheet();
    drawing.items.push_back(DrawingImage{{0, 0}, 10, 10, Image(2, 2, 1)});
    refuse(good, drawing, 1600, {"channel count of an image of a drawing = 1"});
    std::get<DrawingImage>(drawing.items.back()).pixels = {};
    refuse(good, drawing, 1600, {"width in pixels of an image of a drawing = 0"});
}

TEST(WriteDrawing, BytesThatAreNoTextBecomeQuestionMarks) {
    const TemporaryFolder folder;
    Drawing drawing = sheet();
    drawing.title = "G\xC3\xB6rz \xE2\x80\x93 \xF0\x9F\x94\xAD";
    std::get<DrawingText>(drawing.items[2]).text = drawing.title;
    write_drawing(folder.file("good.svg"), drawing);
    EXPECT_NE(read_bytes(folder.file("good.svg")).find("<title>" + drawing.title + "<"),
              std::string::npos);
    // Latin-1, a cut character, a surrogate, an overlong blank, a control character, U+FFFF.
    drawing.title = "a\xF6z b\xE2\x80 c\xED\xA0\x80 d\xC0\xA0 e\x01 f\xEF\xBF\xBF g\xE2";
    std::get<DrawingText>(drawing.items[2]).text = drawing.title;
    for (const char* name : {"bad.svg", "bad.png", "bad.pdf"}) {
        write_drawing(folder.file(name), drawing);
    }
    const std::string svg = read_bytes(folder.file("bad.svg"));
    EXPECT_TRUE(well_formed(svg));
    EXPECT_NE(svg.find("<title>a?z b?? c??? d?? e? f??? g?<"), std::string::npos) << svg;
}

TEST(WriteDrawing, BadPathsAreFileErrorsAndLeaveWhatWasThere) {
    const TemporaryFolder folder;
    EXPECT_THROW(write_drawing(folder.file("none/a.svg"), sheet()), FileError);
    EXPECT_TRUE(folder.names().empty());

    const std::string path = folder.file("a.svg");
    write_bytes(path, "before");
    Drawing drawing = sheet();
    drawing.width_mm = -1;
    EXPECT_THROW(write_drawing(path, drawing), InvalidArgument);
    EXPECT_EQ(read_bytes(path), "before");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.svg"});
}

TEST(WriteDrawing, IsTheSameBytesEveryTime) {
    const TemporaryFolder folder;
    for (const char* extension : {".svg", ".png", ".pdf"}) {
        write_drawing(folder.file(std::string("a") + extension), sheet());
        write_drawing(folder.file(std::string("b") + extension), sheet());
        EXPECT_EQ(read_bytes(folder.file(std::string("a") + extension)),
                  read_bytes(folder.file(std::string("b") + extension)))
            << extension;
    }
}

}  // namespace
}  // namespace aureole::io
