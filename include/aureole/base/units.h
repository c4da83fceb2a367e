// Constants and conversions of units. Names of quantities carry their unit as a suffix
// everywhere: _deg, _rad, _nm, _mm, _cd_m2, _sr.
#pragma once

namespace aureole {

inline constexpr double kPi = 3.14159265358979323846;

constexpr double rad_from_deg(double angle_deg) { return angle_deg * (kPi / 180.0); }
constexpr double deg_from_rad(double angle_rad) { return angle_rad * (180.0 / kPi); }
constexpr double mm_from_nm(double length_nm) { return length_nm * 1e-6; }
constexpr double mm_from_um(double length_um) { return length_um * 1e-3; }

}  // namespace aureole
