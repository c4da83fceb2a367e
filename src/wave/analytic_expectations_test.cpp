// Every row of data/analytic_expectations.csv against the code: a value measured from simulated
// patterns, not from the closed form that made the row.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "aureole/base/units.h"
#include "aureole/wave/diffraction.h"
#include "aureole/wave/huygens_fresnel.h"
#include "aureole/wave/mask_shapes.h"
#include "aureole/wave/radial_grating.h"

namespace aureole::wave {
namespace {

// A value measured from the simulation and how far it may be from the table.
struct Measured {
    double value = 0;
    double tolerance = 0;  // absolute
};
using Measure = std::function<Measured()>;

// Cubic interpolation of a row of samples; `at` counts samples from the first.
struct Curve {
    std::vector<double> y;

    double operator()(double at) const {
        const int k =
            std::clamp(static_cast<int>(std::floor(at)), 1, static_cast<int>(y.size()) - 3);
        const double t = at - k;
        const double* p = y.data() + k;
        return -t * (t - 1) * (t - 2) / 6 * p[-1] + (t + 1) * (t - 1) * (t - 2) / 2 * p[0] -
               (t + 1) * t * (t - 2) / 2 * p[1] + (t + 1) * t * (t - 1) / 6 * p[2];
    }
    // Position where the curve passes `level` for the `nth` time.
    double crossing(double level, int nth) const {
        for (std::size_t k = 0; k + 1 < y.size(); ++k) {
            if ((y[k] > level) == (y[k + 1] > level)) continue;
            if (--nth > 0) continue;
            double low = static_cast<double>(k);
            double high = low + 1;
            for (int step = 0; step < 60; ++step) {
                const double middle = (low + high) / 2;
                const bool same = ((*this)(middle) > level) == (y[k] > level);
                (same ? low : high) = middle;
            }
            return (low + high) / 2;
        }
        ADD_FAILURE() << "no crossing of " << level;
        return 0;
    }
    // Position of the largest |y| between two positions.
    double extremum(double from, double to) const {
        double best = from;
        for (double at = from; at <= to; at += 1e-3) {
            if (std::abs((*this)(at)) > std::abs((*this)(best))) best = at;
        }
        return best;
    }
};

// The diffraction of an opening of `size` mm on an axis: amplitude along +x relative to the peak,
// energy within a radius. Lengths in units of lambda / size.
class Lobes {
  public:
    Lobes(const Shape& opening, double size_mm, int samples, double extent_mm)
        : scale_(size_mm / extent_mm), mask_({samples, extent_mm}), field_(mask_.grid) {
        draw(mask_, opening);
        field_ = field_from(mask_);
        fourier::Fft2d fft(samples, samples);
        const double norm = transform(field_, fft);
        const double peak = static_cast<double>(field_.re[0]);
        for (int k = 0; k < samples / 2; ++k) {
            const auto index = static_cast<std::size_t>(k);
            amplitude_.y.push_back((k % 2 == 0 ? 1 : -1) * static_cast<double>(field_.re[index]) /
                                   peak);
        }
        norm_ = norm;
    }

    double zero(int nth) const { return amplitude_.crossing(0, nth) * scale_; }
    double maximum_position(int nth) const {
        return amplitude_.extremum(amplitude_.crossing(0, nth), amplitude_.crossing(0, nth + 1)) *
               scale_;
    }
    double maximum(int nth) const {
        const double a = amplitude_(maximum_position(nth) / scale_);
        return a * a;
    }
    double full_width_half_maximum() const {
        return 2 * amplitude_.crossing(std::sqrt(0.5), 1) * scale_;
    }
    // Share of the energy within a radius; samples on the rim count by how much is inside.
    double encircled(double radius) const {
        return sum([&](int k, int l) {
            return std::clamp(radius / scale_ - std::hypot(k, l) + 0.5, 0.0, 1.0);
        });
    }
    double in_square(double half_side_x, double half_side_y) const {
        const auto inside = [](double half, int k) {
            return std::clamp(half - std::abs(k) + 0.5, 0.0, 1.0);
        };
        return sum([&](int k, int l) {
            return inside(half_side_x / scale_, k) * inside(half_side_y / scale_, l);
        });
    }
    double radius_of(double share) const {
        double low = 0;
        double high = 4;
        for (int step = 0; step < 40; ++step) {
            const double middle = (low + high) / 2;
            (encircled(middle) < share ? low : high) = middle;
        }
        return low;
    }

