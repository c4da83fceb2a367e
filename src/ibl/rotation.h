// Mirroring and turning as a matrix.
#pragma once

#include <array>

#include "aureole/ibl/environment_transform.h"

namespace aureole::ibl {

class Rotation {
  public:
    // Throws InvalidArgument for fields of `transform` out of range, all of them.
    explicit Rotation(const EnvironmentTransform& transform);

    Direction apply(const Direction& d) const { return {row(0, d), row(1, d), row(2, d)}; }
    // Where what is now seen in direction d was before.
    Direction undo(const Direction& d) const { return {column(0, d), column(1, d), column(2, d)}; }
    // Every axis goes to an axis: true, exactly, for multiples of 90 deg.
    bool is_permutation() const;
    bool is_identity() const;

  private:
    double row(int i, const Direction& d) const {
        const auto& m = matrix_[static_cast<std::size_t>(i)];
        return m[0] * d.x + m[1] * d.y + m[2] * d.z;
    }
    double column(int i, const Direction& d) const {
        const auto k = static_cast<std::size_t>(i);
        return matrix_[0][k] * d.x + matrix_[1][k] * d.y + matrix_[2][k] * d.z;
    }
    std::array<std::array<double, 3>, 3> matrix_ = {};
};

}  // namespace aureole::ibl
