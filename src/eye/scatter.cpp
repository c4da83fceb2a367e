#include "aureole/eye/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "eye/quadrature.h"

namespace aureole::eye {
namespace {

constexpr double kInnermostDeg = 1e-6;
constexpr int kIntervalsPerDecade = 64;
constexpr double kHorizonDeg = 90;

template <class Enum>
struct Named {
    std::string_view name;
    Enum value;
};

constexpr Named<Pigmentation> kPigmentations[] = {{"brown", Pigmentation::kBrown},
                                                  {"blue", Pigmentation::kBlue},
                                                  {"dark-brown", Pigmentation::kDarkBrown},
                                                  {"mean", Pigmentation::kMean}};
constexpr Named<ScatterModel> kModels[] = {{"cie", ScatterModel::kCie},
                                           {"ijspeert", ScatterModel::kIjspeert},
                                           {"none", ScatterModel::kNone}};

double square(double x) { return x * x; }
double cube(double x) { return x * x * x; }
double age_factor(double age_years) { return square(square(age_years / 70)); }

// Node i of the scale on which ScatterPsf tabulates its energy.
double node_deg(int i) {
    return kInnermostDeg * std::pow(10.0, static_cast<double>(i) / kIntervalsPerDecade);
}

// integral of f 2 pi sin(theta) d theta over one short interval, d theta = theta d(ln theta).
template <class PerSr>
double integrate_log_interval(const PerSr& per_sr, double from_deg, double to_deg) {
    const auto integrand = [&](double log_angle) {
        const double angle_deg = std::exp(log_angle);
        const double angle_rad = rad_from_deg(angle_deg);
        return per_sr(angle_deg) * 2 * kPi * std::sin(angle_rad) * angle_rad;
    };
    return gauss_legendre(integrand, std::log(from_deg), std::log(to_deg));
}

// The centre is flat on the scale of kInnermostDeg in every model.
template <class PerSr>
double integrate_innermost(const PerSr& per_sr, double from_deg, double to_deg) {
    return per_sr(to_deg) * kPi * (square(rad_from_deg(to_deg)) - square(rad_from_deg(from_deg)));
}

struct IjspeertTerm {
    double weight;
    double width;
};

// c_i and b_i of IJspeert et al. 1993, eqs. 7-8 and table 2.
std::array<IjspeertTerm, 4> ijspeert_terms(double age_years, double pupil_mm, double m) {
    const double af = 1 + age_factor(age_years);
    const double small_angle = 1 / (1 + af / (1 / m - 1));
    const double large_angle = 1 - small_angle;
    const double b = 9000 - 936 * std::sqrt(af);  // per mm
    const double d = 3.2;                         // mm
    const double e = std::sqrt(af) / 2000;
    const double ratio2 = square(pupil_mm / d);
    const double c3 = large_angle / ((1 + 25 * m) * (1 + 1 / af));
    return {{{small_angle / (1 + ratio2), (1 + ratio2) / (b * pupil_mm)},
             {small_angle / (1 + 1 / ratio2), (1 + 1 / ratio2) * (e - 1 / (b * pupil_mm))},
             {c3, 1 / (10 + 60 * m - 5 / af)},
             {large_angle - c3, 1}}};
}

}  // namespace

Pigmentation pigmentation_from_name(std::string_view name) {
    for (const auto& entry : kPigmentations) {
        if (entry.name == name) return entry.value;
    }
    throw InvalidArgument("pigmentation", std::string(name),
                          "must be brown, blue, dark-brown or mean");
}

std::string_view name_of(Pigmentation pigmentation) {
    return std::find_if(std::begin(kPigmentations), std::end(kPigmentations),
                        [&](const auto& entry) { return entry.value == pigmentation; })
        ->name;
}

ScatterModel scatter_model_from_name(std::string_view name) {
    for (const auto& entry : kModels) {
        if (entry.name == name) return entry.value;
    }
    throw InvalidArgument("scatter", std::string(name), "must be cie, ijspeert or none");
}

std::string_view name_of(ScatterModel model) {
    return std::find_if(std::begin(kModels), std::end(kModels),
                        [&](const auto& entry) { return entry.value == model; })
        ->name;
}

double cie_pigmentation(Pigmentation pigmentation) {
    switch (pigmentation) {
        case Pigmentation::kBrown:
            return 0.5;
        case Pigmentation::kBlue:
            return 1.2;
        case Pigmentation::kDarkBrown:
            return 0;
        case Pigmentation::kMean:
            break;
    }
    return 0.97;
}

double ijspeert_pigmentation(Pigmentation pigmentation) {
    switch (pigmentation) {
        case Pigmentation::kBrown:
            return 0.106;
        case Pigmentation::kBlue:
            return 0.16;
        case Pigmentation::kDarkBrown:
            return 0.056;
        case Pigmentation::kMean:
            break;
    }
    return 0.142;
}

double cie_total_glare(double angle_deg, double age_years, double p) {
    const double a = age_factor(age_years);
    const double t = angle_deg;
    const double core2 = 1 + square(t / 0.0046);
    const double inner2 = 1 + square(t / 0.045);
    const double outer2 = 1 + square(t / 0.1);
    return (1 - 0.08 * a) *
               (9.2e6 / (core2 * std::sqrt(core2)) + 1.5e5 / (inner2 * std::sqrt(inner2))) +
           (1 + 1.6 * a) * (400 / outer2 + 3e-8 * t * t +
                            p * (1300 / (outer2 * std::sqrt(outer2)) + 0.8 / std::sqrt(outer2))) +
           2.5e-3 * p;
}

double cie_general_glare(double angle_deg, double age_years, double p) {
    const double a = square(square(age_years / 62.5));
    return 10 / cube(angle_deg) + (5 / square(angle_deg) + 0.1 * p / angle_deg) * (1 + a) +
           2.5e-3 * p;
}

double age_adjusted_stiles_holladay(double angle_deg, double age_years) {
    return 10 * (1 + age_factor(age_years)) / square(angle_deg);
}

double ijspeert_psf(double angle_deg, double age_years, double pupil_diameter_mm, double m) {
    const double angle = rad_from_deg(angle_deg);
    const double sin2 = square(std::sin(angle));
    const double cos2 = square(std::cos(angle));
    double sum = 0;
    for (const auto& [c, b] : ijspeert_terms(age_years, pupil_diameter_mm, m)) {
        const double q = sin2 + b * b * cos2;
        sum += c * b / (2 * kPi * q * std::sqrt(q));
    }
    return sum;
}

double ijspeert_mtf(double cycles_per_deg, double age_years, double pupil_diameter_mm, double m) {
    double sum = 0;
    for (const auto& [c, b] : ijspeert_terms(age_years, pupil_diameter_mm, m)) {
        sum += c * std::exp(-360 * b * cycles_per_deg);
    }
    return sum;
}

double spencer_component(int component, double angle_deg, double wavelength_nm) {
    switch (component) {
        case 0:
            return 2.61e6 * std::exp(-square(angle_deg / 0.02));
        case 1:
            return 20.91 / cube(angle_deg + 0.02);
        case 2:
            return 72.37 / square(angle_deg + 0.02);
        case 3:
            return 436.9 * (568 / wavelength_nm) *
                   std::exp(-19.75 * square(angle_deg - 3 * wavelength_nm / 568));
        default:
            throw InvalidArgument("component", std::to_string(component), "must be 0 to 3");
    }
}

std::array<double, 4> spencer_weights(LightLevel level) {
    switch (level) {
        case LightLevel::kPhotopic:
            return {0.384, 0.478, 0.138, 0};
        case LightLevel::kMesopic:
            return {0.368, 0.478, 0.138, 0.016};
        case LightLevel::kScotopic:
            break;
    }
    // The published scotopic weights (.282 .478 .207 .033) sum to 1 as they stand.
    return {0.282, 0.478, 0.207, 0.033};
}

double spencer_psf(double angle_deg, LightLevel level, double wavelength_nm) {
    const auto weights = spencer_weights(level);
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
        sum +=
            weights[static_cast<std::size_t>(i)] * spencer_component(i, angle_deg, wavelength_nm);
    }
    return sum;
}

