#include "lens/traced_bands.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aureole::lens {
namespace {

constexpr int kLeastFineBands = 16;
// Rays that stand for a ghost: a block in each of some rows.
constexpr int kProbeRows = 4;
constexpr std::size_t kProbeRays = kRayBlock * kProbeRows;

int fine_count(int strata) { return strata * ((kLeastFineBands + strata - 1) / strata); }

std::vector<double> wavelengths_of(
    std::initializer_list<std::span<const color::SpectralBand>> lists) {
    std::vector<double> wavelengths_nm;
    for (const auto list : lists) {
        for (const color::SpectralBand& band : list) wavelengths_nm.push_back(band.wavelength_nm);
    }
    return wavelengths_nm;
}

}  // namespace

TracedBands::TracedBands(const Lens& lens, std::span<const Bounces> ghosts, int count)
    : bands_(color::sample_spectrum(count)),
      strata_(color::sample_spectrum(count * kStrata)),
      fine_(color::sample_spectrum(fine_count(count * kStrata))),
      ways_(lens, ghosts, wavelengths_of({bands_, strata_, fine_})),
      first_face_(lens.faces().front()) {}

TracedBands::Probe::Probe(const TracedBands& bands) : memory_(11 * kProbeRays) {
    for (auto& steps : steps_) steps = bands.ways_.scratch();
    float** const all[] = {&fields_.x,    &fields_.y,   &fields_.u, &fields_.v,
                           &fields_.clip, &other_.x,    &other_.y,  &other_.u,
                           &other_.v,     &other_.clip, &energy_};
    for (std::size_t k = 0; k < 11; ++k) *all[k] = memory_.data() + k * kProbeRays;
    means_.resize(bands.bands_.size() + bands.strata_.size() + bands.fine_.size());
}

std::size_t TracedBands::Probe::take_rays() noexcept {
    return std::exchange(rays_, 0) + search_.take_rays();
}

void TracedBands::prepare(int ghost, const RayDirection& direction, const PlaneBox& sensor,
                          const TracedMask& mask, Probe& probe, GhostLight& out) const noexcept {
    std::span<const RayStep> steering[3];
    std::size_t count = 0;
    for (const int band : {middle(), 0, this->count() - 1}) {
        if (count > 0 && band == middle()) continue;
        steering[count] = way(ghost, band, probe.steps_[count]);
        ++count;
    }
    out.found = probe.search_.find(
        {.ways = std::span(steering).first(count),
         .sensor_distance_mm = sensor_distance_mm(),
         .iris = mask.field(),
         .widest = mask.outer_radius(),
         .direction = direction,
         .start = entrance_of_first_face(first_face_, direction, mask.outer_radius()),
         .sensor = sensor});
    if (!out.found.entrance.empty()) weigh(ghost, direction, mask, probe, out);
}

void TracedBands::weigh(int ghost, const RayDirection& direction, const TracedMask& mask,
                        Probe& probe, GhostLight& out) const noexcept {
    const PlaneBox& box = out.found.entrance;
    RayBundle rays;
    rays.direction[0] = static_cast<float>(direction.x);
    rays.direction[1] = static_cast<float>(direction.y);
    rays.direction[2] = static_cast<float>(direction.z);
    rays.columns = kRayBlock;
    rays.rows = kProbeRows;
    rays.step_x_mm = static_cast<float>((box.x1 - box.x0) / kRayBlock);
    rays.step_y_mm = static_cast<float>((box.y1 - box.y0) / kProbeRows);
    rays.x_mm = static_cast<float>(box.x0) + 0.5F * rays.step_x_mm;
    rays.y_mm = static_cast<float>(box.y0) + 0.5F * rays.step_y_mm;
    // How far apart the middle band lands, and which rays of it pass. Its outermost strata span
    // all but 1 / kStrata of it.
    const auto trace = [&](int stratum, const RayFields& to) {
        ray_kernels().trace(way_of_stratum(ghost, stratum, probe.steps_[0]), sensor_distance_mm(),
                            rays, mask.field(), to);
    };
    trace(middle() * kStrata, probe.other_);
    trace(middle() * kStrata + kStrata - 1, probe.fields_);
    const RayFields& at = probe.fields_;
    const RayFields& other = probe.other_;
    float* passing = at.u;  // 1 for rays that pass
    double apart = 0;
    bool some = false;
    for (std::size_t k = 0; k < kProbeRays; ++k) {
        const bool passes = at.clip[k] <= 1 && std::hypot(at.u[k], at.v[k]) <= mask.outer_radius();
        passing[k] = passes ? 1.0F : 0.0F;
        some = some || passes;
        if (!passes || other.clip[k] >= kLostRay) continue;
        apart = std::max<double>(apart, std::hypot(at.x[k] - other.x[k], at.y[k] - other.y[k]));
    }
    out.dispersion_mm = apart * kStrata / (kStrata - 1);
    if (!some) std::fill(passing, passing + kProbeRays, 1.0F);
    for (std::size_t k = 0; k < probe.means_.size(); ++k) {
        ray_kernels().throughput(ways_.way(ghost, static_cast<int>(k), probe.steps_[0]), rays,
                                 probe.energy_);
        double sum = 0;
        for (std::size_t r = 0; r < kProbeRays; ++r) sum += passing[r] * probe.energy_[r];
        probe.means_[k] = sum;
    }
    probe.rays_ += kProbeRays * (probe.means_.size() + 2);

    const std::size_t first_fine = bands_.size() + strata_.size();
    const auto integrate = [&](std::size_t first, std::span<std::array<float, 3>> weights) {
        const std::size_t each = fine_.size() / weights.size();
        for (std::size_t b = 0; b < weights.size(); ++b) {
            const double middle_mean = probe.means_[first + b];
            std::array<double, 3> sum = {};
            for (std::size_t f = b * each; f < (b + 1) * each; ++f) {
                // A ghost that is dark in the middle of a band keeps its own transmission.
                const double ratio =
                    middle_mean > 0 ? probe.means_[first_fine + f] / middle_mean : 1;
                const double transmission =
                    ways_.axial_transmission(static_cast<int>(first_fine + f));
                for (std::size_t c = 0; c < 3; ++c)
                    sum[c] += fine_[f].rgb[c] * ratio / transmission;
            }
            for (std::size_t c = 0; c < 3; ++c) weights[b][c] = static_cast<float>(sum[c]);
        }
    };
    integrate(0, out.weights);
    integrate(bands_.size(), out.strata_weights);
}

}  // namespace aureole::lens
