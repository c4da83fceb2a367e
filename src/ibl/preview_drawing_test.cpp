#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "aureole/base/error.h"
#include "ibl/preview_test_support.h"

namespace aureole::ibl {
namespace {

TEST(PreviewDrawing, HoldsTheSheetPixelByPixelAndItsLabels) {
    const CubeChain chain = unfiltered(8, 2, white);
    const PreviewChain named = {"exact", &chain, {0, 1}};
    PreviewOptions options = small_preview();
    options.roughness = {0, 0.25, 1};
    const PreviewSheet sheet =
        filter_preview(named, named, preview_table(), white_irradiance(), options);
    const Drawing drawing = preview_drawing(sheet, sheet.pixels);
    const double pixels_per_mm = preview_drawing_width_px(sheet) / drawing.width_mm;
    int images = 0;
    std::vector<std::string> words;
    for (const auto& item : drawing.items) {
        if (const auto* image = std::get_if<DrawingImage>(&item)) {
            ++images;
            EXPECT_NEAR(image->width_mm * pixels_per_mm, sheet.pixels.width(), 1e-9);
            EXPECT_NEAR(image->height_mm * pixels_per_mm, sheet.pixels.height(), 1e-9);
            const double x_px = image->corner.x_mm * pixels_per_mm;
            const double y_px = image->corner.y_mm * pixels_per_mm;
            EXPECT_NEAR(x_px, std::round(x_px), 1e-9);
            EXPECT_NEAR(y_px, std::round(y_px), 1e-9);
            EXPECT_LT(image->corner.x_mm + image->width_mm, drawing.width_mm);
            EXPECT_LT(image->corner.y_mm + image->height_mm, drawing.height_mm);
        }
        if (const auto* label = std::get_if<DrawingText>(&item)) words.push_back(label->text);
    }
    EXPECT_EQ(images, 1);
    for (const char* wanted :
         {"roughness 0.25", "gold: exact", "plastic: difference x 10", "0.00 %"}) {
        EXPECT_NE(std::find(words.begin(), words.end(), wanted), words.end()) << wanted;
    }
    EXPECT_THROW(preview_drawing(sheet, Image(8, 8, 3)), InvalidArgument);
    EXPECT_THROW(preview_drawing(sheet, Image(sheet.pixels.width(), sheet.pixels.height(), 1)),
                 InvalidArgument);
}

}  // namespace
}  // namespace aureole::ibl
