#include "glare/far_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "aureole/base/parallel.h"
#include "glare/raster_kernel.h"

namespace aureole::glare {
namespace {

struct Candidate {
    int scale;
    int near_radius;
};
// In rising order of the cost of a sprite.
constexpr Candidate kForSprites[] = {{8, 256}, {4, 256}, {8, 512}, {4, 512}, {2, 256}, {2, 512}};
// In rising order of the cost of transforms of the near part.
constexpr int kNearRadii[] = {64, 128, 256, 512};
// Unless far is that much larger, there is little to save.
constexpr int kLeastRatio = 2;
constexpr int kPlacesPerSide = 2;

double far_share(double distance, int near_radius) {
    const double t = std::clamp(2 * distance / near_radius - 1, 0.0, 1.0);
    return t * t * (3 - 2 * t);
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

// One axis of the bilinear kernel on the coarse raster: which coarse displacements stand for the
// fine pixel d away from the pixel of a source that is `phase` fine pixels right of the first of a
// coarse one, and with which weights.
struct Taps {
    int first = 0;
    std::array<double, 3> weight = {};
};

Taps taps_of(int d, int phase, int scale) {
    // Places in coarse pixels, from node 0, whose middle is at fine coordinate scale / 2.
    const double source = (phase + 0.5) / scale - 0.5;
    const double pixel = (phase + d + 0.5) / scale - 0.5;
    const double s0 = std::floor(source);
    const double p0 = std::floor(pixel);
    const double s = source - s0;
    const double p = pixel - p0;
    Taps taps;
    taps.first = static_cast<int>(p0 - s0) - 1;  // node p0 seen from s0 + 1
    taps.weight = {(1 - p) * s, (1 - p) * (1 - s) + p * s, p * (1 - s)};
    return taps;
}

// The sum of |drawn - far| over one channel with the source at one place.
double error_at(const Image& far, const Image& coarse, int c, int scale, int phase_x, int phase_y) {
    const int half_x = far.width() / 2;
    const int half_y = far.height() / 2;
    constexpr int kBorder = 2;  // nodes beyond the raster are 0
    std::vector<Taps> columns(static_cast<std::size_t>(far.width()));
    for (int x = 0; x < far.width(); ++x) {
        Taps& taps = columns[static_cast<std::size_t>(x)];
        taps = taps_of(x - half_x, phase_x, scale);
        taps.first += coarse.width() / 2 + kBorder;
    }
    std::vector<double> rows(static_cast<std::size_t>(far.height()));
    parallel_for(rows.size(), [&](std::size_t row, int) {
        const Taps ty = taps_of(static_cast<int>(row) - half_y, phase_y, scale);
        std::vector<double> nodes(static_cast<std::size_t>(coarse.width() + 2 * kBorder), 0.0);
        for (int j = 0; j < 3; ++j) {
            const int v = ty.first + j + coarse.height() / 2;
            if (v < 0 || v >= coarse.height()) continue;
            const float* from = coarse.row(v, c);
            const double weight = ty.weight[static_cast<std::size_t>(j)];
            for (int u = 0; u < coarse.width(); ++u) {
                nodes[static_cast<std::size_t>(u + kBorder)] +=
                    weight * static_cast<double>(from[u]);
            }
        }
        const float* truth = far.row(static_cast<int>(row), c);
        double sum = 0;
        for (std::size_t x = 0; x < columns.size(); ++x) {
            const Taps& tx = columns[x];
            double drawn = 0;
            for (int i = 0; i < 3; ++i) {
                const int u = tx.first + i;
                if (u < 0 || u >= static_cast<int>(nodes.size())) continue;
                drawn +=
                    tx.weight[static_cast<std::size_t>(i)] * nodes[static_cast<std::size_t>(u)];
            }
            sum += std::abs(drawn - static_cast<double>(truth[x]));
        }
        rows[row] = sum;
    });
    double sum = 0;
    for (const double row : rows) sum += row;
    return sum;
}

double worst_error(const Image& far, const Image& coarse, int scale, double enough) {
    double worst = 0;
    const int step = std::max(1, scale / kPlacesPerSide);
    for (int c = 0; c < far.channels(); ++c) {
        for (int y = 0; y < scale; y += step) {
            for (int x = 0; x < scale; x += step) {
                worst = std::max(worst, error_at(far, coarse, c, scale, x, y));
                if (worst > enough) return worst;
            }
        }
    }
    return worst;
}

// If its error is small enough, and far large enough.
std::optional<FarKernel> split_at(const ConstImageView& kernel, const Candidate& candidate,
                                  double most_error) {
    const int radius = std::min(kernel.width, kernel.height) / 2;
    if (radius < kLeastRatio * candidate.near_radius) return std::nullopt;
    const Image far = far_image(kernel, candidate.near_radius);
    FarKernel split;
    split.coarse = raster_kernel(far, candidate.scale);
    split.error = worst_error(far, split.coarse, candidate.scale, most_error);
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
