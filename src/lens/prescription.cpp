#include "aureole/lens/prescription.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "aureole/base/error.h"
#include "aureole/lens/glass.h"

namespace aureole::lens {
namespace {

constexpr std::size_t kMaxAsphereTerms = 7;
// How far a printed n_d may be from the catalogue's of the glass that is named beside it: melts
// differ in the fourth decimal, old and new types of one name in the third.
constexpr double kGlassIndexTolerance = 2e-3;

[[noreturn]] void reject(std::size_t row, const char* field, double value, const char* allowed) {
    throw InvalidArgument(fmt::format("surface {}: {}", row, field), fmt::format("{}", value),
                          allowed);
}

void check_glass(const Surface& s, std::size_t row) {
    if (s.glass.empty()) return;
    const Glass* glass = find_glass(s.glass);
    if (!glass) {
        throw InvalidArgument(fmt::format("surface {}: glass", row), s.glass,
                              "must be a glass of the catalogue, or be given by index and Abbe "
                              "number instead");
    }
    if (std::abs(glass->index_d() - s.index) > kGlassIndexTolerance) {
        reject(row, "index", s.index,
               fmt::format("must be that of its glass, {} of {}", glass->index_d(), glass->name)
                   .c_str());
    }
}

void check_surface(const Surface& s, std::size_t row, bool last) {
    if (!std::isfinite(s.radius_mm)) {
        reject(row, "radius_mm", s.radius_mm, "must be finite, 0 for flat");
    }
    if (!std::isfinite(s.thickness_mm) || (!last && s.thickness_mm < 0)) {
        reject(row, "thickness_mm", s.thickness_mm,
               last ? "must be finite" : "must be finite and not negative");
    }
    if (!(s.index >= 1 && s.index <= 5)) reject(row, "index", s.index, "must be in [1, 5]");
    if (s.abbe != 0 && !(s.abbe >= 5 && s.abbe <= 150)) {
        reject(row, "abbe", s.abbe, "must be in [5, 150], or 0 where it is unknown");
    }
    check_glass(s, row);
    if (!(s.semi_aperture_mm > 0) || !std::isfinite(s.semi_aperture_mm)) {
        reject(row, "semi_aperture_mm", s.semi_aperture_mm, "must be positive and finite");
    }
    if (!std::isfinite(s.conic)) reject(row, "conic", s.conic, "must be finite");
    if (s.asphere.size() > kMaxAsphereTerms) {
        reject(row, "number of asphere coefficients", static_cast<double>(s.asphere.size()),
               "must be at most 7, of r^4 to r^16");
    }
    for (const double coefficient : s.asphere) {
        if (!std::isfinite(coefficient)) reject(row, "asphere", coefficient, "must be finite");
    }
}

void check_stop(const std::vector<Surface>& surfaces) {
    const auto is_stop = [](const Surface& s) { return s.stop; };
    const auto stop = std::find_if(surfaces.begin(), surfaces.end(), is_stop);
    if (stop == surfaces.end()) {
        throw InvalidArgument("number of stops", "0", "must be 1: no surface has stop = true");
    }
    const auto row = static_cast<std::size_t>(stop - surfaces.begin()) + 1;
    const auto second = std::find_if(stop + 1, surfaces.end(), is_stop);
    if (second != surfaces.end()) {
        throw InvalidArgument(
            fmt::format("number of stops (surfaces {} and {})", row, second - surfaces.begin() + 1),
            fmt::format("{}", std::count_if(stop, surfaces.end(), is_stop)), "must be 1");
    }
    if (stop->radius_mm != 0) {
        reject(row, "radius_mm of the stop", stop->radius_mm, "must be 0, flat");
    }
    if (stop->conic != 0 || !stop->asphere.empty()) {
        throw InvalidArgument(fmt::format("surface {}", row), "stop with a conic or an asphere",
                              "the stop must be flat");
    }
    const double before = stop == surfaces.begin() ? 1.0 : (stop - 1)->index;
    const std::string glass = stop == surfaces.begin() ? std::string() : (stop - 1)->glass;
    if (before != stop->index || glass != stop->glass) {
        reject(row, "index behind the stop", stop->index,
               fmt::format("must be that in front of it, {}", before).c_str());
    }
}

void check_position(const Position& position, std::size_t rows) {
    const std::string where = fmt::format("position \"{}\": ", position.name);
    const auto refuse = [&](const std::string& what, double value, const char* allowed) {
        throw InvalidArgument(where + what, fmt::format("{}", value), allowed);
    };
    if (position.name.empty()) {
        throw InvalidArgument("name of a position", "\"\"", "must not be empty");
    }
    if (!(position.focal_length_mm > 0) || !std::isfinite(position.focal_length_mm)) {
        refuse("focal_length_mm", position.focal_length_mm, "must be positive and finite");
    }
    if (!(position.f_number >= 0) || !std::isfinite(position.f_number)) {
        refuse("f_number", position.f_number, "must be positive and finite, or 0 if not stated");
    }
    if (!(position.field_deg >= 0 && position.field_deg < 360)) {
        refuse("field_deg", position.field_deg, "must be in (0, 360), or 0 if not stated");
    }
    std::set<int> seen;
    for (const Position::Gap& gap : position.gaps) {
        if (gap.surface < 1 || static_cast<std::size_t>(gap.surface) > rows) {
            refuse("gap behind surface", gap.surface,
                   fmt::format("must be a surface, 1 to {}", rows).c_str());
        }
        if (!seen.insert(gap.surface).second) {
            refuse("gap behind surface", gap.surface, "must be given once");
        }
        const bool last = static_cast<std::size_t>(gap.surface) == rows;
        if (!std::isfinite(gap.thickness_mm) || (!last && gap.thickness_mm < 0)) {
            refuse(fmt::format("surface {}: thickness_mm", gap.surface), gap.thickness_mm,
                   last ? "must be finite" : "must be finite and not negative");
        }
    }
}

}  // namespace

void validate(const Prescription& prescription) {
    const std::vector<Surface>& surfaces = prescription.surfaces;
    if (surfaces.size() < 2 || surfaces.size() > static_cast<std::size_t>(kMaxSurfaces)) {
        throw InvalidArgument("number of surfaces", fmt::format("{}", surfaces.size()),
                              fmt::format("must be 2 to {}", kMaxSurfaces));
    }
    const std::pair<const char*, double> stated[] = {
        {"focal_length_mm", prescription.focal_length_mm}, {"f_number", prescription.f_number}};
    for (const auto& [what, value] : stated) {
        if (!(value >= 0) || !std::isfinite(value)) {
            throw InvalidArgument(what, fmt::format("{}", value),
                                  "must be positive and finite, or 0 if not stated");
        }
    }
    if (!(prescription.field_deg >= 0 && prescription.field_deg < 360)) {
        throw InvalidArgument("field_deg", fmt::format("{}", prescription.field_deg),
                              "must be in (0, 360), or 0 if not stated");
    }
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        check_surface(surfaces[i], i + 1, i + 1 == surfaces.size());
    }
    if (surfaces.back().index != 1 || !surfaces.back().glass.empty()) {
        reject(surfaces.size(), "index behind the last surface", surfaces.back().index,
               "must be 1, air");
    }
    check_stop(surfaces);
    std::set<std::string> names;
    for (const Position& position : prescription.positions) {
        check_position(position, surfaces.size());
        if (!names.insert(position.name).second) {
            throw InvalidArgument("name of a position", position.name, "must be given once");
        }
    }
}

