#include "lens/traced_ghosts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "aureole/base/parallel.h"
#include "aureole/color/spectrum.h"
#include "aureole/lens/trace.h"
#include "lens/ray_grid.h"
#include "lens/traced_blur.h"
#include "lens/traced_canvas.h"
#include "lens/traced_mask.h"
#include "lens/traced_mesh.h"
#include "lens/traced_ways.h"

namespace aureole::lens {
namespace {

std::vector<double> wavelengths_of(std::span<const color::SpectralBand> bands) {
    std::vector<double> wavelengths_nm;
    for (const color::SpectralBand& band : bands) wavelengths_nm.push_back(band.wavelength_nm);
    return wavelengths_nm;
}

// With the margins of all levels that matter.
PlaneBox sensor_of(const Film& film) {
    const double margin = 0.05 * std::max(film.width, film.height);
    const auto x_mm = [&](double px) { return (film.axis_x - px) * film.mm_per_px; };
    const auto y_mm = [&](double px) { return (px - film.axis_y) * film.mm_per_px; };
    return {x_mm(film.width + margin), x_mm(-margin), y_mm(-margin), y_mm(film.height + margin)};
}

// Memory for meshes that are traced before they are drawn.
std::size_t meshes_at_once(int side) {
    constexpr std::size_t kBytes = std::size_t{96} << 20;
    return std::clamp<std::size_t>(kBytes / TracedMesh::bytes(side), 2, 32);
}

// What is known of one ghost of the current light.
struct GhostNow {
    PlaneBox box;
    int level = 0;
    BlurMoments blur;  // pixels of the level
    bool blurred = false;
};

}  // namespace

struct TracedGhosts::Impl {
    Impl(const Lens& a_lens, const Iris& an_iris, const Film& a_film, const FlareOptions& options,
         std::vector<Bounces> list, const Occluder* occluder)
        : film(a_film),
          bands(color::sample_spectrum(options.wavelengths)),
          wavelengths_nm(wavelengths_of(bands)),
          ghosts(std::move(list)),
          ways(a_lens, ghosts, wavelengths_nm),
          mask(an_iris, occluder, options.ghost_texture),
          first_face(a_lens.faces().front()),
          middle(options.wavelengths / 2),
          tracer(a_lens, wavelengths_nm[static_cast<std::size_t>(middle)]),
          sensor(sensor_of(a_film)),
          now(ghosts.size()),
          searches(static_cast<std::size_t>(max_workers())) {
        for (std::size_t k = 0; k < meshes_at_once(options.rays_per_side); ++k) {
            meshes.emplace_back(options.rays_per_side);
        }
        paints.reserve(meshes.size());
    }

    void prepare(const sources::Light& light, const GhostDraw& draw, const Canvas& canvas,
                 int worker);
    MeshJob job_for(const sources::Light& light, const GhostDraw& draw, int band,
                    const Canvas& canvas) const;

    Film film;
    std::vector<color::SpectralBand> bands;
    std::vector<double> wavelengths_nm;
    std::vector<Bounces> ghosts;
    TracedWays ways;
    TracedMask mask;
    Face first_face;
    int middle;  // band
    Tracer tracer;
    PlaneBox sensor;  // what the picture shows

