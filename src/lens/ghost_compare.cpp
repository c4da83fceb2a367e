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
            // Apertures are large against a bin: if its corners agree, all of it does.
            const auto [low, high] =
                std::minmax({at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
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
    : probe(bands),
      steps(bands.scratch()),
      sums((kBins + 2) * (kBins + 2)),
      coverage(kBins * kBins),
      difference(3 * kBins * kBins) {
    ghost.weights.resize(kBands);
    ghost.strata_weights.resize(kBands * TracedBands::kStrata);
}

GhostCompare::GhostCompare(const Lens& lens, const Film& film, std::span<const Bounces> ghosts)
    : film_(film), bands_(lens, ghosts, kBands) {
    for (int k = 0; k < max_workers(); ++k) work_.emplace_back(bands_);
}

GhostComparison GhostCompare::comparison_of(int ghost, const sources::Light& light,
                                            const TracedMask& mask, const MatrixGhost& placement,
                                            Work& work) const {
    const Iris& iris = mask.iris();
    const RayDirection direction(light);
    bands_.prepare(ghost, direction, picture_on_sensor(film_, 0), mask, work.probe, work.ghost);
    const EntranceFound& found = work.ghost.found;
    const bool linear = placement.u_per_px != 0 && placement.v_per_px != 0;
    const bool traced = !found.entrance.empty();
    if (!traced && !linear) return {};

    // Around both, in pixels; the sensor's x runs against the picture's.
    PlaneBox box;
    if (traced) {
        box = {film_.px(found.sensor.x1), film_.px(found.sensor.x0), film_.py(found.sensor.y0),
               film_.py(found.sensor.y1)};
    }
    if (linear) {
        const double reach_x = iris.outer_radius() / std::abs(placement.u_per_px) + 1;
        const double reach_y = iris.outer_radius() / std::abs(placement.v_per_px) + 1;
        const PlaneBox placed = {placement.center_x - reach_x, placement.center_x + reach_x,
                                 placement.center_y - reach_y, placement.center_y + reach_y};
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
    std::fill(work.coverage.begin(), work.coverage.end(), 0.0F);
    if (linear) draw_placement(placement, iris, bins, work.coverage.data());

    // The bins as a picture.
    Film film = film_;
    film.width = bins.columns;
    film.height = bins.rows;
    film.axis_x = (film_.axis_x - bins.x0) / bins.size;
    film.axis_y = (film_.axis_y - bins.y0) / bins.size;
    film.mm_per_px = film_.mm_per_px * bins.size;
    MeshJob job{.side = kRays,
                .way = {},
                .sensor_distance_mm = bands_.sensor_distance_mm(),
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
    const auto bin_count = static_cast<std::size_t>(bins.columns * bins.rows);
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < bin_count; ++k) {
            work.difference[c * bin_count + k] = -placement.radiance[c] * work.coverage[k];
        }
    }
    double energy = 0;
    for (int band = 0; traced && band < kBands; ++band) {
        job.way = bands_.way(ghost, band, work.steps);
        work.mesh.build(job);
        std::fill(work.sums.begin(), work.sums.end(), 0.0F);
        work.mesh.draw(mask.mesh_mask(), tile);
        for (std::size_t c = 0; c < 3; ++c) {
            const float weight =
                work.ghost.weights[static_cast<std::size_t>(band)][c] * light.radiance[c];
            float* to = work.difference.data() + c * bin_count;
            for (int j = 0; j < bins.rows; ++j) {
                for (int i = 0; i < bins.columns; ++i) {
                    const float sum = weight * tile.sums[(j + 1) * tile.stride + i + 1];
                    energy += sum;
                    to[j * bins.columns + i] += sum;
                }
            }
        }
    }
    double difference = 0;
    for (std::size_t k = 0; k < 3 * bin_count; ++k) difference += std::abs(work.difference[k]);
    const double area = bins.size * bins.size;
    return {static_cast<float>(std::max(0.0, energy * area)),
            static_cast<float>(difference * area)};
}

void GhostCompare::compare(const sources::Light& light, const TracedMask& mask,
                           std::span<const MatrixGhost> placements,
                           std::span<GhostComparison> comparisons) {
    parallel_for(placements.size(), [&](std::size_t g, int worker) {
        comparisons[g] = comparison_of(static_cast<int>(g), light, mask, placements[g],
                                       work_[static_cast<std::size_t>(worker)]);
    });
}

}  // namespace aureole::lens
