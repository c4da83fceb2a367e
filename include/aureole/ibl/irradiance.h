// Irradiance: what a diffuse surface receives from the whole environment,
//
//     E(N) = integral over the sphere of  L(w) max(0, N.w) dw,
//
// not divided by pi. In a constant environment E = pi L. A Lambertian surface of albedo rho then
// shows the radiance rho E / pi; shaders that multiply albedo and map without the 1 / pi want E /
// pi.
//
// The environment is constant over each texel, and the integral is exact but for the horizon's way
// through a texel, which is taken as straight: 1e-5 of E for a sun in one texel on the horizon of a
// map of 256 texels per side. docs/irradiance.md explains the method, whose cost grows with the
// number of texels along a horizon only.
#pragma once

#include <array>
#include <memory>

#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

// Texels per side of a map of irradiance, unless asked otherwise: E has nothing left at finer
// scales.
inline constexpr int kIrradianceSize = 32;

class Irradiance {
  public:
    // For environments of `size` texels per side; takes 14 bytes per texel. Throws InvalidArgument
    // unless size is in [1, 16384].
    explicit Irradiance(int size);
    ~Irradiance();
    Irradiance(Irradiance&&) noexcept;
    Irradiance& operator=(Irradiance&&) noexcept;

    // `environment` is finite and of that size; it is copied. Allocates nothing.
    void prepare(const CubeMap& environment) noexcept;

    // E(normal), R, G, B; any length but 0. After prepare(), from any number of threads.
    std::array<double, 3> at(const Direction& normal) const noexcept;
    // E at the middles of all texels of `out`, of any size. The same bits with any number of
    // threads.
    void fill(CubeMap& out) const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// All of it in one call. Throws InvalidArgument for an empty environment or a size outside
// [1, 16384].
CubeMap irradiance_map(const CubeMap& environment, int size = kIrradianceSize);

}  // namespace aureole::ibl
