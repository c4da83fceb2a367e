#include "aureole/lens/glass.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aureole::lens {
namespace {

constexpr Glass kCatalogue[] = {
#include "lens/glass_catalogue.inc"
};

// Other names by which design programs know a glass.
constexpr std::pair<std::string_view, std::string_view> kAliases[] = {
    {"SILICA", "FUSED-SILICA"}, {"F_SILICA", "FUSED-SILICA"}, {"CAF2_SPECIAL", "CAF2"}};

constexpr double square(double x) { return x * x; }

bool same_letters(std::string_view a, std::string_view b) {
    // Not std::toupper, which follows the locale.
    const auto upper = [](char c) { return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](char x, char y) { return upper(x) == upper(y); });
}

}  // namespace

double cauchy_index(double index_d, double abbe, double wavelength_nm) {
    if (abbe == 0) return index_d;
    const double b = (index_d - 1) / abbe / (1 / square(kLineFNm) - 1 / square(kLineCNm));
    return index_d + b * (1 / square(wavelength_nm) - 1 / square(kLineDNm));
}

double Glass::index(double wavelength_nm) const {
    const double lambda2 = square(wavelength_nm / 1000);
    double n2 = 1;
    for (std::size_t i = 0; i < b.size(); ++i) n2 += b[i] * lambda2 / (lambda2 - c_um2[i]);
    return std::sqrt(n2);
}

double Glass::abbe() const { return (index_d() - 1) / (index(kLineFNm) - index(kLineCNm)); }

std::span<const Glass> glass_catalogue() { return kCatalogue; }

const Glass* find_glass(std::string_view name) {
    for (const auto& [alias, own] : kAliases) {
        if (same_letters(alias, name)) name = own;
    }
    for (const Glass& glass : kCatalogue) {
        if (same_letters(glass.name, name)) return &glass;
    }
    // The "N-" of Schott's glasses without lead; where both are made, the plain name is the older.
    for (const Glass& glass : kCatalogue) {
        if (glass.name.starts_with("N-") && same_letters(glass.name.substr(2), name)) return &glass;
    }
    return nullptr;
}

}  // namespace aureole::lens
