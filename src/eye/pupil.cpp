#include "aureole/eye/pupil.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/eye/ranges.h"

namespace aureole::eye {
namespace {

constexpr double kSphereDeg2 = 41253;
constexpr double kNarrowestMm = 1.2;

constexpr struct {
    std::string_view name;
    PupilModel model;
} kNames[] = {{"watson-yellott", PupilModel::kWatsonYellott},
              {"moon-spencer", PupilModel::kMoonSpencer},
              {"de-groot", PupilModel::kDeGroot},
              {"thesis", PupilModel::kThesis}};

// Watson & Yellott 2012, eqs. 10 (Stanley & Davies 1995), 20 and 21.
double watson_yellott(double luminance_cd_m2, const PupilConditions& conditions) {
    const double flux =
        luminance_cd_m2 * conditions.field_area_deg2 * (conditions.both_eyes ? 1.0 : 0.1);
    const double q = std::pow(flux / 846, 0.41);
    const double unaged = 7.75 - 5.75 * q / (q + 2);
    const double age = std::clamp(conditions.age_years, 20.0, 83.0);
    return unaged + (age - 28.58) * (0.021323 - 0.0095623 * unaged);
}

}  // namespace

PupilModel pupil_model_from_name(std::string_view name) {
    for (const auto& entry : kNames) {
        if (entry.name == name) return entry.model;
    }
    throw InvalidArgument("pupil-model", std::string(name),
                          "must be watson-yellott, moon-spencer, de-groot or thesis");
}

std::string_view name_of(PupilModel model) {
    return std::find_if(std::begin(kNames), std::end(kNames),
                        [&](const auto& entry) { return entry.model == model; })
        ->name;
}

double pupil_diameter_mm(PupilModel model, double luminance_cd_m2,
                         const PupilConditions& conditions) {
    if (!(luminance_cd_m2 >= 0 && luminance_cd_m2 <= kBrightestCdM2)) {
        throw InvalidArgument("adaptation luminance", fmt::format("{}", luminance_cd_m2),
                              fmt::format("must be 0 to {:g} cd/m2", kBrightestCdM2));
    }
    if (!(conditions.age_years >= 1 && conditions.age_years <= 120)) {
        throw InvalidArgument("age", fmt::format("{}", conditions.age_years),
                              "must be 1 to 120 years");
    }
    if (!(conditions.field_area_deg2 > 0 && conditions.field_area_deg2 <= kSphereDeg2)) {
        throw InvalidArgument("field area", fmt::format("{}", conditions.field_area_deg2),
                              "must be in (0, 41253] square degrees");
    }
    const double luminance = std::max(luminance_cd_m2, kDarknessCdM2);
    const double decades = std::log10(luminance);
    switch (model) {
        case PupilModel::kMoonSpencer:
            return 4.9 - 3 * std::tanh(0.4 * decades - 0.00114);
        case PupilModel::kDeGroot: {
            const double x = 7.597 + decades;
            // Without a lower end, the cubic would close the eye in sunlight.
            return std::max(7.175 * std::exp(-0.00092 * x * x * x), kNarrowestMm);
        }
        case PupilModel::kThesis:
            return 4.9 - 3 * std::tanh(0.4 * (decades + 1));
        case PupilModel::kWatsonYellott:
            break;
    }
    return watson_yellott(luminance, conditions);
}

}  // namespace aureole::eye
