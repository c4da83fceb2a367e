#include "aureole/lens/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/lens/glass.h"
#include "aureole/lens/lens.h"
#include "aureole/lens/paraxial.h"
#include "aureole/lens/trace.h"
#include "lens/sag.h"

namespace aureole::lens {
namespace {

constexpr double kFocalLengthTolerance = 0.02;
constexpr double kFNumberTolerance = 0.05;
constexpr double kBackFocusTolerance = 0.02;  // of the focal length
constexpr int kSagSamples = 64;
constexpr double kMeetMm = 1e-3;         // surfaces that touch do not cross
constexpr double kDarkTolerance = 0.01;  // tables round clear apertures
// Slow enough that every lens passes its ray: for what does not depend on the f-number.
constexpr double kSlowFNumber = 1000;

using Kind = Finding::Kind;

class Checker {
  public:
    explicit Checker(const Prescription& prescription)
        : table_(at_position(prescription, "")), lens_(at_f_number(kSlowFNumber)) {}

    std::vector<Finding> run() && {
        check_focal_length();
        check_f_number();
        check_apertures();
        check_crossings();
        check_diameters();
        check_back_focus();
        check_axial_beam();
        check_dispersion();
        for (const std::string& warning : table_.warnings) add(Kind::kParser, 0, warning);
        return std::move(findings_);
    }

  private:
    void add(Kind kind, std::size_t surface, std::string text) {
        findings_.push_back({kind, static_cast<int>(surface), std::move(text)});
    }

    Lens at_f_number(double f_number) const {
        return Lens(table_, {.f_number = f_number, .coating = "none"});
    }

    // Of the stop as printed; where rays from its edge are lost in the glass, paraxially.
    double f_number_as_printed() const {
        return printed_f_number(lens_).value_or(paraxial_printed_f_number(lens_));
    }
    std::string printed_f_number_text() const {
        const auto exact = printed_f_number(lens_);
        const double paraxial = paraxial_printed_f_number(lens_);
        return exact ? fmt::format("f/{:.2f} (paraxially f/{:.2f})", *exact, paraxial)
                     : fmt::format("f/{:.2f} paraxially", paraxial);
    }

    void check_focal_length() {
        const double stated = table_.focal_length_mm;
        if (stated == 0) return;
        const double off = lens_.efl_mm() / stated - 1;
        if (std::abs(off) <= kFocalLengthTolerance) return;
        add(Kind::kFocalLength, 0,
            fmt::format("the surfaces give a focal length of {:.2f} mm, {:+.1f} % from the stated "
                        "{:g} mm: a radius, gap or index may be wrong, or the stated one is only "
                        "nominal",
                        lens_.efl_mm(), 100 * off, stated));
    }

    void check_f_number() {
        const double stated = table_.f_number;
        if (stated == 0) return;
        const double printed = f_number_as_printed();
        if (std::abs(printed / stated - 1) <= kFNumberTolerance) return;
        const auto row = static_cast<std::size_t>(lens_.stop());
        std::string text = fmt::format(
            "the stop as printed, semi-aperture {:g} mm, gives {}, not the stated f/{:g}",
            table_.surfaces[row].semi_aperture_mm, printed_f_number_text(), stated);
        try {
            const double needed = at_f_number(stated).stop_radius_mm();
            text +=
                fmt::format(", which needs {:.2f} mm, a diameter of {:.1f} mm", needed, 2 * needed);
            const double nominal = table_.focal_length_mm;
            if (nominal > 0 && std::abs(lens_.efl_mm() / nominal - 1) > kFocalLengthTolerance) {
                const double radius =
                    at_f_number(lens_.efl_mm() * stated / nominal).stop_radius_mm();
                text += fmt::format(
                    " (with the stated {:g} mm, and so an effective aperture of {:.3g} mm: "
                    "{:.2f} mm, a diameter of {:.1f} mm)",
                    nominal, nominal / stated, radius, 2 * radius);
            }
            text += printed > stated ? ": the printed one is a guess, or of another position"
                                     : ": the printed one may be that of the housing";
        } catch (const InvalidArgument&) {
            text += ", at which rays from the edge of the entrance do not get through the glass";
        }
        add(Kind::kFNumber, row + 1, text + "; the stop is solved from the f-number, not printed");
    }

