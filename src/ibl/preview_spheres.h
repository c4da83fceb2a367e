// The raster of a preview: where spheres are in their cells, and the sums over samples of a pixel.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/progress.h"
#include "aureole/ibl/cube_sampler.h"
#include "aureole/ibl/preview.h"

namespace aureole::ibl {

using PreviewRgb = std::array<double, 3>;

// From the surface to the camera.
inline constexpr Direction kPreviewView = {0, 0, 1};

int preview_cell_px(const PreviewOptions& options);

// Places in a cell in units of the sphere's radius, from its middle: x to the right, y up.
struct CellPlace {
    double x = 0;
    double y = 0;
    bool on_sphere() const { return x * x + y * y < 1; }
    Direction normal() const { return {x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y))}; }
};
CellPlace cell_place(const PreviewOptions& options, double x_px, double y_px);

// The mirror image of the view about a normal.
Direction preview_reflection(const Direction& normal);

// What is seen beside a sphere.
class PreviewBackdrop {
  public:
    PreviewBackdrop(const PreviewOptions& options, const CubeSampler& environment,
                    double exposure_scale);
    PreviewRgb at(const CellPlace& place) const noexcept;

  private:
    const CubeSampler* environment_ = nullptr;  // null: grey
    double grey_ = 0;
    double half_cell_ = 1;
};

// Throws InvalidArgument.
void check_preview(const PreviewOptions& options);
void check_preview(const PreviewChain& chain);

// As PreviewSheet::exposure_scale says; 1 in the dark.
double preview_exposure_scale(const CubeMap& environment);

// A sheet without pixels of rows, `labels` of them for each material.
PreviewSheet make_preview_sheet(const PreviewOptions& options,
                                const std::vector<std::string>& labels, double exposure_scale);

// difference of row `row` against row `reference`.
std::vector<double> preview_difference(const PreviewSheet& sheet, const PreviewOptions& options,
                                       int row, int reference);

// Fills the first `painted` of every `rows_per_material` rows. Calls
// shade(column, normal, sample, pixel, sums) for each sample on a sphere, which adds the radiance
// of material m in painted row r to sums[m * painted + r]; sample counts those of a pixel, and
// pixel those of a column's cell. Throws Cancelled.
template <class Shade>
void paint_spheres(PreviewSheet& sheet, const PreviewOptions& options,
                   const PreviewBackdrop& backdrop, int rows_per_material, int painted,
                   const Shade& shade, Progress* progress) {
    const int cell = sheet.cell_px;
    const int side = options.samples_per_side;
    const auto shaded = options.materials.size() * static_cast<std::size_t>(painted);
    std::vector<std::vector<PreviewRgb>> scratch(static_cast<std::size_t>(max_workers()),
                                                 std::vector<PreviewRgb>(shaded));
    const auto paint_pixel = [&](std::size_t column, int x, int y, std::vector<PreviewRgb>& sums) {
        std::fill(sums.begin(), sums.end(), PreviewRgb{});
        for (int sample = 0; sample < side * side; ++sample) {
            const int row = sample / side;
            const CellPlace place =
                cell_place(options, x + (sample % side + 0.5) / side, y + (row + 0.5) / side);
            if (place.on_sphere()) {
                shade(column, place.normal(), sample, static_cast<std::uint32_t>(y * cell + x),
                      sums.data());
            } else {
                const PreviewRgb behind = backdrop.at(place);
                for (PreviewRgb& sum : sums) {
                    for (std::size_t c = 0; c < 3; ++c) sum[c] += behind[c];
                }
            }
        }
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const int index = static_cast<int>(i);
            const int row = index / painted * rows_per_material + index % painted;
            for (int c = 0; c < 3; ++c) {
                sheet.pixels.at(static_cast<int>(column) * cell + x, row * cell + y, c) =
                    static_cast<float>(sums[i][static_cast<std::size_t>(c)] / (side * side));
            }
        }
    };
    const auto columns = options.roughness.size();
    const auto lines = columns * static_cast<std::size_t>(cell);  // of one cell each
    const std::size_t lines_at_once = 8 * columns;
    for (std::size_t first = 0; first < lines; first += lines_at_once) {
        if (progress != nullptr && progress->cancelled()) throw Cancelled();
        const std::size_t count = std::min(lines_at_once, lines - first);
        parallel_for(count, [&](std::size_t index, int worker) {
            const std::size_t column = (first + index) % columns;
            const int y = static_cast<int>((first + index) / columns);
            for (int x = 0; x < cell; ++x) {
                paint_pixel(column, x, y, scratch[static_cast<std::size_t>(worker)]);
            }
        });
        if (progress != nullptr) {
            progress->report("preview",
                             static_cast<double>(first + count) / static_cast<double>(lines));
        }
    }
}

}  // namespace aureole::ibl
