#include "aureole/lens/coating.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "aureole/base/error.h"
#include "aureole/base/units.h"

namespace aureole::lens {
namespace {

constexpr double kMagnesiumFluoride = 1.38;
constexpr double kZirconiumOxide = 2.1;
constexpr double kCeriumFluoride = 1.63;
constexpr double kDefaultDesignNm = 550;
// No solid is as thin as this, no gas as dense: what lies below is air.
constexpr double kAirBelow = 1.1;

// Squared cosine of the angle in a medium of index n; negative: the wave is evanescent there and
// the cosine is +i sqrt(-cos2), which decays away from the face (time dependence exp(-i omega t)).
double squared_cosine(double n, double invariant) {
    const double sine = invariant / n;
    return (1 - sine) * (1 + sine);
}

// The characteristic matrix of a stack, [a, -i b; -i c, d]. In lossless layers the cosine is real
// or imaginary, and either way all four numbers are real.
struct Characteristic {
    double a = 1, b = 0, c = 0, d = 1;
};

Characteristic operator*(const Characteristic& l, const Characteristic& r) {
    return {l.a * r.a - l.b * r.c, l.a * r.b + l.b * r.d, l.c * r.a + l.d * r.c,
            l.d * r.d - l.c * r.b};
}

// Of one layer. With phase delta = k n h cos and admittance q the matrix is [cos delta,
// -i sin delta / q; -i q sin delta, cos delta] (Born & Wolf 1.6.4, eq. 43). `q_over_cos` is n for
// s and 1 / n for p. Evanescent layers are scaled by exp(-|delta|), which leaves reflectances alone
// and keeps thick ones from overflowing.
Characteristic of_layer(const Layer& layer, double q_over_cos, double wavenumber, double cos2) {
    const double length = wavenumber * layer.index * layer.thickness_nm;  // delta over cos
    const double cosine = std::sqrt(std::abs(cos2));
    const double delta = length * cosine;
    double even = 0;       // cos delta
    double odd_ratio = 0;  // sin delta / cos: stays finite at the critical angle
    if (cos2 >= 0) {
        even = std::cos(delta);
        odd_ratio = delta > 1e-8 ? std::sin(delta) / cosine : length;
    } else {
        const double decay = std::exp(-2 * delta);
        even = 0.5 * (1 + decay);
        odd_ratio = delta > 1e-8 ? 0.5 * (1 - decay) / cosine : length;
    }
    return {even, odd_ratio / q_over_cos, q_over_cos * odd_ratio * cos2, even};
}

double squared(double v) { return v * v; }

// |r|^2 of a stack between media of admittances q1 and q2 (Born & Wolf 1.6.4, eq. 46).
double stack_reflectance(const Characteristic& m, double q1, double q2) {
    const double below = squared(m.a * q1 + m.d * q2) + squared(m.b * q1 * q2 + m.c);
    // Grazing light between equal media with nothing between them.
    if (!(below > 0)) return 0;
    const double above = squared(m.a * q1 - m.d * q2) + squared(m.b * q1 * q2 - m.c);
    return std::min(above / below, 1.0);
}

std::optional<double> number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

[[noreturn]] void refuse(const std::string& name, const char* allowed) {
    throw InvalidArgument("coating", "\"" + name + "\"", allowed);
}

constexpr const char* kNames =
    "must be none, mgf2[:NM], broadband[:NM] or N/NM,N/NM,... (index and thickness of each layer "
    "from the air side)";

Coating layers_from_list(const std::string& name) {
    Coating layers;
    std::string_view rest = name;
    for (bool more = true; more;) {
        const std::size_t comma = rest.find(',');
        const std::string_view item = rest.substr(0, comma);
        more = comma != std::string_view::npos;
        rest = more ? rest.substr(comma + 1) : std::string_view{};
        const std::size_t slash = item.find('/');
        if (slash == std::string_view::npos) refuse(name, kNames);
        const auto index = number(item.substr(0, slash));
        const auto thickness = number(item.substr(slash + 1));
        if (!index || !thickness) refuse(name, kNames);
        if (*index < 1 || *index > 5) refuse(name, "indices must be in [1, 5]");
        if (*thickness <= 0 || *thickness > 10000) {
            refuse(name, "thicknesses must be in (0, 10000] nm");
        }
        layers.push_back({*index, *thickness});
    }
    return layers;
}

}  // namespace

Reflectance reflectance(double index_front, double index_back, std::span<const Layer> layers,
                        double wavelength_nm, double cos_incidence) {
    const double cosine = std::clamp(cos_incidence, 0.0, 1.0);
    const double invariant = index_front * std::sqrt((1 - cosine) * (1 + cosine));  // Snell's
    const double back_cos2 = squared_cosine(index_back, invariant);
    // Nothing travels on behind the face and nothing is absorbed. (A denser coating changes none of
    // it; exactly, |r| = 1.)
    if (back_cos2 < 0) return {1, 1};
    const double back_cosine = std::sqrt(back_cos2);
    const double wavenumber = 2 * kPi / wavelength_nm;
    Characteristic s;
    Characteristic p;
    for (const Layer& layer : layers) {
        const double cos2 = squared_cosine(layer.index, invariant);
        s = s * of_layer(layer, layer.index, wavenumber, cos2);
        p = p * of_layer(layer, 1 / layer.index, wavenumber, cos2);
    }
    return {stack_reflectance(s, index_front * cosine, index_back * back_cosine),
            stack_reflectance(p, cosine / index_front, back_cosine / index_back)};
}

Coating quarter_wave(double index_front, double index_back, double design_nm) {
    const double index = std::max(std::sqrt(index_front * index_back), kMagnesiumFluoride);
    return {{index, design_nm / (4 * index)}};
}

Coating coating_from_name(const std::string& name, double index_front, double index_back) {
    const bool air_in_front = index_front < kAirBelow;
    const bool air_behind = index_back < kAirBelow;
    const std::size_t colon = name.find(':');
    const std::string_view kind = std::string_view(name).substr(0, colon);
    Coating layers;
    if (kind == "mgf2" || kind == "broadband") {
        double design_nm = kDefaultDesignNm;
        if (colon != std::string::npos) {
            const auto given = number(std::string_view(name).substr(colon + 1));
            if (!given || *given < 100 || *given > 10000) {
                refuse(name, "the design wavelength must be in [100, 10000] nm");
            }
            design_nm = *given;
        }
        if (kind == "mgf2") {
            layers = quarter_wave(index_front, index_back, design_nm);
        } else {
            layers = {{kMagnesiumFluoride, design_nm / (4 * kMagnesiumFluoride)},
                      {kZirconiumOxide, design_nm / (2 * kZirconiumOxide)},
                      {kCeriumFluoride, design_nm / (4 * kCeriumFluoride)}};
        }
    } else if (name.find('/') != std::string::npos) {
        layers = layers_from_list(name);
    } else if (name != "none") {
        refuse(name, kNames);
    }
    if (air_in_front == air_behind) return {};
    if (air_behind) std::reverse(layers.begin(), layers.end());
    return layers;
}

}  // namespace aureole::lens
