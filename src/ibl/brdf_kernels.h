// The SIMD part of tables of BRDFs: one integral over the hemisphere.
#pragma once

#include <array>

namespace aureole::ibl {

inline constexpr int kElevations = 48;
inline constexpr int kAzimuths = 24;

// Gauss-Legendre rules over [0, 1].
struct BrdfNodes {
    alignas(64) std::array<float, kElevations> elevation;
    alignas(64) std::array<float, kElevations> elevation_weight;
    std::array<float, kAzimuths> azimuth;
    std::array<float, kAzimuths> azimuth_weight;
};

struct BrdfKernels {
    // Integrals of D V (N.l), and of that times (1 - v.h)^5.
    std::array<double, 2> (*ggx)(const BrdfNodes& nodes, double n_dot_v, double alpha);
    // Integral of D V (N.l), and 0.
    std::array<double, 2> (*cloth)(const BrdfNodes& nodes, double n_dot_v, double alpha);
};

const BrdfKernels& brdf_kernels();

}  // namespace aureole::ibl