double integrate_over_angle(const std::function<double(double)>& per_sr, double from_deg,
                            double to_deg) {
    double sum = 0;
    if (from_deg < kInnermostDeg) {
        const double end = std::min(to_deg, kInnermostDeg);
        sum += integrate_innermost(per_sr, from_deg, end);
        from_deg = end;
    }
    if (!(to_deg > from_deg)) return sum;
    const int count =
        static_cast<int>(std::ceil(kIntervalsPerDecade * std::log10(to_deg / from_deg)));
    const double ratio = std::pow(to_deg / from_deg, 1.0 / count);
    for (int i = 0; i < count; ++i) {
        const double start = from_deg * std::pow(ratio, i);
        sum += integrate_log_interval(per_sr, start, start * ratio);
    }
    return sum;
}

ScatterPsf::ScatterPsf(ScatterModel model, double age_years, Pigmentation pigmentation,
                       double pupil_diameter_mm)
    : model_(model),
      age_years_(age_years),
      pigmentation_(model == ScatterModel::kCie ? cie_pigmentation(pigmentation)
                                                : ijspeert_pigmentation(pigmentation)),
      pupil_diameter_mm_(pupil_diameter_mm) {
    if (model == ScatterModel::kNone) {
        throw InvalidArgument("scatter", "none",
                              "has no scatter function; must be cie or ijspeert");
    }
    if (!(age_years >= 1 && age_years <= 120)) {
        throw InvalidArgument("age", fmt::format("{}", age_years), "must be 1 to 120 years");
    }
    if (!(pupil_diameter_mm >= 1 && pupil_diameter_mm <= 9)) {
        throw InvalidArgument("pupil", fmt::format("{}", pupil_diameter_mm), "must be 1 to 9 mm");
    }
    const auto formula = [this](double angle_deg) { return published(angle_deg); };
    const int last =
        static_cast<int>(std::floor(kIntervalsPerDecade * std::log10(kHorizonDeg / kInnermostDeg)));
    beyond_.resize(static_cast<std::size_t>(last) + 1);
    double sum = integrate_log_interval(formula, node_deg(last), kHorizonDeg);
    beyond_[static_cast<std::size_t>(last)] = sum;
    for (int i = last - 1; i >= 0; --i) {
        sum += integrate_log_interval(formula, node_deg(i), node_deg(i + 1));
        beyond_[static_cast<std::size_t>(i)] = sum;
    }
    integral_ = sum + integrate_innermost(formula, 0, kInnermostDeg);
}

double ScatterPsf::published(double angle_deg) const {
    return model_ == ScatterModel::kCie
               ? cie_total_glare(angle_deg, age_years_, pigmentation_)
               : ijspeert_psf(angle_deg, age_years_, pupil_diameter_mm_, pigmentation_);
}

double ScatterPsf::per_sr(double angle_deg) const {
    return angle_deg > kHorizonDeg ? 0 : published(angle_deg) / integral_;
}

double ScatterPsf::energy_beyond(double angle_deg) const {
    if (angle_deg >= kHorizonDeg) return 0;
    const auto formula = [this](double angle) { return published(angle); };
    if (angle_deg <= kInnermostDeg) {
        return (beyond_[0] + integrate_innermost(formula, angle_deg, kInnermostDeg)) / integral_;
    }
    const int next =
        static_cast<int>(std::ceil(kIntervalsPerDecade * std::log10(angle_deg / kInnermostDeg)));
    if (next >= static_cast<int>(beyond_.size())) {
        return integrate_log_interval(formula, angle_deg, kHorizonDeg) / integral_;
    }
    return (beyond_[static_cast<std::size_t>(next)] +
            integrate_log_interval(formula, angle_deg, node_deg(next))) /
           integral_;
}

}  // namespace aureole::eye
