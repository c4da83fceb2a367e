#include "lens/imported_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/lens/lens.h"
#include "aureole/lens/paraxial.h"

namespace aureole::lens {
namespace {

// Slow enough for the exactly traced ray with which Lens solves the stop to be a paraxial one.
constexpr double kSlowFNumber = 1000;
constexpr double kWideSemiApertureMm = 1e4;
// Paraxial slopes of wider fields say nothing about where rays go.
constexpr double kWidestHalfFieldDeg = 75;
// Glass reaches beyond the beam: aberrations make the real one wider than the paraxial.
constexpr double kApertureMargin = 1.05;

std::string without_dashes(std::string_view name) {
    std::string plain = upper_case(name);
    plain.erase(std::remove(plain.begin(), plain.end(), '-'), plain.end());
    return plain;
}

void give_stop_its_row(Prescription& lens, const std::string& file) {
    auto& rows = lens.surfaces;
    const auto stop = std::find_if(rows.begin(), rows.end(), [](auto& s) { return s.stop; });
    if (stop == rows.end()) return;  // validate() says so
    const auto at = static_cast<std::size_t>(stop - rows.begin());
    const bool air_before = at == 0 || (stop - 1)->index == 1;
    const bool air_behind = stop->index == 1;
    if (air_before && air_behind) {
        if (stop->radius_mm != 0 || stop->conic != 0 || !stop->asphere.empty()) {
            lens.warnings.push_back(
                fmt::format("surface {}: the stop is curved: taken as flat", at + 1));
            stop->radius_mm = stop->conic = 0;
            stop->asphere.clear();
        }
        return;
    }
    if (!air_before && !air_behind) {
        Place{file, 0, at + 1}.fail(
            "the stop lies on a cemented face: it must have air on one side at least");
    }
    Surface row;
    row.stop = true;
    row.semi_aperture_mm = stop->semi_aperture_mm;
    stop->stop = false;
    if (!air_before) row.thickness_mm = std::exchange(stop->thickness_mm, 0);
    rows.insert(air_before ? stop : stop + 1, row);
    lens.warnings.push_back(
        fmt::format("surface {}: the stop lies on a face of glass: made a flat row of its own "
                    "{} it, at no distance, so that rows from there on count one more",
                    at + 1, air_before ? "in front of" : "behind"));
}

// The lens with nothing but its focal length and ray heights right.
Lens slow_lens(Prescription lens) {
    for (Surface& s : lens.surfaces) {
        s.semi_aperture_mm = s.radius_mm == 0 ? kWideSemiApertureMm : std::abs(s.radius_mm);
    }
    lens.f_number = kSlowFNumber;
    return Lens(lens, {.coating = "none"});
}

void estimate_apertures(Prescription& lens, const Lens& optics, double entrance_pupil_mm,
                        double half_field_deg) {
    const GhostMatrices direct = ghost_matrices(optics, Bounces{}, kLineDNm);
    const auto stop =
        std::find_if(direct.crossings.begin(), direct.crossings.end(),
                     [&](const CrossingMatrix& c) { return c.face == optics.stop(); });
    // The principal ray enters at this height per slope, and so meets the centre of the stop.
    const double entrance = -stop->matrix.y.b / stop->matrix.y.a;
    const double slope = std::tan(rad_from_deg(std::min(half_field_deg, kWidestHalfFieldDeg)));
    std::string list;
    for (const CrossingMatrix& crossing : direct.crossings) {
        Surface& s = lens.surfaces[static_cast<std::size_t>(crossing.face)];
        if (s.semi_aperture_mm != 0) continue;
        const double marginal = crossing.matrix.y.a * entrance_pupil_mm / 2;
        const double principal =
            s.stop ? 0 : (crossing.matrix.y.a * entrance + crossing.matrix.y.b) * slope;
        const double height =
            (s.stop ? 1 : kApertureMargin) * (std::abs(marginal) + std::abs(principal));
        s.semi_aperture_mm = s.radius_mm == 0 ? height : std::min(height, std::abs(s.radius_mm));
        list += fmt::format("{}{} ({:.3g})", list.empty() ? "" : ", ", crossing.face + 1,
                            s.semi_aperture_mm);
    }
    lens.warnings.push_back(fmt::format(
        "no semi-apertures given: estimated from the paraxial beam{}, mm at surface: {}",
        half_field_deg > 0 ? "" : " on the axis, as no field angle is given", list));
}

}  // namespace

// CODE V writes glasses without dashes, and their maker behind an underscore.
const Glass* find_program_glass(std::string_view name) {
    if (const Glass* glass = find_glass(name)) return glass;
    const std::string_view plain = name.substr(0, name.find('_'));
    if (const Glass* glass = find_glass(plain)) return glass;
    for (const Glass& glass : glass_catalogue()) {
        if (without_dashes(glass.name) == without_dashes(plain)) return &glass;
    }
    return nullptr;
}

void set_glass(Surface& surface, std::string_view name, const Place& place) {
    const Glass* glass = find_program_glass(name);
    if (!glass) {
        place.fail("glass", name,
                   "must be a glass of the catalogue (docs/lenses.md), or be given by its index "
                   "and Abbe number");
    }
    surface.glass = glass->name;
    surface.index = glass->index_d();
    surface.abbe = glass->abbe();
}

void scale(Surface& surface, double mm_per_unit) {
    surface.radius_mm *= mm_per_unit;
    surface.thickness_mm *= mm_per_unit;
    surface.semi_aperture_mm *= mm_per_unit;
    double per_power = 1 / (mm_per_unit * mm_per_unit * mm_per_unit);
    for (double& coefficient : surface.asphere) {
        coefficient *= per_power;
        per_power /= mm_per_unit * mm_per_unit;
    }
}

Prescription finished(ImportedTable table, const std::string& file) {
    Prescription& lens = table.lens;
    give_stop_its_row(lens, file);
    const auto missing = std::find_if(lens.surfaces.begin(), lens.surfaces.end(),
                                      [](auto& s) { return s.semi_aperture_mm == 0; });
    const bool estimate = missing != lens.surfaces.end();
    if (!estimate && table.entrance_pupil_mm == 0) return checked(std::move(lens), file);

    Prescription rough = lens;
    for (Surface& s : rough.surfaces) {
        if (s.semi_aperture_mm == 0) s.semi_aperture_mm = 1;
    }
    rough = checked(std::move(rough), file);
    const Place place{file, 0, static_cast<std::size_t>(missing - lens.surfaces.begin()) + 1};
    if (estimate && table.entrance_pupil_mm == 0 && lens.f_number == 0) {
        place.fail("semi-aperture", "missing",
                   "must be given, or an entrance pupil or f-number to estimate it from");
    }
    try {
        const Lens optics = slow_lens(std::move(rough));
        const double efl_mm = cardinal_points(optics, kLineDNm).efl_mm;
        if (table.entrance_pupil_mm == 0) table.entrance_pupil_mm = efl_mm / lens.f_number;
        lens.f_number = efl_mm / table.entrance_pupil_mm;
        if (estimate) {
            estimate_apertures(lens, optics, table.entrance_pupil_mm, table.half_field_deg);
        }
    } catch (const InvalidArgument& error) {
        // No camera lens (afocal, or one that diverges): its table is still a table.
        if (estimate) place.fail(fmt::format("semi-aperture is missing: {}", error.what()));
    }
    return checked(std::move(lens), file);
}

}  // namespace aureole::lens
