#include "aureole/lens/flare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "aureole/base/error.h"
#include "canvas.h"
#include "film.h"
#include "flare_plan.h"
#include "matrix_ghosts.h"
#include "progress_part.h"
#include "traced_ghosts.h"

namespace aureole::lens {
namespace {

using Drawn = GhostReport::Drawn;

template <class Value>
void require(bool good, const char* name, Value value, const char* allowed) {
    if (!good) throw InvalidArgument(name, fmt::format("{}", value), allowed);
}

void require_weights(const char* name, const std::array<float, 3>& rgb) {
    for (const float value : rgb) {
        require(value >= 0 && std::isfinite(value), name, value, "must be finite and >= 0");
    }
}

// How much of the square around what is open of a ghost lies inside the picture.
double share_inside(const MatrixGhost& ghost, const Film& film) {
    const double radius = std::max(0.5, static_cast<double>(ghost.open_radius_px));
    const auto overlap = [&](double centre, double size) {
        const double low = std::max(0.0, centre - radius);
        const double high = std::min(size, centre + radius);
        return std::max(0.0, high - low) / (2 * radius);
    };
    return overlap(ghost.open_x, film.width) * overlap(ghost.open_y, film.height);
}

}  // namespace

GhostMethod ghost_method_from_name(std::string_view name) {
    if (name == "matrix") return GhostMethod::kMatrix;
    if (name == "traced") return GhostMethod::kTraced;
    if (name == "hybrid") return GhostMethod::kHybrid;
    throw InvalidArgument("ghosts", std::string(name), "must be matrix, traced or hybrid");
}

void validate(const FlareOptions& options) {
    require(options.look == Look::kPhysical || options.method == GhostMethod::kMatrix, "look",
            "blog", "is drawn by the matrix method only");
    require(options.wavelengths >= 1 && options.wavelengths <= 64, "wavelengths",
            options.wavelengths, "must be in [1, 64]");
    require(options.rays_per_side >= 8 && options.rays_per_side <= 1024, "rays_per_side",
            options.rays_per_side, "must be in [8, 1024]");
    require(options.energy_dropped >= 0 && options.energy_dropped < 1, "energy_dropped",
            options.energy_dropped, "must be in [0, 1)");
    require(options.strongest > 0 && options.strongest <= 1, "strongest", options.strongest,
            "must be in (0, 1]");
    require(options.hybrid_tolerance > 0 && options.hybrid_tolerance <= 1, "hybrid_tolerance",
            options.hybrid_tolerance, "must be in (0, 1]");
    require(options.coarse_tolerance >= 0 && options.coarse_tolerance < 1, "coarse_tolerance",
            options.coarse_tolerance, "must be in [0, 1)");
    require_weights("tint", options.tint);
    for (const GhostSetting& setting : options.ghosts) {
        require(setting.gain >= 0 && std::isfinite(setting.gain), "ghost gain", setting.gain,
                "must be finite and >= 0");
        require_weights("ghost tint", setting.tint);
    }
}

struct Flare::Impl {
    Impl(const Lens& lens, const Iris& iris, const View& view, const FlareOptions& flare_options,
         const Occluder* occluder)
        : options(flare_options),
          film(lens, view),
          list(enumerate_ghosts(lens, options.set)),
          settings(list.size()),
          matrix(lens, iris, film, options, list, occluder),
          canvas(film.width, film.height),
          estimates(list.size()),
          plans(list.size()),
          comparisons(list.size()) {
        if (options.method != GhostMethod::kMatrix) {
            traced.emplace(lens, iris, film, options, list, occluder);
        }
        for (std::size_t i = 0; i < list.size(); ++i) settings[i].bounces = list[i];
        for (const GhostSetting& setting : options.ghosts) {
            const auto found = std::find(list.begin(), list.end(), setting.bounces);
            if (found == list.end()) {
                throw InvalidArgument(
                    fmt::format("ghost of surfaces {} and {}: this lens has no such ghost among "
                                "the {} in force",
                                setting.bounces.far + 1, setting.bounces.near + 1, list.size()));
            }
            settings[static_cast<std::size_t>(found - list.begin())] = setting;
        }
        report.ghosts.resize(list.size());
        for (const Bounces& bounces : list) placed.push_back({.bounces = bounces});
        by_matrix.reserve(list.size());
        by_rays.reserve(list.size());
    }

    std::array<float, 3> gain(std::size_t ghost) const {
        std::array<float, 3> gain = {};
        for (std::size_t c = 0; c < 3; ++c) {
            gain[c] = settings[ghost].gain * settings[ghost].tint[c] * options.tint[c];
        }
        return gain;
    }

    void estimate(const sources::Light& light);
    void draw(const sources::Light& light, const ProgressPart& progress);
    void render(std::span<const sources::Light> lights, const ProgressPart& progress);
    void clear_report();
    void add_to_report(const PlanTotals& totals, double energy, bool first_light);

