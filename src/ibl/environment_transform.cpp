#include "aureole/ibl/environment_transform.h"

#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "ibl/rotation.h"

namespace aureole::ibl {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix out = {};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 3; ++k) out[i][j] += a[i][k] * b[k][j];
        }
    }
    return out;
}

// Sine and cosine of an angle in degrees, exact for multiples of 90.
struct Turn {
    explicit Turn(double angle_deg) {
        const double quarters = std::round(angle_deg / 90);
        const double rest_rad = rad_from_deg(angle_deg - 90 * quarters);
        double s = std::sin(rest_rad);
        double c = std::cos(rest_rad);
        const int quarter = static_cast<int>(quarters - 4 * std::floor(quarters / 4));
        for (int i = 0; i < quarter; ++i) {
            const double next = c;
            c = -s;
            s = next;
        }
        sine = s;
        cosine = c;
    }
    double sine = 0;
    double cosine = 1;
};

// About axis `axis`, from the axis after it towards the one after that.
Matrix turned_about(std::size_t axis, double angle_deg) {
    const Turn turn(angle_deg);
    const std::size_t from = (axis + 1) % 3;
    const std::size_t to = (axis + 2) % 3;
    Matrix m = {};
    m[axis][axis] = 1;
    m[from][from] = turn.cosine;
    m[to][from] = turn.sine;
    m[from][to] = -turn.sine;
    m[to][to] = turn.cosine;
    return m;
}

void check(const EnvironmentTransform& transform) {
    const auto finite = [](const char* name, double angle_deg) {
        if (!std::isfinite(angle_deg)) {
            throw InvalidArgument(name, std::to_string(angle_deg), "must be a finite angle");
        }
    };
    finite("roll_deg", transform.roll_deg);
    finite("pitch_deg", transform.pitch_deg);
    finite("yaw_deg", transform.yaw_deg);
    if (!(std::abs(transform.exposure_ev) <= 64)) {
        throw InvalidArgument("exposure_ev", std::to_string(transform.exposure_ev),
                              "must be in [-64, 64]");
    }
    if (transform.max_luminance && !(*transform.max_luminance > 0)) {
        throw InvalidArgument("max_luminance", std::to_string(*transform.max_luminance),
                              "must be above 0");
    }
}

}  // namespace

Rotation::Rotation(const EnvironmentTransform& transform) {
    check(transform);
    Matrix mirror = {};
    for (std::size_t i = 0; i < 3; ++i) {
        mirror[i][i] = static_cast<std::size_t>(transform.mirror) == i + 1 ? -1 : 1;
    }
    matrix_ = product(turned_about(1, transform.yaw_deg),
                      product(turned_about(0, transform.pitch_deg),
                              product(turned_about(2, transform.roll_deg), mirror)));
}

bool Rotation::is_permutation() const {
    for (const auto& row : matrix_) {
        for (const double v : row) {
            if (v != 0 && std::abs(v) != 1) return false;
        }
    }
    return true;
}

bool Rotation::is_identity() const {
    return is_permutation() && matrix_[0][0] == 1 && matrix_[1][1] == 1 && matrix_[2][2] == 1;
}

Direction transformed(const Direction& direction, const EnvironmentTransform& transform) {
    return Rotation(transform).apply(direction);
}

}  // namespace aureole::ibl
