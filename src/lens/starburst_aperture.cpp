#include "lens/starburst_aperture.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"

namespace aureole::lens {
namespace {

constexpr double kGreenMm = mm_from_nm(550);

// Around an iris whose corners are rounded: points where rays from the axis meet its edge. Most of
// them lie on straight lines; those on the arcs keep kFlatteningMm for pupils up to 100 mm.
wave::Shape traced_outline(const Iris& iris, double radius_mm) {
    constexpr int kPoints = 8192;
    std::vector<wave::Point> points(kPoints);
    parallel_for(points.size(), [&](std::size_t i, int) {
        const double angle = 2 * kPi * static_cast<double>(i) / kPoints;
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        double inside = 0;
        double outside = 1.1 * iris.outer_radius();
        for (int step = 0; step < 26; ++step) {
            const double middle = 0.5 * (inside + outside);
            const bool open =
                iris.distance(static_cast<float>(middle * c), static_cast<float>(middle * s)) <= 1;
            (open ? inside : outside) = middle;
        }
        points[i] = {inside * c * radius_mm, inside * s * radius_mm};
    });
    return {{std::move(points)}};
}

wave::Shape moved(wave::Shape shape, double x_mm, double y_mm) {
    for (auto& outline : shape.outlines) {
        for (wave::Point& point : outline) {
            point.x_mm += x_mm;
            point.y_mm += y_mm;
        }
    }
    return shape;
}

// Means of the shape under a quadratic window of two samples' width, (1/4, 1/2, 1/4) of boxes half
// a sample apart, in place of the box: what lies beyond the band is folded back into it, and at
// half the band the box leaves 1 % of it, as spikes in directions where there are none. The window
// leaves .05 %. Boxes at whole samples are drawn once and shared by neighbours.
void draw_smoothly(const wave::Shape& shape, wave::Mask& out) {
    const double half = 0.5 * out.grid.spacing_mm();
    const auto n = static_cast<std::size_t>(out.grid.samples);
    wave::Mask boxes(out.grid);
    for (const int phase : {0, 1, 2, 3}) {
        const bool half_x = (phase & 1) != 0;
        const bool half_y = (phase & 2) != 0;
        if (phase > 0) std::fill_n(boxes.values.data(), boxes.values.size(), 0.0F);
        // Sample i of a shape moved by -half is the box around i + 1/2.
        wave::draw(boxes, moved(shape, half_x ? -half : 0, half_y ? -half : 0));
        // Boxes at i - 1/2 and i + 1/2 have a quarter of the weight each, that at i has a half.
        const float weight = 0.25F;
        parallel_for(n, [&](std::size_t j, int) {
            float* to = out.row(static_cast<int>(j));
            for (std::size_t below = 0; below < (half_y && j > 0 ? 2U : 1U); ++below) {
                const float* from = boxes.row(static_cast<int>(j - below));
                const float w = weight * (half_x ? 0.5F : 1.0F) * (half_y ? 0.5F : 1.0F);
                if (!half_x) {
                    for (std::size_t i = 0; i < n; ++i) to[i] += w * from[i];
                } else {
                    to[0] += w * from[0];
                    for (std::size_t i = 1; i < n; ++i) to[i] += w * (from[i] + from[i - 1]);
                }
            }
        });
    }
}

double reach_mm(const Iris& iris, double radius_mm) { return radius_mm * iris.outer_radius(); }

void multiply_occluder(wave::Mask& mask, const Occluder& occluder) {
    const wave::ApertureGrid& grid = mask.grid;
    const auto footprint = static_cast<float>(grid.spacing_mm());
    parallel_for(static_cast<std::size_t>(grid.samples), [&](std::size_t j, int) {
        float* row = mask.row(static_cast<int>(j));
        const auto y = static_cast<float>(grid.y_mm(static_cast<int>(j)));
        for (int i = 0; i < grid.samples; ++i) {
            if (row[i] == 0) continue;
            row[i] *= occluder.transmission(static_cast<float>(grid.x_mm(i)), y, footprint);
        }
    });
}

}  // namespace

wave::Shape outline_of(const Iris& iris, double radius_mm) {
    const IrisShape& shape = iris.shape();
    if (shape.blades == 0) return wave::disc(radius_mm);
    if (shape.smoothing > 0) return traced_outline(iris, radius_mm);
    return wave::regular_polygon(shape.blades, reach_mm(iris, radius_mm), shape.rotation_deg,
                                 shape.curvature);
}

wave::ApertureGrid starburst_grid(const Iris& iris, double pupil_diameter_mm, int samples,
                                  const wave::KernelGrid& kernel) {
    const double opening_mm = pupil_diameter_mm * iris.outer_radius();
    const double pixel_mm = kGreenMm * kernel.view().focal_length_px();  // lambda / pixel
    // At least kSamplesPerPixel across a pixel, since a sample is read as evenly bright; but not so
    // many that the raster ends before the pattern has settled to its law.
    constexpr double kSamplesPerPixel = 5;
    constexpr double kLeastReach = 128;  // samples per lambda / opening at least
    const double fine_mm =
        std::min(kSamplesPerPixel * pixel_mm, samples * opening_mm / kLeastReach);
    constexpr double kWidth = 1.25;
    return {samples, std::max(kWidth * opening_mm, fine_mm)};
}

StarburstAperture draw_aperture(const Iris& iris, double pupil_diameter_mm,
                                const wave::ApertureGrid& grid, const Occluder* occluder) {
    const double radius_mm = pupil_diameter_mm / 2;
    wave::Mask mask(grid);
    std::vector<float> gain(static_cast<std::size_t>(grid.samples) / 2 + 1, 1.0F);
    if (iris.is_image()) {
        // A picture is smooth by itself: between its pixels it is interpolated.
        const double unit = 1 / radius_mm;
        const auto footprint = static_cast<float>(grid.spacing_mm() * unit);
        parallel_for(static_cast<std::size_t>(grid.samples), [&](std::size_t j, int) {
            float* row = mask.row(static_cast<int>(j));
            const auto v = static_cast<float>(grid.y_mm(static_cast<int>(j)) * unit);
            for (int i = 0; i < grid.samples; ++i) {
                row[i] =
                    iris.image_transmission(static_cast<float>(grid.x_mm(i) * unit), v, footprint);
            }
        });
    } else {
        draw_smoothly(outline_of(iris, radius_mm), mask);
        for (std::size_t k = 1; k < gain.size(); ++k) {
            const double x = kPi * static_cast<double>(k) / grid.samples;
            const double kept = std::sin(x) / x * std::pow(std::cos(x / 2), 2);
            gain[k] = static_cast<float>(1 / (kept * kept));
        }
    }
    if (occluder != nullptr) multiply_occluder(mask, *occluder);
    return {wave::field_from(mask), std::move(gain)};
}

}  // namespace aureole::lens
