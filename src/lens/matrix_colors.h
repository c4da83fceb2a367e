// The colours of ghosts: what their faces reflect and transmit, by the angle of the light.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lens/matrix_path.h"

namespace aureole::lens {

class MatrixColors {
  public:
    static constexpr int kNodes = 65;  // angles of a table

    // Sums 16 bands of the visible spectrum of T_g / T_0 (flare.h) with their RGB weights, along
    // the exact ray through the middle of what is open of each ghost's pupil, or the nearest to it
    // that arrives; at as many angles as linear interpolation needs to be right to 1 %. Then scales
    // the colours by what share of the beam of linear optics exact rays find open
    // (matrix_efficiency.h), so that ghosts have the energy of exact rays where those of linear
    // optics pass apertures that they should not. Uses several threads.
    MatrixColors(const Lens& lens, const Iris& iris, std::span<const MatrixPath> paths);

    // Of one ghost for light at this angle from the axis.
    std::array<double, 3> at(std::size_t ghost, double angle_rad) const noexcept;
    // T_0 as RGB.
    std::array<double, 3> axial_transmission() const noexcept { return axial_; }

  private:
    struct Table {
        double nodes_per_rad = 0;
        std::array<float, 3> rgb[kNodes] = {};
    };
    std::vector<Table> tables_;
    std::array<double, 3> axial_ = {};
};

}  // namespace aureole::lens
