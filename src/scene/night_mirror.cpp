// The mirrored picture of the street.
#include <cmath>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "scene/night_render.h"
#include "scene/night_road.h"

namespace aureole::scene::night {
namespace {

constexpr int kSamples = 3;
// The picture reaches below the visible one, for reflections that ripples fetch from there.
constexpr double kExtraRows = 0.10;
// Blur across, in columns: about what alpha = 0.2 does at ten metres.
constexpr int kBlurRadius = 5;

}  // namespace

MirrorPicture::MirrorPicture(const Street& street, const std::vector<Object>& objects,
                             const Camera& camera) {
    const View& full = camera.view();
    const double scale = kColumns / static_cast<double>(full.width);
    const double horizon = (camera.horizon_y() - full.axis_y) * scale;
    const double bottom = (full.height - full.axis_y) * scale + kExtraRows * kColumns;
    rows_ = std::max(2, static_cast<int>(std::ceil(bottom - horizon)));
    first_row_ = horizon;
    View view = full;
    view.width = kColumns;
    view.height = rows_;
    view.pitch_deg = deg_from_rad(std::atan(std::tan(rad_from_deg(full.pitch_deg)) / scale));
    view.axis_x = full.axis_x * scale;
    view.axis_y = -horizon;
    axis_column_ = view.axis_x;
    const Camera below(view, camera.position(), kEyePitchDeg);
    const Tiles tiles(objects, below, true);
    // Eye and road are both on the ground side of the mirror: the reflected ray starts where a
    // straight one from the mirrored eye would cross the road.
    std::vector<Vec3> sharp(static_cast<std::size_t>(rows_) * kColumns);
    parallel_for(static_cast<std::size_t>(rows_), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < kColumns; ++x) {
            Vec3 sum;
            IrradianceCache cache;
            for (int i = 0; i < kSamples; ++i) {
                const auto offset = sample_offset(i);
                Ray ray = below.ray(x + offset[0], y + offset[1]);
                ray.direction.y = std::max(-ray.direction.y, 1e-5F);
                ray.origin.y = -ray.origin.y;
                // Skip what lies below the road.
                const float t = -ray.origin.y / ray.direction.y;
                ray.origin = ray.at(std::min(t, kStreetEndZ));
                ray.origin.y = std::max(ray.origin.y, 0.0F);
                sum += look(street, objects, tiles.at(x, y), ray, below.pixel_size() * 2, cache)
                           .radiance;
            }
            sharp[row * kColumns + static_cast<std::size_t>(x)] = sum * (1.0F / kSamples);
        }
    });
    std::vector<Vec3> blurred(sharp.size());
    parallel_for(static_cast<std::size_t>(rows_), [&](std::size_t row, int) {
        for (int x = 0; x < kColumns; ++x) {
            Vec3 sum;
            float weights = 0;
            for (int d = -2 * kBlurRadius; d <= 2 * kBlurRadius; ++d) {
                const int at = std::clamp(x + d, 0, kColumns - 1);
                const float weight = std::exp(-0.5F * square(static_cast<float>(d) / kBlurRadius));
                sum += sharp[row * kColumns + static_cast<std::size_t>(at)] * weight;
                weights += weight;
            }
            blurred[row * kColumns + static_cast<std::size_t>(x)] = sum * (1 / weights);
        }
    });
    for (int which = 0; which < 2; ++which) {
        const std::vector<Vec3>& from = which == 0 ? sharp : blurred;
        std::vector<double>& to = sums_[which];
        to.assign(static_cast<std::size_t>(rows_ + 1) * kColumns * 3, 0.0);
        for (std::size_t y = 0; y < static_cast<std::size_t>(rows_); ++y) {
            const double* above = &to[y * kColumns * 3];
            double* below_row = &to[(y + 1) * kColumns * 3];
            for (std::size_t x = 0; x < kColumns; ++x) {
                const Vec3 v = from[y * kColumns + x];
                below_row[3 * x] = above[3 * x] + double{v.x};
                below_row[3 * x + 1] = above[3 * x + 1] + double{v.y};
                below_row[3 * x + 2] = above[3 * x + 2] + double{v.z};
            }
        }
    }
}

const double* MirrorPicture::sums(int blurred, int row) const {
    return &sums_[blurred][static_cast<std::size_t>(row) * kColumns * 3];
}

Vec3 MirrorPicture::box(float column, float low, float high, float across) const {
    const auto last = static_cast<float>(rows_);
    low = std::clamp(low, 0.0F, last - 1);
    high = std::clamp(high, low + 1, last);
    const float c = std::clamp(column - 0.5F, 0.0F, kColumns - 1.001F);
    const int x = static_cast<int>(c);
    const double fx = static_cast<double>(c) - x;
    double total[3] = {};
    for (int which = 0; which < 2; ++which) {
        const double weight = which == 0 ? 1 - double{across} : double{across};
        if (weight <= 0) continue;
        for (const auto& [edge, sign] : {std::pair{low, -1.0}, std::pair{high, 1.0}}) {
            const int row = std::min(static_cast<int>(edge), rows_ - 1);
            const double fy = static_cast<double>(edge) - row;
            const double* upper = sums(which, row) + 3 * x;
            const double* lower = sums(which, row + 1) + 3 * x;
            for (int i = 0; i < 3; ++i) {
                const double left = upper[i] + fy * (lower[i] - upper[i]);
                const double right = upper[i + 3] + fy * (lower[i + 3] - upper[i + 3]);
                total[i] += sign * weight * (left + fx * (right - left));
            }
        }
    }
    const double inverse = 1 / static_cast<double>(high - low);
    return {static_cast<float>(total[0] * inverse), static_cast<float>(total[1] * inverse),
            static_cast<float>(total[2] * inverse)};
}

Vec3 MirrorPicture::mean(float u, float v, float half_height, float across) const {
    const auto column = static_cast<float>(axis_column_) + u * kColumns;
    const float row = v * kColumns - static_cast<float>(first_row_);
    const float half = half_height * kColumns;
    // Two boxes make a kernel with a peak and a skirt.
    return box(column, row - 0.45F * half - 0.5F, row + 0.45F * half + 0.5F, across) * 0.55F +
           box(column, row - 1.5F * half - 0.5F, row + 1.5F * half + 0.5F, across) * 0.45F;
}

}  // namespace aureole::scene::night
