#include "lens/traced_bands.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aureole::lens {
namespace {

constexpr int kLeastFineBands = 16;
// Rays that stand for a ghost: a block in each of some rows.
constexpr int kProbeRows = 3;
constexpr std::size_t kProbeRays = kRayBlock * kProbeRows;

std::vector<double> wavelengths_of(std::span<const color::SpectralBand> bands,
                                   std::span<const color::SpectralBand> fine) {
    std::vector<double> wavelengths_nm;
    for (const auto list : {bands, fine}) {
        for (const color::SpectralBand& band : list) wavelengths_nm.push_back(band.wavelength_nm);
    }
    return wavelengths_nm;
}

}  // namespace

TracedBands::TracedBands(const Lens& lens, std::span<const Bounces> ghosts, int count)
    : bands_(color::sample_spectrum(count)),
      fine_(color::sample_spectrum(count * ((kLeastFineBands + count - 1) / count))),
      ways_(lens, ghosts, wavelengths_of(bands_, fine_)),
      first_face_(lens.faces().front()) {}

TracedBands::Probe::Probe(const TracedBands& bands) : memory_(6 * kProbeRays) {
    for (auto& steps : steps_) steps = bands.ways_.scratch();
    float** const all[] = {&fields_.x, &fields_.y, &fields_.u, &fields_.v, &fields_.clip, &energy_};
    for (std::size_t k = 0; k < 6; ++k) *all[k] = memory_.data() + k * kProbeRays;
    means_.resize(bands.bands_.size() + bands.fine_.size());
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
    ray_kernels().trace(way(ghost, middle(), probe.steps_[0]), sensor_distance_mm(), rays,
                        mask.field(), probe.fields_);
    const RayFields& at = probe.fields_;
    float* counts = at.x;  // 1 for rays that pass
    for (std::size_t k = 0; k < kProbeRays; ++k) {
        const bool passes =
            at.clip[k] <= 1 && std::hypot(at.u[k], at.v[k]) <= mask.outer_radius();
        counts[k] = passes ? 1.0F : 0.0F;
    }
    const bool some = std::any_of(counts, counts + kProbeRays, [](float c) { return c > 0; });
    if (!some) std::fill(counts, counts + kProbeRays, 1.0F);
    const auto mean_at = [&](std::size_t wavelength) {
        ray_kernels().throughput(way(ghost, static_cast<int>(wavelength), probe.steps_[0]), rays,
                                 probe.energy_);
        double sum = 0;
        for (std::size_t k = 0; k < kProbeRays; ++k) sum += counts[k] * probe.energy_[k];
        return sum;
    };
    for (std::size_t k = 0; k < probe.means_.size(); ++k) probe.means_[k] = mean_at(k);
    probe.rays_ += kProbeRays * (probe.means_.size() + 1);

    const std::size_t per_band = fine_.size() / bands_.size();
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        std::array<double, 3> sum = {};
        for (std::size_t k = 0; k < per_band; ++k) {
            const std::size_t f = b * per_band + k;
            const auto wavelength = static_cast<int>(bands_.size() + f);
            const double middle_mean = probe.means_[b];
            // Both means are over the same rays. A ghost that is dark in the middle of a band, as
            // it may be at the edge of total reflection, keeps its own transmission.
            const double ratio =
                middle_mean > 0 ? probe.means_[bands_.size() + f] / middle_mean : 1;
            for (std::size_t c = 0; c < 3; ++c) {
                sum[c] += fine_[f].rgb[c] * ratio / ways_.axial_transmission(wavelength);
            }
        }
        for (std::size_t c = 0; c < 3; ++c) out.weights[b][c] = static_cast<float>(sum[c]);
    }
}

}  // namespace aureole::lens
