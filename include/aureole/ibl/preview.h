// Pictures of what a filtered environment is for: rows of spheres, from smooth to rough, lit by it.
//
// Each sphere is seen orthographically by a camera that looks along -Z, with +X to the right and +Y
// up: the middle of a mirror shows what lies at +Z, behind the camera, and its rim what lies at -Z.
// docs/environment_previews.md shows both sheets and derives the formulas.
//
//     ibl::PreviewChain exact = {"exact", &exact_levels, roughness};
//     ibl::PreviewChain gather = {"gather", &levels, roughness};
//     ibl::PreviewSheet sheet = ibl::filter_preview(exact, gather, table, irradiance);
//     Image display = copy(sheet.pixels);     // to be tone-mapped at sheet.exposure_scale
//     io::write_drawing("preview.png", ibl::preview_drawing(sheet, display), width);
#pragma once

#include <string>
#include <vector>

#include "aureole/base/progress.h"
#include "aureole/color/rgb.h"
#include "aureole/ibl/brdf_table.h"
#include "aureole/ibl/cube_map.h"
#include "aureole/image/drawing.h"
#include "aureole/image/image.h"

namespace aureole::ibl {

struct PreviewMaterial {
    std::string name;
    // Reflectance seen along the normal, in [0, 1]; 0.04 is common plastic or glass (index 1.5).
    color::Rgb f0 = {0.04, 0.04, 0.04};
    // Of the matt layer below, in [0, 1]; 0 for metals.
    color::Rgb albedo = {0, 0, 0};
};

// Hoffman 2010, "Physically-Based Shading Models in Film and Game Production", table 1: gold.
PreviewMaterial preview_gold();
// f0 = 0.04 over a grey matt layer of albedo 0.5.
PreviewMaterial preview_plastic();

enum class PreviewBackground {
    kGrey,         // neutral and dark: 0.05 / exposure_scale
    kEnvironment,  // as a camera with a field of 60 deg sees it behind each sphere
};

struct PreviewOptions {
    std::vector<double> roughness = {0, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1};  // perceptual, per column
    std::vector<PreviewMaterial> materials = {preview_gold(), preview_plastic()};
    int sphere_px = 128;          // diameter, in [8, 1024]; a cell is 3/16 wider
    int samples_per_side = 4;     // samples per pixel: their square, a grid; in [1, 16]
    double difference_gain = 10;  // > 0
    // dominant_direction_preview(): samples of the full integral per pixel, in [2, 1048576].
    int integral_samples = 1024;
    PreviewBackground background = PreviewBackground::kGrey;
};

// A prefiltered environment; levels must outlive the call.
struct PreviewChain {
    std::string name;  // for labels
    const CubeChain* levels = nullptr;
    std::vector<double> roughness;  // of each level, never falling; the first must be 0
};

struct PreviewRow {
    std::string label;
    // For each column, of this row (of a row of differences: of the row above it) against the
    // reference: mean absolute difference over the sphere's pixels and channels, relative to the
    // reference's mean. Empty for the reference.
    std::vector<double> difference;
};

struct PreviewSheet {
    Image pixels;     // linear RGB radiance, rows.size() x columns.size() square cells
    int cell_px = 0;  // side of a cell
    std::vector<std::string> columns;
    std::vector<PreviewRow> rows;  // from the top
    // One over the mean luminance of the environment: a photographer's exposure, at which a matt
    // grey ball of albedo 0.18 shows 0.18 in the mean.
    double exposure_scale = 1;
};

// What a filter does wrong. Three rows per material: shaded with `reference` (the exact filter,
// say), with `method`, and the difference of the two, its absolute value times
// options.difference_gain. All else is the same in both: the split sum with N = V = R, with the
// energy of multiple scattering (Turquin 2019) and the matt layer below,
//
//     L = P(R) s + albedo (irradiance / pi) (1 - s),   s = (f0 A + B) (1 + f0 (1 / (A + B) - 1)),
//
// A and B, scale and bias of the table, which may be kGgx or kMultiscatter; a white surface, f0 or
// albedo 1, therefore vanishes in white light. `irradiance` is as from irradiance_map().
// Throws InvalidArgument for options out of range, chains that are empty or do not match their
// roughness, and tables of kCloth.
PreviewSheet filter_preview(const PreviewChain& reference, const PreviewChain& method,
                            const BrdfTable& table, const CubeMap& irradiance,
                            const PreviewOptions& options = {});

// What the split sum does wrong, and what the dominant direction mends of it. Three rows per
// material: the split sum looked up along R; along the dominant direction; and the whole integral
// over the environment, level 0 of the chain. Light that is scattered more than once is in none of
// them: L = P (f0 A + B) + albedo (irradiance / pi) (1 - f0 A - B). The table is looked up with N.V
// in both. Takes some seconds for the default options. Throws as above, and Cancelled when
// `progress` asks to stop.
PreviewSheet dominant_direction_preview(const PreviewChain& chain, const BrdfTable& table,
                                        const CubeMap& irradiance,
                                        const PreviewOptions& options = {},
                                        Progress* progress = nullptr);

// The sheet with its labels on a dark ground, 0.25 mm per pixel; letters grow with the cells.
// `display` is sheet.pixels as a display shows it: sRGB values of 3 channels. Throws
// InvalidArgument for another size.
Drawing preview_drawing(const PreviewSheet& sheet, const Image& display);
// The width in pixels at which a PNG of it shows the sheet pixel by pixel.
int preview_drawing_width_px(const PreviewSheet& sheet);

}  // namespace aureole::ibl
