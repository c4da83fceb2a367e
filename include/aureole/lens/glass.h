// How the index of a medium depends on the wavelength.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace aureole::lens {

inline constexpr double kLineDNm = 587.5618;  // helium d: where prescriptions state their index
inline constexpr double kLineFNm = 486.1327;  // hydrogen F
inline constexpr double kLineCNm = 656.2725;  // hydrogen C

// n(lambda) = A + B / lambda^2 (Cauchy 1836), through n_d with the slope of the Abbe number
// V_d = (n_d - 1) / (n_F - n_C). abbe = 0: constant n_d.
double cauchy_index(double index_d, double abbe, double wavelength_nm);

// A glass of the catalogue: n^2 - 1 = sum of B_i lambda^2 / (lambda^2 - C_i), lambda in um
// (Sellmeier 1871), with coefficients from its maker's data sheet.
struct Glass {
    std::string_view name;    // the maker's: "N-BK7"
    std::string_view source;  // maker and catalogue
    std::array<double, 3> b = {};
    std::array<double, 3> c_um2 = {};

    double index(double wavelength_nm) const;
    double index_d() const { return index(kLineDNm); }
    double abbe() const;
};

std::span<const Glass> glass_catalogue();
// By name, upper or lower case; "BK7" also finds "N-BK7" (but "SF6", which is made with and without
// lead, the leaded one), "SILICA" fused silica. nullptr if it is not there.
const Glass* find_glass(std::string_view name);

}  // namespace aureole::lens