    void check_apertures() {
        for (std::size_t k = 0; k < table_.surfaces.size(); ++k) {
            const Surface& s = table_.surfaces[k];
            const double clipped = lens_.faces()[k].semi_aperture_mm;
            if (s.stop || clipped >= s.semi_aperture_mm) continue;
            add(Kind::kSemiAperture, k + 1,
                fmt::format("semi-aperture {:g} mm is larger than the surface of radius {:g} mm "
                            "reaches: clipped to {:.4g} mm",
                            s.semi_aperture_mm, s.radius_mm, clipped));
        }
    }

    // Height above the vertex plane; nullopt beyond the end of the surface.
    static std::optional<double> sag(const Face& face, double x_mm, double y_mm) {
        const auto hit = intersect(face, {x_mm, y_mm, 0}, {0, 0, 1});
        return hit ? std::optional(hit->point[2]) : std::nullopt;
    }

    // Distance from the axis at which two faces first meet inside both clear apertures.
    static std::optional<double> meeting_point(const Face& front, const Face& back, double shrink) {
        const double reach = shrink * std::min(front.semi_aperture_mm, back.semi_aperture_mm);
        for (int i = 1; i <= kSagSamples; ++i) {
            const double r = reach * i / kSagSamples;
            // Along both axes, for cylinders.
            for (const auto& [x, y] : {std::pair(r, 0.0), std::pair(0.0, r)}) {
                const auto before = sag(front, x, y);
                const auto after = sag(back, x, y);
                if (before && after && back.z_mm + *after < front.z_mm + *before - kMeetMm) {
                    return r;
                }
            }
        }
        return std::nullopt;
    }

    // Pairs of neighbours, the stop not counted: it is a plane without matter, and tables put it
    // wherever it is convenient.
    template <class Visit>
    void each_pair(const Visit& visit) const {
        std::optional<std::size_t> previous;
        for (std::size_t k = 0; k < lens_.faces().size(); ++k) {
            if (lens_.faces()[k].stop) continue;
            if (previous) visit(*previous, k);
            previous = k;
        }
    }

    void check_crossings() {
        each_pair([&](std::size_t k, std::size_t next) {
            const auto r = meeting_point(lens_.faces()[k], lens_.faces()[next], 1);
            if (!r) return;
            add(Kind::kCrossing, k + 1,
                fmt::format("meets surface {} {:.3g} mm from the axis, inside their clear "
                            "apertures of {:g} and {:g} mm",
                            next + 1, *r, table_.surfaces[k].semi_aperture_mm,
                            table_.surfaces[next].semi_aperture_mm));
        });
    }

    // Diameters read as radii show in two ways: the stop gives half the stated f-number, and faces
    // end or meet inside their apertures that do not at half the size.
    void check_diameters() {
        int healed = 0;
        int pairs = 0;
        each_pair([&](std::size_t k, std::size_t next) {
            ++pairs;
            const Face& front = lens_.faces()[k];
            const Face& back = lens_.faces()[next];
            // The faces of lens_ are clipped already: what was clipped is broken as it stands.
            const auto ends = [&](std::size_t i) {
                return lens_.faces()[i].semi_aperture_mm < table_.surfaces[i].semi_aperture_mm;
            };
            const bool broken = ends(k) || ends(next) || meeting_point(front, back, 1);
            healed += broken && !meeting_point(front, back, 0.5) ? 1 : 0;
        });
        // Paraxial f-numbers are halved by twice the stop exactly.
        const double printed = paraxial_printed_f_number(lens_);
        const double ratio = table_.f_number == 0 ? 0 : printed / table_.f_number;
        const bool half = ratio > 0.4 && ratio < 0.6;
        const bool crowded = healed >= 2 && 4 * healed >= pairs;
        if (!half && !(crowded && (ratio == 0 || ratio < 0.8))) return;
        std::string text = "the semi-apertures look like diameters: ";
        if (half) {
            text += fmt::format("the stop gives f/{:.2f} paraxially, about half the stated f/{:g}",
                                printed, table_.f_number);
        }
        if (crowded) {
            text += fmt::format(
                "{}{} of {} pairs of faces end or meet inside them and would not "
                "at half the size",
                half ? "; " : "", healed, pairs);
        }
        add(Kind::kDiameters, 0, std::move(text));
    }

