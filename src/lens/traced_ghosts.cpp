#include "lens/traced_ghosts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "aureole/base/parallel.h"
#include "aureole/lens/trace.h"
#include "lens/ghost_compare.h"
#include "lens/traced_bands.h"
#include "lens/traced_blur.h"
#include "lens/traced_canvas.h"
#include "lens/traced_mask.h"
#include "lens/traced_mesh.h"

namespace aureole::lens {
namespace {

// Memory for meshes that are traced before they are drawn.
std::size_t meshes_at_once(int side) {
    constexpr std::size_t kBytes = std::size_t{96} << 20;
    return std::clamp<std::size_t>(kBytes / TracedMesh::bytes(side), 2, 32);
}

// What is known of one ghost of the current light.
struct GhostNow {
    GhostLight light;
    // Of the light that the above is for; NaN: of none.
    double tan_x = std::numeric_limits<double>::quiet_NaN();
    double tan_y = std::numeric_limits<double>::quiet_NaN();
    int level = 0;
    BlurMoments blur;  // pixels of the level
    bool blurred = false;
    bool in_strata = false;  // bands are cut into strata
};

// One mesh of a batch.
struct Item {
    const GhostDraw* draw = nullptr;
    int band = 0;  // or stratum
};

}  // namespace

struct TracedGhosts::Impl {
    Impl(const Lens& a_lens, const Iris& an_iris, const Film& a_film, const FlareOptions& options,
         std::vector<Bounces> list, const Occluder* occluder)
        : film(a_film),
          side(options.rays_per_side),
          hybrid(options.method == GhostMethod::kHybrid),
          ghosts(std::move(list)),
          bands(a_lens, ghosts, options.wavelengths),
          mask(an_iris, occluder, options.ghost_texture),
          // Canvases reach beyond the picture, coarse levels and blurs the most.
          sensor(picture_on_sensor(a_film, 0.05 * std::max(a_film.width, a_film.height))),
          now(ghosts.size()),
          comparison(a_film, bands) {
        for (int k = 0; k < max_workers(); ++k) {
            probes.emplace_back(bands);
            blur_probes.emplace_back(a_lens, bands.wavelength_nm(bands.middle()));
        }
        for (GhostNow& ghost : now) {
            const auto count = static_cast<std::size_t>(options.wavelengths);
            ghost.light.weights.resize(count);
            ghost.light.strata_weights.resize(count * TracedBands::kStrata);
        }
        const std::size_t at_once = meshes_at_once(options.rays_per_side);
        for (std::size_t k = 0; k < at_once; ++k) {
            meshes.emplace_back(options.rays_per_side);
            steps.push_back(bands.scratch());
        }
        paints.reserve(at_once);
        items.reserve(at_once);
    }

    // Where rays of a ghost enter, unless that is known from the same light already.
    void prepare(const sources::Light& light, int index, int worker);
    // How it is drawn.
    void arrange(const sources::Light& light, const GhostDraw& draw, const Canvas& canvas,
                 int worker);
    void arrange_blur(const sources::Light& light, int index, const Canvas& canvas, int worker);
    MeshJob job_for(const sources::Light& light, const Item& item, const Canvas& canvas,
                    std::vector<RayStep>& scratch) const;
    MeshPaint paint_for(const sources::Light& light, std::size_t item) const;
    GhostNow& of(const GhostDraw& draw) { return now[static_cast<std::size_t>(draw.ghost)]; }
    const GhostNow& of(const GhostDraw& draw) const {
        return now[static_cast<std::size_t>(draw.ghost)];
    }

    Film film;
    int side;
    bool hybrid;
    std::vector<Bounces> ghosts;
    TracedBands bands;
    TracedMask mask;
    PlaneBox sensor;  // what the picture shows

