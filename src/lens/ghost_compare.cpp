#include "lens/ghost_compare.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/parallel.h"

namespace aureole::lens {
namespace {

// A raster over part of the picture.
struct Bins {
    double x0 = 0, y0 = 0;  // pixels of the picture
    double size = 1;
    int columns = 0, rows = 0;
    double last_column = 1, last_row = 1;  // how much of these lies in that part

    double share(int column, int row) const {
        return (column + 1 == columns ? last_column : 1) * (row + 1 == rows ? last_row : 1);
    }
};

// Mean coverage of a placement over each bin.
void draw_placement(const MatrixGhost& ghost, const Iris& iris, const Bins& bins, float* to) {
    constexpr int kSub = 4;
    const auto at = [&](double i, double j) {
        return ghost.coverage(iris, static_cast<float>(bins.x0 + i * bins.size),
                              static_cast<float>(bins.y0 + j * bins.size));
    };
    for (int j = 0; j < bins.rows; ++j) {
        for (int i = 0; i < bins.columns; ++i) {
            // Apertures are large against a bin: if its corners and its middle agree, all does.
            const auto [low, high] = std::minmax(
                {at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1), at(i + 0.5, j + 0.5)});
            float mean = low;
            if (high != low) {
                mean = 0;
                for (int n = 0; n < kSub * kSub; ++n) {
                    mean += at(i + (n % kSub + 0.5) / kSub, j + (n / kSub + 0.5) / kSub);
                }
                mean /= kSub * kSub;
            }
            to[j * bins.columns + i] = mean;
        }
    }
}

}  // namespace

GhostCompare::Work::Work(const TracedBands& bands)
    : steps(bands.scratch()),
      sums((kBins + 2) * (kBins + 2)),
      coverage(kBins * kBins),
      difference(3 * kBins * kBins) {}

GhostCompare::GhostCompare(const Film& film, const TracedBands& bands) : film_(film) {
    for (int k = 0; k < max_workers(); ++k) work_.emplace_back(bands);
}

GhostComparison GhostCompare::compare(int ghost, const sources::Light& light,
                                      const TracedBands& bands, const GhostLight& prepared,
                                      const TracedMask& mask, const MatrixGhost* placement,
                                      int worker) {
    Work& work = work_[static_cast<std::size_t>(worker)];
    const Iris& iris = mask.iris();
    const RayDirection direction(light);
    const EntranceFound& found = prepared.found;
    const bool linear =
        placement != nullptr && placement->u_per_px != 0 && placement->v_per_px != 0;
    const bool traced = !found.entrance.empty();
    if (!traced && !linear) return {};

    // Around both, in pixels; the sensor's x runs against the picture's.
    PlaneBox box;
    if (traced) {
        box = {film_.px(found.sensor.x1), film_.px(found.sensor.x0), film_.py(found.sensor.y0),
               film_.py(found.sensor.y1)};
    }
    if (linear) {
        const double reach_x = iris.outer_radius() / std::abs(placement->u_per_px) + 1;
        const double reach_y = iris.outer_radius() / std::abs(placement->v_per_px) + 1;
        const PlaneBox placed = {placement->center_x - reach_x, placement->center_x + reach_x,
                                 placement->center_y - reach_y, placement->center_y + reach_y};
        box = traced ? box.around(placed) : placed;
    }
    box = {std::max(box.x0, 0.0), std::min(box.x1, static_cast<double>(film_.width)),
           std::max(box.y0, 0.0), std::min(box.y1, static_cast<double>(film_.height))};
    if (box.empty()) return {};
    Bins bins;
    bins.x0 = box.x0;
    bins.y0 = box.y0;
    bins.size = std::max(1.0, std::max(box.x1 - box.x0, box.y1 - box.y0) / kBins);
    const auto count = [&](double size) {
        return std::clamp(static_cast<int>(std::ceil(size / bins.size)), 1, kBins);
    };
    bins.columns = count(box.x1 - box.x0);
    bins.rows = count(box.y1 - box.y0);
    bins.last_column = std::min(1.0, (box.x1 - box.x0) / bins.size - (bins.columns - 1));
    bins.last_row = std::min(1.0, (box.y1 - box.y0) / bins.size - (bins.rows - 1));
    const auto bin_count = static_cast<std::size_t>(bins.columns * bins.rows);
    std::fill(work.difference.begin(), work.difference.end(), 0.0F);
    if (linear) {
        draw_placement(*placement, iris, bins, work.coverage.data());
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t k = 0; k < bin_count; ++k) {
                work.difference[c * bin_count + k] = -placement->radiance[c] * work.coverage[k];
            }
        }
    }

    // The bins as a picture.
    Film film = film_;
    film.width = bins.columns;
    film.height = bins.rows;
    film.axis_x = (film_.axis_x - bins.x0) / bins.size;
    film.axis_y = (film_.axis_y - bins.y0) / bins.size;
    film.mm_per_px = film_.mm_per_px * bins.size;
    MeshJob job{.side = kRays,
                .way = {},
                .sensor_distance_mm = bands.sensor_distance_mm(),
                .direction = direction,
                .box = found.entrance,
                .iris = mask.field(),
                .inner_radius = mask.inner_radius(),
                .outer_radius = mask.outer_radius(),
                .all_masked = mask.mesh_mask().extra != nullptr,
                .film = &film,
                .x1 = static_cast<float>(film.width),
                .y1 = static_cast<float>(film.height),
                .power_per_mm2 = light.solid_angle_sr * direction.z /
                                 (film.irradiance_per_radiance * film.mm_per_px * film.mm_per_px)};
    MeshTile tile{
        .sums = work.sums.data(), .stride = bins.columns + 2, .x1 = bins.columns, .y1 = bins.rows};
    double energy = 0;
    // With many bands, one stands for its neighbours.
    const int each = (bands.count() + kMostBands - 1) / kMostBands;
    for (int first = 0; traced && first < bands.count(); first += each) {
        const int last = std::min(first + each, bands.count());
        job.way = bands.way(ghost, (first + last) / 2, work.steps);
        work.mesh.build(job);
        std::fill(work.sums.begin(), work.sums.end(), 0.0F);
        work.mesh.draw(mask.mesh_mask(), tile);
        for (std::size_t c = 0; c < 3; ++c) {
            float weight = 0;
            for (int band = first; band < last; ++band) {
                weight += prepared.weights[static_cast<std::size_t>(band)][c];
            }
            weight *= light.radiance[c];
            float* to = work.difference.data() + c * bin_count;
            for (int j = 0; j < bins.rows; ++j) {
                for (int i = 0; i < bins.columns; ++i) {
                    const float sum = weight * tile.sums[(j + 1) * tile.stride + i + 1];
                    energy += sum * bins.share(i, j);
                    to[j * bins.columns + i] += sum;
                }
            }
        }
    }
    const double area = bins.size * bins.size;
    GhostComparison result;
    result.energy = static_cast<float>(std::max(0.0, energy * area));
    if (placement == nullptr) return result;
    double difference = 0;
    const float* from = work.difference.data();
    for (int c = 0; c < 3; ++c) {
        for (int j = 0; j < bins.rows; ++j) {
            for (int i = 0; i < bins.columns; ++i) {
                difference += std::abs(*from++) * bins.share(i, j);
            }
        }
    }
    result.difference = static_cast<float>(difference * area);
    return result;
}

}  // namespace aureole::lens
