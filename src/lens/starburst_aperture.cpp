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
    constexpr int kPoints = 16384;
    std::vector<wave::Point> points(kPoints);
    parallel_for(points.size(), [&](std::size_t i, int) {
        const double angle = 2 * kPi * static_cast<double>(i) / kPoints;
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        double inside = 0.99 * iris.inner_radius();
        double outside = 1.01 * iris.outer_radius();
        for (int step = 0; step < 22; ++step) {
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
// leaves .1 %. Boxes at whole samples are drawn once and shared by neighbours.
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

// The same window over something that can only be asked for its value at a point. Two points along
// each axis have its second moment, and its transform to 2 % within the used part of the band; few
// samples, which leave much between them, take the window itself.
struct Tap {
    double offset = 0;  // in samples
    double weight = 0;
};
std::vector<Tap> window_taps(double samples_across) {
    constexpr double kFew = 512;
    if (samples_across > kFew) return {{-0.456, 0.5}, {0.456, 0.5}};
    constexpr int kTaps = 16;
    std::vector<Tap> taps;
    for (int i = 0; i < kTaps; ++i) {
        const double x = 2 * (i + 0.5) / kTaps - 1;
        // (1/4, 1/2, 1/4) boxes around -1/2, 0 and 1/2: steps, 1/4 outside and 3/4 inside.
        taps.push_back({x, (std::abs(x) < 0.5 ? 0.75 : 0.25) * 2 / kTaps});
    }
    return taps;
}

// Multiplies each sample that is not 0 by the mean of value(x_mm, y_mm, footprint_mm).
template <class Value>
void multiply_smoothly(wave::Mask& mask, double opening_mm, const Value& value) {
    const double spacing = mask.grid.spacing_mm();
    const std::vector<Tap> taps = window_taps(opening_mm / spacing);
    const auto footprint = static_cast<float>((taps.size() > 2 ? 0.125 : 0.5) * spacing);
    parallel_for(static_cast<std::size_t>(mask.grid.samples), [&](std::size_t j, int) {
        float* row = mask.row(static_cast<int>(j));
        const double y = mask.grid.y_mm(static_cast<int>(j));
        for (int i = 0; i < mask.grid.samples; ++i) {
            if (row[i] == 0) continue;
            const double x = mask.grid.x_mm(i);
            double mean = 0;
            for (const Tap& v : taps) {
                for (const Tap& u : taps) {
                    mean += u.weight * v.weight *
                            static_cast<double>(value(static_cast<float>(x + u.offset * spacing),
                                                      static_cast<float>(y + v.offset * spacing),
                                                      footprint));
                }
            }
            row[i] *= static_cast<float>(mean);
        }
    });
}

// 1 wherever a square of twice `half_side_mm` has samples.
void fill_square(wave::Mask& mask, double half_side_mm) {
    const wave::ApertureGrid& grid = mask.grid;
    const int reach = static_cast<int>(std::ceil(half_side_mm / grid.spacing_mm())) + 1;
    const int first = std::max(0, grid.samples / 2 - reach);
    const int count = std::min(grid.samples, grid.samples / 2 + reach + 1) - first;
    for (int j = first; j < first + count; ++j) std::fill_n(mask.row(j) + first, count, 1.0F);
}

}  // namespace

wave::Shape outline_of(const Iris& iris, double radius_mm) {
    const IrisShape& shape = iris.shape();
    if (shape.blades == 0) return wave::disc(radius_mm);
    if (shape.smoothing > 0) return traced_outline(iris, radius_mm);
    return wave::regular_polygon(shape.blades, radius_mm * iris.outer_radius(), shape.rotation_deg,
                                 shape.curvature);
}

RasterPlan plan_raster(const Iris& iris, double pupil_diameter_mm, int samples,
                       const wave::KernelGrid& kernel) {
    // Beyond a quarter of its width the raster holds more and more of what was folded back into it.
    constexpr double kUsedShare = 0.26;
    // Fringes are lag by lag of the opening: 2 keeps all, but a pixel much larger than
    // lambda / opening sees none of the long ones.
    constexpr double kLeastWidth = 1.25;
    // A sample is read as evenly bright.
    constexpr double kSamplesPerPixel = 5;
    // lambda / opening from the axis, where the core has handed over and the law may.
    constexpr double kLeastEnd = 46;
    // A wider raster would only cost time: whatever there is has settled to its law.
    constexpr double kWidestPx = 400;

    const double opening_mm = pupil_diameter_mm * iris.outer_radius();
    const double sample_per_pixel_mm = kGreenMm * kernel.view().focal_length_px();
    const double used = kUsedShare * samples;
    const double extent_mm =
        std::max(kLeastWidth * opening_mm,
                 std::min(kSamplesPerPixel * sample_per_pixel_mm, used / kLeastEnd * opening_mm));
    const double widest =
        std::max(kWidestPx * extent_mm / sample_per_pixel_mm, kLeastEnd * extent_mm / opening_mm);
    return {{samples, extent_mm}, std::min(used, widest)};
}

StarburstAperture draw_aperture(const Iris& iris, double pupil_diameter_mm,
                                const wave::ApertureGrid& grid, const Obstacles& obstacles) {
    const double radius_mm = pupil_diameter_mm / 2;
    const double opening_mm = pupil_diameter_mm * iris.outer_radius();
    wave::Mask mask(grid);
    if (iris.is_image()) {
        fill_square(mask, opening_mm / 2);
        const auto unit = static_cast<float>(1 / radius_mm);
        multiply_smoothly(mask, opening_mm, [&](float x, float y, float footprint) {
            return iris.image_transmission(x * unit, y * unit, footprint * unit);
        });
    } else {
        draw_smoothly(
            obstacles.outline != nullptr ? *obstacles.outline : outline_of(iris, radius_mm), mask);
    }
    if (obstacles.occluder != nullptr) {
        multiply_smoothly(mask, opening_mm, [&](float x, float y, float footprint) {
            return obstacles.occluder->transmission(x, y, footprint);
        });
    }
    std::vector<float> gain(static_cast<std::size_t>(grid.samples) / 2 + 1, 1.0F);
    for (std::size_t k = 1; k < gain.size(); ++k) {
        const double x = kPi * static_cast<double>(k) / grid.samples;
        const double kept = std::sin(x) / x * std::pow(std::cos(x / 2), 2);
        gain[k] = static_cast<float>(1 / (kept * kept));
    }
    return {wave::field_from(mask), std::move(gain)};
}

}  // namespace aureole::lens