    std::vector<GhostNow> now;
    std::vector<EntranceSearch> searches;  // by worker
    std::vector<TracedMesh> meshes;
    std::vector<MeshPaint> paints;
    std::optional<TracedCanvas> tiles;
    std::size_t rays = 0;
};

// Where its rays enter, and how its light blurs it.
void TracedGhosts::Impl::prepare(const sources::Light& light, const GhostDraw& draw,
                                 const Canvas& canvas, int worker) {
    GhostNow& ghost = now[static_cast<std::size_t>(draw.ghost)];
    const RayDirection direction(light);
    const std::span<const RayStep> steering[3] = {
        ways.way(draw.ghost, middle), ways.way(draw.ghost, 0),
        ways.way(draw.ghost, static_cast<int>(bands.size()) - 1)};
    ghost.box = searches[static_cast<std::size_t>(worker)].find(
        {.ways = std::span(steering).first(std::min<std::size_t>(bands.size(), 3)),
         .sensor_distance_mm = ways.sensor_distance_mm(),
         .iris = mask.field(),
         .widest = mask.outer_radius(),
         .direction = direction,
         .start = entrance_of_first_face(first_face, direction, mask.outer_radius()),
         .sensor = sensor});
    ghost.level = std::clamp(draw.level, 0, canvas.levels() - 1);
    ghost.blurred = false;
    if (ghost.box.empty() || (light.moment_xx <= 0 && light.moment_yy <= 0)) return;
    ghost.blur = blur_of(tracer, ghosts[static_cast<std::size_t>(draw.ghost)], light,
                         0.5 * (ghost.box.x0 + ghost.box.x1), 0.5 * (ghost.box.y0 + ghost.box.y1));
    const auto scale = [&](double by) {
        ghost.blur.xx *= by;
        ghost.blur.xy *= by;
        ghost.blur.yy *= by;
    };
    scale(std::pow(film.mm_per_px * (1 << ghost.level), -2));
    // The sensor's y runs against the picture's, as does its x: no sign of xx, yy changes, and that
    // of xy does, for x is turned and y is not.
    ghost.blur.xy = -ghost.blur.xy;
    // A blur of a few pixels is drawn where its pixels are large.
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

MeshJob TracedGhosts::Impl::job_for(const sources::Light& light, const GhostDraw& draw, int band,
                                    const Canvas& canvas) const {
    const GhostNow& ghost = now[static_cast<std::size_t>(draw.ghost)];
    const CanvasLevel& level = canvas.level(ghost.level);
    MeshJob job{.way = ways.way(draw.ghost, band),
                .sensor_distance_mm = ways.sensor_distance_mm(),
                .direction = RayDirection(light),
                .box = ghost.box,
                .iris = mask.field(),
                .inner_radius = mask.inner_radius(),
                .outer_radius = mask.outer_radius(),
                .all_masked = mask.piece_mask().extra != nullptr,
                .film = &film,
                .level = ghost.level};
    const double reach = ghost.blurred ? std::ceil(BlurKernel::reach(ghost.blur) + 0.5) : 0;
    const auto edge = static_cast<float>(level.margin + reach);
    job.x0 = -edge;
    job.y0 = -edge;
    job.x1 = static_cast<float>(level.width) + edge;
    job.y1 = static_cast<float>(level.height) + edge;
    const double px_mm = film.mm_per_px * (1 << ghost.level);
    job.power_per_mm2 = light.solid_angle_sr * job.direction.z /
                        (film.irradiance_per_radiance * px_mm * px_mm);
    return job;
}

TracedGhosts::TracedGhosts(const Lens& lens, const Iris& iris, const Film& film,
                           const FlareOptions& options, std::vector<Bounces> ghosts,
                           const Occluder* occluder)
    : impl_(std::make_unique<Impl>(lens, iris, film, options, std::move(ghosts), occluder)) {}
TracedGhosts::~TracedGhosts() = default;
TracedGhosts::TracedGhosts(TracedGhosts&&) noexcept = default;

void TracedGhosts::draw(const sources::Light& light, std::span<const GhostDraw> ghosts,
                        Canvas& canvas) {
    Impl& m = *impl_;
    if (!m.tiles) m.tiles.emplace(canvas);
    m.rays = 0;
    parallel_for(ghosts.size(), [&](std::size_t g, int worker) {
        m.prepare(light, ghosts[g], canvas, worker);
    });
    for (EntranceSearch& search : m.searches) m.rays += search.take_rays();

    // In batches: trace, then draw.
    const std::size_t bands = m.bands.size();
    const std::size_t total = ghosts.size() * bands;
    std::size_t next = 0;
    struct Item {
        const GhostDraw* draw = nullptr;
        int band = 0;
    };
    std::vector<Item> items;
    items.reserve(m.meshes.size());
    BlurKernel kernel;
    while (next < total) {
        items.clear();
        for (; next < total && items.size() < m.meshes.size(); ++next) {
            const GhostDraw& draw = ghosts[next / bands];
            if (m.now[static_cast<std::size_t>(draw.ghost)].box.empty()) continue;
            items.push_back({&draw, static_cast<int>(next % bands)});
        }
        parallel_for(items.size(), [&](std::size_t k, int) {
            m.meshes[k].build(m.job_for(light, *items[k].draw, items[k].band, canvas));
        });
        const auto paint = [&](std::size_t k) {
            const GhostDraw& draw = *items[k].draw;
            const color::SpectralBand& band = m.bands[static_cast<std::size_t>(items[k].band)];
            const auto transmission =
                static_cast<float>(m.ways.axial_transmission(items[k].band));
            MeshPaint out;
            out.mesh = &m.meshes[k];
            out.level = m.now[static_cast<std::size_t>(draw.ghost)].level;
            
            for (std::size_t c = 0; c < 3; ++c) {
                out.weight[c] = static_cast<float>(band.rgb[c]) * light.radiance[c] * draw.gain[c] /
                                transmission;
            }
            return out;
        };
        m.paints.clear();
        for (std::size_t k = 0; k < items.size(); ++k) {
            m.rays += m.meshes[k].rays();
            if (!m.now[static_cast<std::size_t>(items[k].draw->ghost)].blurred) {
                m.paints.push_back(paint(k));
            }
        }
        m.tiles->draw(m.paints, m.mask.piece_mask(), canvas);
        for (std::size_t k = 0; k < items.size();) {
            const GhostDraw* draw = items[k].draw;
            const GhostNow& ghost = m.now[static_cast<std::size_t>(draw->ghost)];
            m.paints.clear();
            for (; k < items.size() && items[k].draw == draw; ++k) m.paints.push_back(paint(k));
            if (!ghost.blurred) continue;
            kernel.set(ghost.blur);
            m.tiles->draw_blurred(m.paints, m.mask.piece_mask(), kernel, canvas);
        }
    }
}

void TracedGhosts::compare(const sources::Light&, std::span<const MatrixGhost>,
                           std::span<float> difference) {
    std::fill(difference.begin(), difference.end(), 0.0F);
}

std::size_t TracedGhosts::rays() const noexcept { return impl_->rays; }

}  // namespace aureole::lens