    std::vector<GhostNow> now;
    std::vector<TracedBands::Probe> probes;  // by worker
    std::vector<BlurProbe> blur_probes;      // by worker
    std::vector<TracedMesh> meshes;
    std::vector<std::vector<RayStep>> steps;  // by mesh
    std::vector<Item> items;                  // by mesh
    std::vector<MeshPaint> paints;
    BlurKernel kernel;
    std::optional<TracedCanvas> tiles;
    GhostCompare comparison;
    std::size_t rays = 0;
};

void TracedGhosts::Impl::prepare(const sources::Light& light, int index, int worker) {
    GhostNow& ghost = now[static_cast<std::size_t>(index)];
    if (ghost.tan_x == light.tan_x && ghost.tan_y == light.tan_y) return;
    bands.prepare(index, RayDirection(light), sensor, mask,
                  probes[static_cast<std::size_t>(worker)], ghost.light);
    ghost.tan_x = light.tan_x;
    ghost.tan_y = light.tan_y;
}

void TracedGhosts::Impl::arrange(const sources::Light& light, const GhostDraw& draw,
                                 const Canvas& canvas, int worker) {
    GhostNow& ghost = of(draw);
    ghost.level = std::clamp(draw.level, 0, canvas.levels() - 1);
    ghost.blurred = false;
    if (ghost.light.found.entrance.empty()) return;
    if (light.moment_xx > 0 || light.moment_yy > 0) arrange_blur(light, draw.ghost, canvas, worker);
    // Below that, a blur or coarse pixels hide the bands.
    constexpr double kOutlinesPx = 3;
    const double apart_px = ghost.light.dispersion_mm / (film.mm_per_px * (1 << ghost.level));
    const double hidden_px = ghost.blurred ? BlurKernel::reach(ghost.blur) : 0;
    ghost.in_strata = apart_px > kOutlinesPx + hidden_px;
}

void TracedGhosts::Impl::arrange_blur(const sources::Light& light, int index, const Canvas& canvas,
                                      int worker) {
    GhostNow& ghost = now[static_cast<std::size_t>(index)];
    const PlaneBox& entrance = ghost.light.found.entrance;
    ghost.blur = blur_probes[static_cast<std::size_t>(worker)].moments(
        ghosts[static_cast<std::size_t>(index)], light, 0.5 * (entrance.x0 + entrance.x1),
        0.5 * (entrance.y0 + entrance.y1));
    const auto scale = [&](double by) {
        ghost.blur.xx *= by;
        ghost.blur.xy *= by;
        ghost.blur.yy *= by;
    };
    scale(std::pow(film.mm_per_px * (1 << ghost.level), -2));
    // The picture has the sensor's x turned, and its y not.
    ghost.blur.xy = -ghost.blur.xy;
    // A blur of many pixels is drawn where pixels are large.
    constexpr double kFine = 8;
    double reach = BlurKernel::reach(ghost.blur);
    while (reach > kFine && ghost.level + 1 < canvas.levels()) {
        ++ghost.level;
        scale(0.25);
        reach *= 0.5;
    }
    if (!(reach >= 1)) return;
    constexpr double kMost = BlurKernel::kMaxRadius - 1;
    if (reach > kMost) scale(kMost * kMost / (reach * reach));
    ghost.blurred = true;
}

MeshJob TracedGhosts::Impl::job_for(const sources::Light& light, const Item& item,
                                    const Canvas& canvas, std::vector<RayStep>& scratch) const {
    const GhostNow& ghost = of(*item.draw);
    const CanvasLevel& level = canvas.level(ghost.level);
    const int index = item.draw->ghost;
    // As many rays in all strata as otherwise in the band.
    constexpr double kShare = 0.577;  // 1 / sqrt(kStrata)
    static_assert(TracedBands::kStrata == 3);
    MeshJob job{.side = ghost.in_strata ? std::max(8, static_cast<int>(side * kShare)) : side,
                .way = ghost.in_strata ? bands.way_of_stratum(index, item.band, scratch)
                                       : bands.way(index, item.band, scratch),
                .sensor_distance_mm = bands.sensor_distance_mm(),
                .direction = RayDirection(light),
                .box = ghost.light.found.entrance,
                .iris = mask.field(),
                .inner_radius = mask.inner_radius(),
                .outer_radius = mask.outer_radius(),
                .all_masked = mask.mesh_mask().extra != nullptr,
                .film = &film,
                .level = ghost.level};
    const double reach = ghost.blurred ? std::ceil(BlurKernel::reach(ghost.blur) + 0.5) : 0;
    const auto edge = static_cast<float>(level.margin + reach);
    job.x0 = -edge;
    job.y0 = -edge;
    job.x1 = static_cast<float>(level.width) + edge;
    job.y1 = static_cast<float>(level.height) + edge;
    const double px_mm = film.mm_per_px * (1 << ghost.level);
    job.power_per_mm2 =
        light.solid_angle_sr * job.direction.z / (film.irradiance_per_radiance * px_mm * px_mm);
    return job;
}

MeshPaint TracedGhosts::Impl::paint_for(const sources::Light& light, std::size_t item) const {
    const GhostDraw& draw = *items[item].draw;
    const GhostNow& ghost = of(draw);
    MeshPaint paint;
    paint.mesh = &meshes[item];
    paint.level = ghost.level;
    const auto& weights = ghost.in_strata ? ghost.light.strata_weights : ghost.light.weights;
    const auto& weight = weights[static_cast<std::size_t>(items[item].band)];
    for (std::size_t c = 0; c < 3; ++c) {
        paint.weight[c] = weight[c] * light.radiance[c] * draw.gain[c];
    }
    return paint;
}

TracedGhosts::TracedGhosts(const Lens& lens, const Iris& iris, const Film& film,
                           const FlareOptions& options, std::vector<Bounces> ghosts,
                           const Occluder* occluder)
    : impl_(std::make_unique<Impl>(lens, iris, film, options, std::move(ghosts), occluder)) {}
TracedGhosts::~TracedGhosts() = default;
TracedGhosts::TracedGhosts(TracedGhosts&&) noexcept = default;

void TracedGhosts::draw(const sources::Light& light, std::span<const GhostDraw> ghosts,
                        Canvas& canvas, const ProgressPart& progress) {
    Impl& m = *impl_;
    if (!m.tiles) m.tiles.emplace(canvas);
    m.rays = 0;
    parallel_for(ghosts.size(), [&](std::size_t g, int worker) {
        m.prepare(light, ghosts[g].ghost, worker);
        m.arrange(light, ghosts[g], canvas, worker);
    });
    for (TracedBands::Probe& probe : m.probes) m.rays += probe.take_rays();

    // In batches: trace, then draw.
    std::size_t next = 0;
    int band = 0;
    while (next < ghosts.size()) {
        progress.reach(static_cast<double>(next) / static_cast<double>(ghosts.size()));
        m.items.clear();
        while (next < ghosts.size() && m.items.size() < m.meshes.size()) {
            const GhostNow& ghost = m.of(ghosts[next]);
            const int bands =
                ghost.in_strata ? m.bands.count() * TracedBands::kStrata : m.bands.count();
            if (ghost.light.found.entrance.empty() || band == bands) {
                ++next;
                band = 0;
                continue;
            }
            m.items.push_back({&ghosts[next], band++});
        }
        parallel_for(m.items.size(), [&](std::size_t k, int) {
            m.meshes[k].build(m.job_for(light, m.items[k], canvas, m.steps[k]));
        });
        m.paints.clear();
        for (std::size_t k = 0; k < m.items.size(); ++k) {
            m.rays += m.meshes[k].rays();
            if (!m.of(*m.items[k].draw).blurred) m.paints.push_back(m.paint_for(light, k));
        }
        m.tiles->draw(m.paints, m.mask.mesh_mask(), canvas);
        for (std::size_t k = 0; k < m.items.size();) {
            const GhostDraw* draw = m.items[k].draw;
            m.paints.clear();
            for (; k < m.items.size() && m.items[k].draw == draw; ++k) {
                m.paints.push_back(m.paint_for(light, k));
            }
            if (!m.of(*draw).blurred) continue;
            m.kernel.set(m.of(*draw).blur);
            m.tiles->draw_blurred(m.paints, m.mask.mesh_mask(), m.kernel, canvas);
        }
    }
}

void TracedGhosts::compare(const sources::Light& light, std::span<const MatrixGhost> placements,
                           std::span<GhostComparison> comparisons) {
    Impl& m = *impl_;
    parallel_for(m.ghosts.size(), [&](std::size_t g, int worker) {
        const int index = static_cast<int>(g);
        m.prepare(light, index, worker);
        comparisons[g] = m.comparison.compare(index, light, m.bands, m.now[g].light, m.mask,
                                              m.hybrid ? &placements[g] : nullptr, worker);
    });
}

std::size_t TracedGhosts::rays() const noexcept { return impl_->rays; }

}  // namespace aureole::lens
