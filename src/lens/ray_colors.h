// The colour of a ray: how much of each part of the visible spectrum is left of it on arrival.
#pragma once

#include <array>
#include <vector>

#include "aureole/lens/trace.h"

namespace aureole::lens {

class RayColors {
  public:
    static constexpr int kBands = 16;

    explicit RayColors(const Lens& lens);

    // Sums T_g / T_0 (flare.h) over the bands with their RGB weights. All bands take the way of the
    // d line: on the mean within .4 % of each on its own, within some per cent where a face
    // reflects hardly anything. False if it does not arrive. `incidences` is scratch.
    bool color_of(const Bounces& bounces, const Ray& ray, std::vector<Incidence>& incidences,
                  std::array<double, 3>& color) const;
    bool arrives(const Bounces& bounces, const Ray& ray) const {
        return tracer_.trace(bounces, ray).fate == Fate::kArrived;
    }
    // T_0 as RGB.
    std::array<double, 3> axial_transmission() const;

  private:
    using Bands = std::array<float, kBands>;
    // At one cosine of incidence.
    struct Sample {
        Bands s, p;
    };

    Tracer tracer_;
    int stop_;
    std::array<double, kBands> axial_ = {};
    std::array<std::array<double, 3>, kBands> rgb_ = {};
    std::vector<Sample> samples_;  // by face, direction, and cosine as in ray_kernels.h
};

}  // namespace aureole::lens
