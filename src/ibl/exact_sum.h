// Sums of all texels of an environment under the weight of prefilter.h, for up to 64 outputs at
// once. The error of a texel's integral stays below about 1e-6 of it:
//
// - Where the weight bends little over a texel, its second-order Taylor polynomial in mu = N.L
//   about the texel's mean direction, with the exact mean and covariance of the directions in it.
// - Where a horizon cuts such a texel, the exact mean of max(0, mu) for mu linear over the texel.
// - Near the lobe, the product Gauss-Legendre rule with 2 to 4 points per side, over the texel or
//   over a quad-tree of its parts, as the width of the lobe there asks for.
#pragma once

#include <array>
#include <vector>

#include "aureole/ibl/cube_map.h"
#include "ibl/exact_kernels.h"
#include "ibl/ggx_lobe.h"
#include "ibl/texel_geometry.h"

namespace aureole::ibl {

// Narrower lobes are far inside of a texel of any size, and float offsets could not resolve them.
inline constexpr double kLeastExactAlpha = 1e-5;

class ExactSum {
  public:
    explicit ExactSum(int size);

    void prepare(const CubeMap& environment) noexcept;

    // `normals` are 1 to 64 unit vectors, close to one another if this is to be fast. alpha >=
    // kLeastExactAlpha. Allocates nothing.
    void add(double alpha, const Direction* normals, int count, LobeSums& sums) const noexcept;

  private:
    TexelGeometry geometry_;
    // Radiance times solid angle of all texels, R, G, B; faces of blocks as in TexelGeometry.
    std::vector<float> light_;
};

}  // namespace aureole::ibl