  private:
    template <class Weight>
    double sum(const Weight& weight) const {
        const int n = mask_.grid.samples;
        double total = 0;
        for (int l = -n / 2; l < n / 2; ++l) {
            for (int k = -n / 2; k < n / 2; ++k) {
                const double w = weight(k, l);
                if (w == 0) continue;
                const auto index =
                    static_cast<std::size_t>((l + n) % n) * static_cast<std::size_t>(n) +
                    static_cast<std::size_t>((k + n) % n);
                total += w * (std::pow(static_cast<double>(field_.re[index]), 2) +
                              std::pow(static_cast<double>(field_.im[index]), 2));
            }
        }
        return total / norm_;
    }

    double scale_;
    Mask mask_;
    Field field_;
    Curve amplitude_;
    double norm_ = 1;
};

const Lobes& airy() {
    static const Lobes lobes(disc(0.5), 1, 2048, 16);
    return lobes;
}
const Lobes& airy_energy() {
    static const Lobes lobes(disc(0.5), 1, 2048, 8);
    return lobes;
}
// Openings an odd number of samples wide, so that their edges lie between samples.
const Lobes& slit() {
    static const Lobes lobes(rectangle(1, 99), 1, 1024, 1024 / 65.0);
    return lobes;
}
const Lobes& square() {
    static const Lobes lobes(rectangle(1, 1), 1, 1024, 1024 / 129.0);
    return lobes;
}
const Lobes& ring(double ratio) {
    static std::map<double, Lobes> cache;
    const auto found = cache.find(ratio);
    if (found != cache.end()) return found->second;
    return cache.try_emplace(ratio, annulus(ratio / 2, 0.5), 1.0, 2048, 8.0).first->second;
}

// Radius of the first dark ring of a round pupil, in arcmin.
double first_zero_arcmin(double diameter_mm, double wavelength_nm) {
    const double extent = 8 * diameter_mm;
    static std::map<double, double> zeros;
    if (!zeros.contains(diameter_mm)) {
        zeros[diameter_mm] = Lobes(disc(diameter_mm / 2), diameter_mm, 1024, extent).zero(1);
    }
    const Pattern pattern{{1024, extent}, {}};
    const double samples = zeros[diameter_mm] * extent / diameter_mm;
    return 60 * deg_from_rad(std::asin(samples * pattern.step(wavelength_nm)));
}

double peak_radiance(double diameter_mm, double wavelength_nm) {
    Mask mask({1024, 2 * diameter_mm});
    draw(mask, disc(diameter_mm / 2));
    Field field = field_from(mask);
    fourier::Fft2d fft(1024, 1024);
    return fraunhofer(field, fft).intensity_per_sr(0, 0, wavelength_nm);
}

constexpr double kHaloPeriodMm = 10.852959e-3;

// Direction cosine of the first order of a mask of bars behind a round pupil, per mm of
// wavelength: the centre of gravity of the light around it.
double first_order_per_mm() {
    static const double found = [] {
        Mask bars({1024, 2.5});
        for (int k = -60; k <= 60; ++k) {
            draw(bars, rectangle(kHaloPeriodMm / 2, 3, 0, {k * kHaloPeriodMm, 0}));
        }
        draw(bars, disc(0.6), Blend::kKeep);
        Field field = field_from(bars);
        fourier::Fft2d fft(1024, 1024);
        const Pattern pattern = fraunhofer(field, fft);
        double energy = 0;
        double moment = 0;
        for (int l = -8; l <= 8; ++l) {
            for (int k = 222; k <= 238; ++k) {
                const double e = pattern.intensity_per_sr(k, l, 1);
                energy += e;
                moment += e * k;
            }
        }
        return moment / energy / bars.grid.extent_mm;
    }();
    return found;
}

double halo_angle_deg(double wavelength_nm) {
    return deg_from_rad(std::asin(first_order_per_mm() * mm_from_nm(wavelength_nm)));
}

// Share of the incident power in one order of a grating of equal bars and gaps.
double grating_order(int order) {
    const int period = 512;
    Mask mask({1024, 1024});
    for (int k = -4; k <= 4; ++k) draw(mask, rectangle(period / 2, 2000, 0, {k * 512.0 + 0.5, 0}));
    const double open = area_mm2(mask) / (1024.0 * 1024.0);
    Field field = field_from(mask);
    fourier::Fft2d fft(1024, 1024);
    const Pattern pattern = fraunhofer(field, fft);
    const std::size_t index = 512 * 1024 + 512 + static_cast<std::size_t>(order * 1024 / period);
    return static_cast<double>(pattern.energy[index]) * open;
}

// Intensity on the axis behind a round hole of the given Fresnel number, by direct summation.
double on_axis(double fresnel_number) {
    constexpr double kRadius = 0.5;
    constexpr double kWavelength = 500;
    Mask mask({512, 1.125});
    draw(mask, disc(kRadius));
    const double z = kRadius * kRadius / (mm_from_nm(kWavelength) * fresnel_number);
    const Point axis{};
    return std::norm(huygens_fresnel(field_from(mask), kWavelength, z, {&axis, 1}).front());
}

// Behind an opaque disc: what arrives without it, less what arrives through it (Babinet).
double poisson_spot() {
    Mask mask({512, 1.125});
    draw(mask, disc(0.5));
    const double z = 200;
    const Point axis{};
    const auto disc_light = huygens_fresnel(field_from(mask), 500, z, {&axis, 1}).front();
    return std::norm(std::polar(1.0, 2 * kPi * z / 500e-6) - disc_light);
}

// Intensity behind a half plane lit for x > 0, at w = x sqrt(2 / (lambda z)) from -3 in steps of
// 1/20. Far from the edge the light is faded out smoothly, so that no other edge shows.
constexpr double kKnifeFirst = -3.2;
constexpr double kKnifeStep = 0.05;
const Curve& knife_edge() {
    static const Curve curve = [] {
        const double wavelength = 500;
        const double z = 1000;
        const double unit = std::sqrt(mm_from_nm(wavelength) * z / 2);
        Mask mask({640, 20 * unit});
        draw(mask, rectangle(12 * unit, 99 * unit, 0, {6 * unit, 0}));
        const auto fade = [](double w) {
            const double t = std::clamp((std::abs(w) - 4) / 5.5, 0.0, 1.0);
            return 1 - t * t * t * (10 + t * (6 * t - 15));
        };
        for (int j = 0; j < 640; ++j) {
            for (int i = 0; i < 640; ++i) {
                mask.row(j)[i] *= static_cast<float>(fade(mask.grid.x_mm(i) / unit) *
                                                     fade(mask.grid.y_mm(j) / unit));
            }
        }
        std::vector<Point> points;
        for (double w = kKnifeFirst; w < 3.3; w += kKnifeStep) points.push_back({w * unit, 0});
        Curve result;
        for (const auto& e : huygens_fresnel(field_from(mask), wavelength, z, points)) {
            result.y.push_back(std::norm(e));
        }
        return result;
    }();
    return curve;
}
double knife(double w) { return knife_edge()((w - kKnifeFirst) / kKnifeStep); }
double knife_extremum(double near) {
    double best = near - 0.2;
    const bool maximum = knife(near) > knife(near + 0.2);
    for (double w = near - 0.2; w <= near + 0.2; w += 1e-3) {
        if ((knife(w) > knife(best)) == maximum) best = w;
    }
    return best;
}

// Phase that a quadratic term gives the sample at radius a, in turns. A phase is known up to whole
// turns: those nearest to the expectation.
double edge_turns(double a_mm, double expected, const std::function<void(Field&)>& term) {
    Mask mask({20, 10}, 1);
    Field field = field_from(mask);
    term(field);
    const auto index = static_cast<std::size_t>(10 * 20 + 10 + std::lround(a_mm / 0.5));
    const double turns =
        std::atan2(static_cast<double>(field.im[index]), static_cast<double>(field.re[index])) /
        (2 * kPi);
    return turns + std::round(expected - turns);
}

// Numbers in a key, in order: "airy_first_zero_D2mm_450nm" -> 2, 450.
std::vector<double> numbers_in(const std::string& key) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < key.size();) {
        const bool digit = std::isdigit(static_cast<unsigned char>(key[i])) != 0;
        const bool minus = key[i] == '-' && i + 1 < key.size();
        if (!digit && !minus) {
            ++i;
            continue;
        }
        std::size_t used = 0;
        numbers.push_back(std::stod(key.substr(i), &used));
        i += used;
    }
    return numbers;
}