Prescription at_position(const Prescription& prescription, const std::string& name) {
    Prescription at = prescription;
    at.positions.clear();
    const auto& positions = prescription.positions;
    const auto named = std::find_if(positions.begin(), positions.end(),
                                    [&](const Position& p) { return p.name == name; });
    const bool found = named != positions.end();
    if (!found && !name.empty()) {
        std::string allowed = "this lens has no positions";
        for (const Position& p : positions) {
            allowed = (&p == positions.data() ? "must be one of " : allowed + ", ") + p.name;
        }
        throw InvalidArgument("position", name, allowed);
    }
    if (positions.empty()) return at;
    const Position& position = found ? *named : positions.front();
    at.focal_length_mm = position.focal_length_mm;
    at.f_number = position.f_number;
    at.field_deg = position.field_deg;
    for (const Position::Gap& gap : position.gaps) {
        if (gap.surface < 1 || static_cast<std::size_t>(gap.surface) > at.surfaces.size()) {
            throw InvalidArgument(fmt::format("position \"{}\": gap behind surface", position.name),
                                  fmt::format("{}", gap.surface),
                                  fmt::format("must be a surface, 1 to {}", at.surfaces.size()));
        }
        at.surfaces[static_cast<std::size_t>(gap.surface) - 1].thickness_mm = gap.thickness_mm;
    }
    return at;
}

}  // namespace aureole::lens