    void check_back_focus() {
        const double printed = table_.surfaces.back().thickness_mm;
        if (printed == 0) return;
        const double computed = cardinal_points(lens_, kLineDNm).bfd_mm;
        if (std::abs(printed - computed) <= kBackFocusTolerance * lens_.efl_mm()) return;
        add(Kind::kBackFocus, table_.surfaces.size(),
            fmt::format("the printed gap to the sensor, {:g} mm, is {:+.2f} mm off the computed "
                        "back focal distance {:.2f} mm, where the sensor is put",
                        printed, printed - computed, computed));
    }

    void check_axial_beam() {
        const double f_number = table_.f_number != 0 ? table_.f_number : f_number_as_printed();
        const double entrance = lens_.efl_mm() / (2 * f_number);
        std::vector<Vector> path;
        Tracer(lens_, kLineDNm).trace(Bounces{}, ray_from_light(0, 0, entrance, 0), &path);
        double worst = 1 + kDarkTolerance;
        std::size_t at = 0;
        for (std::size_t k = 0; k < lens_.faces().size() && k + 1 < path.size(); ++k) {
            const Face& face = lens_.faces()[k];
            const double ratio = std::abs(path[k + 1][0]) / face.semi_aperture_mm;
            if (face.stop || ratio <= worst) continue;
            worst = ratio;
            at = k + 1;
        }
        if (at == 0) return;
        add(Kind::kTooDark, at,
            fmt::format("limits the beam on the axis: at f/{:.3g} its edge passes {:.2f} mm from "
                        "the axis, outside the semi-aperture of {:.4g} mm",
                        f_number, worst * lens_.faces()[at - 1].semi_aperture_mm,
                        lens_.faces()[at - 1].semi_aperture_mm));
    }

    void check_dispersion() {
        std::vector<std::size_t> rows;
        for (std::size_t k = 0; k < table_.surfaces.size(); ++k) {
            const Surface& s = table_.surfaces[k];
            if (s.index != 1 && s.abbe == 0 && s.glass.empty()) rows.push_back(k + 1);
        }
        if (rows.empty()) return;
        add(Kind::kNoDispersion, rows.size() == 1 ? rows[0] : 0,
            fmt::format("no Abbe number behind surface{} {}: taken as without dispersion, so "
                        "ghosts have no colour from the glass",
                        rows.size() == 1 ? "" : "s", fmt::join(rows, ", ")));
    }

    Prescription table_;
    Lens lens_;
    std::vector<Finding> findings_;
};

}  // namespace

const char* name_of(Finding::Kind kind) {
    switch (kind) {
        case Kind::kFocalLength:
            return "focal-length";
        case Kind::kFNumber:
            return "f-number";
        case Kind::kSemiAperture:
            return "semi-aperture";
        case Kind::kCrossing:
            return "crossing";
        case Kind::kNoDispersion:
            return "no-dispersion";
        case Kind::kDiameters:
            return "diameters";
        case Kind::kBackFocus:
            return "back-focus";
        case Kind::kTooDark:
            return "too-dark";
        case Kind::kParser:
            return "parser";
    }
    return "";
}

std::vector<Finding> check(const Prescription& prescription) {
    validate(prescription);
    return Checker(prescription).run();
}

}  // namespace aureole::lens
