// The spectrum of ghosts: few bands for rays, many for what coatings make of colours.
//
// A coating's reflectance changes much faster with the wavelength than the way of a ray does. So
// each band has rays at its middle only, and a weight for R, G and B that is the integral over the
// band of T_g / T_0, as a mean over some rays of the ghost, relative to T_g in the middle.
//
// Where the ways within one band differ by pixels, bands would show as so many outlines side by
// side. There each band is cut into kStrata strata with as many rays in all.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "aureole/color/spectrum.h"
#include "lens/ray_grid.h"
#include "lens/traced_mask.h"
#include "lens/traced_ways.h"

namespace aureole::lens {

// Everything one light needs to know about one ghost before it is traced.
struct GhostLight {
    EntranceFound found;
    // By band, to be multiplied by power and throughput at the band's middle: R, G, B.
    std::vector<std::array<float, 3>> weights;
    std::vector<std::array<float, 3>> strata_weights;  // the same by stratum
    // How far apart, on the sensor, a ray through one point of the entrance lands at both ends of a
    // band at most.
    double dispersion_mm = 0;
};

class TracedBands {
  public:
    TracedBands(const Lens& lens, std::span<const Bounces> ghosts, int count);

    int count() const noexcept { return static_cast<int>(bands_.size()); }
    int middle() const noexcept { return count() / 2; }
    double wavelength_nm(int band) const noexcept {
        return bands_[static_cast<std::size_t>(band)].wavelength_nm;
    }
    static constexpr int kStrata = 3;
    std::span<const RayStep> way(int ghost, int band,
                                 std::vector<RayStep>& scratch) const noexcept {
        return ways_.way(ghost, band, scratch);
    }
    std::span<const RayStep> way_of_stratum(int ghost, int stratum,
                                            std::vector<RayStep>& scratch) const noexcept {
        return ways_.way(ghost, count() + stratum, scratch);
    }
    std::vector<RayStep> scratch() const { return ways_.scratch(); }
    float sensor_distance_mm() const noexcept { return ways_.sensor_distance_mm(); }

    // Scratch memory of one worker.
    class Probe {
      public:
        explicit Probe(const TracedBands& bands);

        // Rays traced since the last call.
        std::size_t take_rays() noexcept;

      private:
        friend class TracedBands;
        EntranceSearch search_;
        std::vector<RayStep> steps_[3];
        Buffer memory_;
        RayFields fields_;
        RayFields other_;
        float* energy_;
        std::vector<double> means_;
        std::size_t rays_ = 0;
    };

    // Where rays enter that pass and land on `sensor`, and if there are any, the weights of bands.
    void prepare(int ghost, const RayDirection& direction, const PlaneBox& sensor,
                 const TracedMask& mask, Probe& probe, GhostLight& out) const noexcept;

  private:
    void weigh(int ghost, const RayDirection& direction, const TracedMask& mask, Probe& probe,
               GhostLight& out) const noexcept;

    std::vector<color::SpectralBand> bands_;
    std::vector<color::SpectralBand> strata_;  // each band divided
    std::vector<color::SpectralBand> fine_;    // each stratum divided
    TracedWays ways_;                          // at the middles of bands_, strata_, fine_
    Face first_face_;
};

}  // namespace aureole::lens