    FlareOptions options;
    Film film;
    std::vector<Bounces> list;
    std::vector<GhostSetting> settings;
    MatrixGhosts matrix;
    std::optional<TracedGhosts> traced;
    Canvas canvas;
    std::vector<GhostEstimate> estimates;
    std::vector<GhostPlan> plans;
    std::vector<GhostComparison> comparisons;
    std::vector<GhostDraw> by_matrix, by_rays;
    std::vector<GhostPlacement> placed;
    FlareReport report;
};

void Flare::Impl::estimate(const sources::Light& light) {
    matrix.place(light);
    const auto placements = matrix.placements();
    for (std::size_t i = 0; i < list.size(); ++i) {
        const MatrixGhost& ghost = placements[i];
        const auto weight = gain(i);
        const double mean_gain = (weight[0] + weight[1] + weight[2]) / 3.0;
        GhostEstimate& estimate = estimates[i];
        estimate.enabled = settings[i].enabled && mean_gain > 0;
        estimate.energy = ghost.energy * mean_gain * share_inside(ghost, film);
        estimate.radiance =
            (ghost.radiance[0] + ghost.radiance[1] + ghost.radiance[2]) / 3.0 * mean_gain;
        estimate.radius_px = ghost.open_radius_px;
        estimate.difference = -1;
    }
    if (!traced) return;
    // Linear optics may be far off in energy too, and block what exact rays find open.
    traced->compare(light, placements, comparisons);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const auto weight = gain(i);
        const double mean_gain = (weight[0] + weight[1] + weight[2]) / 3.0;
        estimates[i].energy = comparisons[i].energy * mean_gain;
        estimates[i].difference = comparisons[i].difference * mean_gain;
    }
}

void Flare::Impl::draw(const sources::Light& light, const ProgressPart& progress) {
    by_matrix.clear();
    by_rays.clear();
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (plans[i].drawn != Drawn::kMatrix && plans[i].drawn != Drawn::kTraced) continue;
        const auto weight = gain(i);
        const GhostDraw draw = {
            static_cast<int>(i), plans[i].level, {weight[0], weight[1], weight[2]}};
        (plans[i].drawn == Drawn::kMatrix ? by_matrix : by_rays).push_back(draw);
    }
    matrix.draw(by_matrix, canvas);
    if (!by_rays.empty()) {
        traced->draw(light, by_rays, canvas, progress);
        report.rays += traced->rays();
    }
}

void Flare::Impl::clear_report() {
    for (std::size_t i = 0; i < list.size(); ++i) report.ghosts[i] = {.bounces = list[i]};
    report.energy_dropped = report.coarse_displaced = 0;
    report.rays = 0;
}

void Flare::Impl::add_to_report(const PlanTotals& totals, double energy, bool first_light) {
    const auto placements = matrix.placements();
    for (std::size_t i = 0; i < list.size(); ++i) {
        GhostReport& ghost = report.ghosts[i];
        // A ghost that any light makes is reported as drawn for the light that matters most to it.
        if (!first_light && estimates[i].energy <= ghost.energy) continue;
        const MatrixGhost& place = placements[i];
        ghost = {list[i],
                 plans[i].drawn,
                 estimates[i].energy,
                 place.center_x,
                 place.center_y,
                 place.radius_px,
                 estimates[i].radiance,
                 estimates[i].difference < 0 || estimates[i].energy <= 0
                     ? -1
                     : estimates[i].difference / estimates[i].energy};
    }
    report.energy_dropped += totals.energy_dropped * energy;
    report.coarse_displaced += totals.coarse_displaced * energy;
}

Flare::Flare(const Lens& lens, const Iris& iris, const View& view, const FlareOptions& options,
             const Occluder* occluder) {
    validate(options);
    impl_ = std::make_unique<Impl>(lens, iris, view, options, occluder);
}
Flare::~Flare() = default;
Flare::Flare(Flare&&) noexcept = default;
Flare& Flare::operator=(Flare&&) noexcept = default;

// Onto the canvas.
void Flare::Impl::render(std::span<const sources::Light> lights, const ProgressPart& progress) {
    // What estimates take, of traced ghosts.
    constexpr double kEstimates = 0.1;
    clear_report();
    canvas.clear();
    double energy = 0;
    for (std::size_t k = 0; k < lights.size(); ++k) {
        const auto count = static_cast<double>(lights.size());
        const ProgressPart of_light =
            progress.part(static_cast<double>(k) / count, static_cast<double>(k + 1) / count);
        of_light.reach(0);
        estimate(lights[k]);
        const PlanTotals totals = plan_ghosts(estimates, options, canvas.levels() - 1, plans);
        draw(lights[k], of_light.part(kEstimates, 1));
        double sum = 0;
        for (const GhostEstimate& ghost : estimates) {
            if (ghost.enabled) sum += ghost.energy;
        }
        add_to_report(totals, sum, k == 0);
        energy += sum;
    }
    progress.reach(1);
    if (energy > 0) {
        report.energy_dropped /= energy;
        report.coarse_displaced /= energy;
    }
}

void Flare::render(std::span<const sources::Light> lights, const ImageView& out,
                   Progress* progress) {
    try {
        impl_->render(lights, {.progress = progress, .stage = "ghosts"});
    } catch (const Cancelled&) {
        impl_->clear_report();
        throw;
    }
    impl_->canvas.add_to(out);
}

std::span<const GhostPlacement> Flare::place(const sources::Light& light) noexcept {
    impl_->matrix.place(light);
    const auto placements = impl_->matrix.placements();
    for (std::size_t i = 0; i < placements.size(); ++i) {
        const MatrixGhost& ghost = placements[i];
        GhostPlacement& placed = impl_->placed[i];
        placed.center_x = ghost.center_x;
        placed.center_y = ghost.center_y;
        placed.radius_x_px = ghost.u_per_px == 0 ? 0 : 1 / ghost.u_per_px;
        placed.radius_y_px = ghost.v_per_px == 0 ? 0 : 1 / ghost.v_per_px;
        placed.radiance = {ghost.radiance[0], ghost.radiance[1], ghost.radiance[2]};
    }
    return impl_->placed;
}

const FlareReport& Flare::report() const noexcept { return impl_->report; }

std::array<double, 3> Flare::axial_transmission() const noexcept {
    return impl_->matrix.axial_transmission();
}

}  // namespace aureole::lens