// How each row is measured; rows of other modules give an empty function, unknown rows none.
bool find_measure(const std::string& key, double expected, Measure& measure) {
    const std::vector<double> n = numbers_in(key);
    const auto starts = [&](const char* prefix) { return key.rfind(prefix, 0) == 0; };
    const auto ends = [&](const std::string& suffix) {
        return key.size() >= suffix.size() &&
               key.compare(key.size() - suffix.size(), suffix.size(), suffix) == 0;
    };
    const auto set = [&](double relative, const std::function<double()>& value, double floor = 0) {
        const double tolerance = std::max(relative * std::abs(expected), floor);
        measure = [=] { return Measured{value(), tolerance}; };
        return true;
    };
    const auto nth = [n](std::size_t i) { return static_cast<int>(n.at(i)); };

    // Pupil models and the MTF of the eye's optics: checked by the tests of `eye`.
    if (starts("pupil_") || starts("watson_mtf_")) return true;

    if (starts("airy_zero_")) return set(1e-3, [=] { return airy().zero(nth(0)); });
    if (starts("airy_max_") && ends("_pos")) {
        return set(1e-3, [=] { return airy().maximum_position(nth(0)); });
    }
    if (starts("airy_max_")) return set(0.01, [=] { return airy().maximum(nth(0)); });
    if (starts("airy_EE_ring_")) {
        return set(
            0, [=] { return airy_energy().encircled(airy_energy().zero(nth(0))); }, 0.003);
    }
    if (key == "airy_FWHM") return set(1e-3, [] { return airy().full_width_half_maximum(); });
    if (key == "airy_EE50_radius") {
        // The slope there is .9 per unit of radius: .003 of energy is .6 % of the radius.
        return set(6e-3, [] { return airy().radius_of(0.5); });
    }
    if (starts("airy_first_zero_D")) {
        return set(1e-3, [=] { return first_zero_arcmin(n.at(0), n.at(1)); });
    }
    if (starts("airy_peak_radiance_D")) {
        return set(3e-3, [=] { return peak_radiance(n.at(0), n.at(1)); });
    }
    if (starts("slit_max_") && ends("_pos")) {
        return set(1e-3, [=] { return slit().maximum_position(nth(0)); });
    }
    if (starts("slit_max_")) return set(0.01, [=] { return slit().maximum(nth(0)); });
    if (key == "slit_zero_1") return set(1e-3, [] { return slit().zero(1); });
    if (key == "slit_FWHM") return set(1e-3, [] { return slit().full_width_half_maximum(); });
    if (key == "slit_energy_main_lobe") {
        return set(
            0, [] { return slit().in_square(1, 99); }, 0.003);
    }
    if (key == "square_energy_main_lobe") {
        return set(
            0, [] { return square().in_square(1, 1); }, 0.003);
    }
    if (starts("annulus_eps") && key.find("_zero_1") != std::string::npos &&
        key.find("_EE_") == std::string::npos) {
        return set(2e-3, [=] { return ring(n.at(0)).zero(1); });
    }
    if (starts("annulus_eps") && ends("_rel")) {
        return set(0.01, [=] { return ring(n.at(0)).maximum(1); });
    }
    if (starts("annulus_eps") && ends("_EE_zero_1")) {
        return set(
            0, [=] { return ring(n.at(0)).encircled(ring(n.at(0)).zero(1)); }, 0.003);
    }
    if (starts("halo_angle_200gratings_r")) {
        return set(1e-5, [=] {
            return deg_from_rad(std::asin(mm_from_nm(n.at(2)) / grating_period_mm(200, n.at(1))));
        });
    }
    if (starts("halo_angle_")) return set(1e-3, [=] { return halo_angle_deg(n.at(0)); });
    if (key == "grating_period_for_3deg_568nm") {
        // The period whose first order was measured, scaled to send it to exactly 3 deg.
        return set(1e-3, [] {
            return 1e3 * kHaloPeriodMm * std::sin(rad_from_deg(halo_angle_deg(568))) /
                   std::sin(rad_from_deg(3));
        });
    }
    if (starts("n_radial_fibres_at_r")) {
        return set(1e-6, [=] { return grating_period_mm(1, n.at(0)) / kHaloPeriodMm; });
    }
    if (starts("amp_grating_50duty_order_")) {
        return set(
            3e-3, [=] { return grating_order(nth(1)); }, 1e-5);
    }
    if (starts("fresnel_onaxis_circ_NF")) {
        return set(
            0, [=] { return on_axis(n.at(0)); }, 0.01);
    }
    if (key == "poisson_spot_onaxis") return set(2e-3, [] { return poisson_spot(); });
    if (starts("knife_w"))
        return set(
            5e-3, [=] { return knife(n.at(0)); }, 2e-4);
    if (starts("knife_ext_") && ends("_w")) {
        return set(5e-3, [=] { return knife_extremum(expected); });
    }
    if (starts("knife_ext_")) {
        const double where[] = {1.22, 1.87, 2.34, 2.74};
        const double near = where[nth(0) - 1];
        return set(5e-3, [=] { return knife(knife_extremum(near)); });
    }
    if (starts("fresnel_number_a")) {
        // exp(i pi N_F) at the edge: N_F / 2 turns.
        return set(1e-5, [=] {
            return 2 * edge_turns(n.at(0), expected / 2,
                                  [&](Field& field) { add_fresnel_term(field, n.at(1), n.at(2)); });
        });
    }
    if (starts("defocus_edge_waves_a")) {
        return set(1e-5, [=] {
            return edge_turns(n.at(0), expected,
                              [&](Field& field) { add_defocus(field, n.at(1), 575); });
        });
    }
    if (starts("max_dx_literal_fresnel_a")) {
        return set(1e-6,
                   [=] { return 1e3 * max_spacing_for_defocus_mm(1000.0 / 24, n.at(0), 575); });
    }
    return false;
}

TEST(AnalyticExpectations, EveryRowOfTheTable) {
    const auto path = std::filesystem::path(__FILE__).parent_path() / ".." / ".." / "data" /
                      "analytic_expectations.csv";
    std::ifstream file(path);
    ASSERT_TRUE(file) << path;
    std::string line;
    std::getline(file, line);
    ASSERT_EQ(line.rfind("key,value", 0), 0U);
    int measured = 0;
    int elsewhere = 0;
    while (std::getline(file, line)) {
        std::istringstream row(line);
        std::string key;
        std::string text;
        std::getline(row, key, ',');
        std::getline(row, text, ',');
        const double expected = std::stod(text);
        Measure measure;
        if (!find_measure(key, expected, measure)) {
            ADD_FAILURE() << key << ": no module tests this row";
            continue;
        }
        if (!measure) {
            ++elsewhere;
            continue;
        }
        ++measured;
        const Measured found = measure();
        EXPECT_NEAR(found.value, expected, found.tolerance) << key;
    }
    EXPECT_EQ(measured, 115);
    EXPECT_EQ(elsewhere, 56);
}

}  // namespace
}  // namespace aureole::wave
