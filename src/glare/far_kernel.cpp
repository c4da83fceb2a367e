#include "glare/far_kernel.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/parallel.h"
#include "aureole/base/smoothstep.h"
#include "glare/raster_error.h"
#include "glare/raster_kernel.h"

namespace aureole::glare {
namespace {

struct Candidate {
    int scale;
    int near_radius;
};
// In rising order of the cost of a sprite.
constexpr Candidate kForSprites[] = {{8, 256}, {4, 256}, {8, 512}, {4, 512}, {2, 256}, {2, 512}};
// For transforms, to which all of these cost about the same. The first does for the eye.
constexpr int kNearRadii[] = {256, 512, 128, 64};
// Unless far is that much larger, there is little to save.
constexpr int kLeastRatio = 2;

double far_share(double distance, int near_radius) {
    return smoothstep(0.5 * near_radius, near_radius, distance);
}

Image far_image(const ConstImageView& kernel, int near_radius) {
    Image far(kernel.width, kernel.height, kernel.channels);
    parallel_for(static_cast<std::size_t>(kernel.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < kernel.width; ++x) {
            const double share =
                far_share(std::hypot(x - kernel.width / 2, y - kernel.height / 2), near_radius);
            for (int c = 0; c < kernel.channels; ++c) {
                far.at(x, y, c) =
                    static_cast<float>(share * static_cast<double>(kernel.at(x, y, c)));
            }
        }
    });
    return far;
}

Image near_image(const ConstImageView& kernel, int near_radius) {
    const int side = 2 * near_radius + 1;
    Image near(side, side, kernel.channels);
    for (int c = 0; c < kernel.channels; ++c) {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const int u = kernel.width / 2 + x - near_radius;
                const int v = kernel.height / 2 + y - near_radius;
                if (u < 0 || v < 0 || u >= kernel.width || v >= kernel.height) continue;
                const double share =
                    1 - far_share(std::hypot(x - near_radius, y - near_radius), near_radius);
                near.at(x, y, c) =
                    static_cast<float>(share * static_cast<double>(kernel.at(u, v, c)));
            }
        }
    }
    return near;
}

// If its error is small enough, and far large enough.
std::optional<FarKernel> split_at(const ConstImageView& kernel, const Candidate& candidate,
                                  double most_error) {
    const int radius = std::min(kernel.width, kernel.height) / 2;
    if (radius < kLeastRatio * candidate.near_radius) return std::nullopt;
    const Image far = far_image(kernel, candidate.near_radius);
    FarKernel split;
    split.coarse = raster_kernel(far, candidate.scale);
    split.error = raster_error(far, split.coarse, candidate.scale, most_error);
    if (split.error > most_error) return std::nullopt;
    split.scale = candidate.scale;
    split.near_radius = candidate.near_radius;
    split.near = near_image(kernel, candidate.near_radius);
    split.roughness = sources::roughness_of(far);
    return split;
}

}  // namespace

std::optional<FarKernel> find_far_kernel(const ConstImageView& kernel, double most_error) {
    for (const Candidate& candidate : kForSprites) {
        if (auto split = split_at(kernel, candidate, most_error)) return split;
    }
    return std::nullopt;
}

std::optional<FarKernel> find_far_kernel(const ConstImageView& kernel, int scale,
                                         double most_error) {
    for (const int near_radius : kNearRadii) {
        if (auto split = split_at(kernel, {scale, near_radius}, most_error)) return split;
    }
    return std::nullopt;
}

}  // namespace aureole::glare
