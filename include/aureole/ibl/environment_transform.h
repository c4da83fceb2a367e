// What is done to an environment while it is read: turned, mirrored, made brighter, cleaned.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

// The axis that changes its sign.
enum class Mirror { kNone, kX, kY, kZ };

// The names of the command line, in the order of the enumeration.
inline constexpr std::array<std::string_view, 4> kMirrorNames = {"none", "x", "y", "z"};

struct EnvironmentTransform {
    // First mirrored, then turned about +Z (roll), then about +X (pitch), then about +Y (yaw); all
    // by the rule of the right hand. What was at +Z is at +X after yaw 90, at -Y after pitch 90;
    // what was at +X is at +Y after roll 90. Any finite angle.
    Mirror mirror = Mirror::kNone;
    double roll_deg = 0;
    double pitch_deg = 0;
    double yaw_deg = 0;

    // All values are multiplied by 2^exposure_ev, [-64, 64]; what would exceed the range of
    // floats becomes the largest float.
    double exposure_ev = 0;
    // After exposure, texels of more luminance (color/rgb.h) are scaled down to it: their hue
    // stays, their energy does not. > 0; empty: off.
    std::optional<double> max_luminance = {};
};

struct EnvironmentReport {
    std::size_t nonfinite_texels = 0;  // had a NaN or an infinity, which became 0
    std::size_t clamped_texels = 0;    // were brighter than max_luminance
    // The share of the environment's energy (luminance times solid angle) that clamping took.
    double clamped_share = 0;
};

// Where something seen in `direction` is seen after mirroring and turning. Throws InvalidArgument
// for fields out of range, as does everything that takes a transform.
Direction transformed(const Direction& direction, const EnvironmentTransform& transform);

}  // namespace aureole::ibl
