#include "lens/starburst_profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "aureole/base/parallel.h"
#include "aureole/base/smoothstep.h"
#include "aureole/base/units.h"

namespace aureole::lens {
namespace {

constexpr double kRing = 2;  // outer over inner radius

// Weight of a sample of the ring: fades in and out, so that fringes average out.
double ring_weight(double rho, double end) {
    const double t = std::log(kRing * rho / end) / std::log(kRing);
    if (!(t > 0 && t < 1)) return 0;
    const double s = std::sin(kPi * t);
    return s * s;
}

// Integral over the ring of weight / rho^2, by Simpson's rule in log rho.
double ring_integral(double end) {
    constexpr int kSteps = 256;
    const double step = std::log(kRing) / kSteps;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double rho = end / kRing * std::exp(i * step);
        const int factor = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
        sum += factor * ring_weight(rho, end) / rho;
    }
    return sum * step / 3;
}

// Sums over samples of the ring, by direction.
struct RingSums {
    std::vector<double> energy;   // of |F|^2 rho^3 weight
    std::vector<double> samples;  // of weight
    double total = 0;             // of |F|^2 weight, both halves of the turn

    void add(double power, double rho, double phi, double weight) {
        total += 2 * weight * power;
        const double bin = phi / kPi * static_cast<double>(energy.size());
        const auto low = static_cast<std::size_t>(bin);
        const double share = bin - static_cast<double>(low);
        const std::size_t a = low % energy.size();
        const std::size_t b = (low + 1) % energy.size();
        const double value = power * rho * rho * rho;
        energy[a] += (1 - share) * weight * value;
        samples[a] += (1 - share) * weight;
        energy[b] += share * weight * value;
        samples[b] += share * weight;
    }
};

// In fixed chunks of rows, the upper half of the turn.
std::vector<RingSums> sum_ring(const AxisSquare& pattern, double end, std::size_t bins) {
    constexpr std::size_t kChunks = 32;
    std::vector<RingSums> chunks(kChunks);
    const auto half = static_cast<std::size_t>(pattern.half);
    const std::size_t rows_per_chunk = half / kChunks + 1;
    parallel_for(kChunks, [&](std::size_t chunk, int) {
        RingSums& ring = chunks[chunk];
        ring.energy.assign(bins, 0);
        ring.samples.assign(bins, 0);
        const std::size_t last = std::min((chunk + 1) * rows_per_chunk, half);
        for (std::size_t l = chunk * rows_per_chunk; l < last; ++l) {
            const float* row = pattern.row(half + l);
            const double y = static_cast<double>(l);
            for (int k = l == 0 ? 1 : 1 - pattern.half; k < pattern.half; ++k) {
                const double rho = std::sqrt(static_cast<double>(k) * k + y * y);
                if (rho * kRing <= end || rho >= end) continue;
                ring.add(static_cast<double>(row[k + pattern.half]), rho, std::atan2(y, k),
                         ring_weight(rho, end));
            }
        }
    });
    return chunks;
}

}  // namespace

AngularProfile AngularProfile::of(const AxisSquare& pattern, double end) {
    // A multiple of four: an iris may be turned by a quarter, or seen in a mirror.
    const auto bins = 4 * static_cast<std::size_t>(std::ceil(kPi * end / 4));
    std::vector<double> values(bins, 0.0);
    std::vector<double> samples(bins, 0.0);
    double total = 0;
    for (const RingSums& ring : sum_ring(pattern, end, bins)) {
        total += ring.total;
        for (std::size_t b = 0; b < bins; ++b) {
            values[b] += ring.energy[b];
            samples[b] += ring.samples[b];
        }
    }
    for (std::size_t b = 0; b < bins; ++b) {
        values[b] = samples[b] > 0 ? values[b] / samples[b] : 0;
    }
    AngularProfile profile(values);
    if (profile.mean_ > 0) profile.multiply(total / ring_integral(end) / profile.turn());
    return profile;
}

AngularProfile::AngularProfile(const std::vector<double>& values) : bins_(values.size()) {
    const auto size = static_cast<double>(values.size());
    for (const double value : values) mean_ += value / size;
    // Without the mean the integral repeats after a half turn; without its own mean the second
    // does.
    double first = 0;
    double mean_first = 0;
    for (std::size_t b = 0; b < values.size(); ++b) {
        bins_[b].value = values[b] - mean_;
        bins_[b].first = first;
        mean_first += (first + 0.5 * bins_[b].value) / size;
        first += bins_[b].value;
    }
    double second = 0;
    for (Bin& bin : bins_) {
        bin.first -= mean_first;
        bin.second = second;
        second += bin.first + 0.5 * bin.value;
    }
}

double AngularProfile::turn() const { return 2 * kPi * mean_; }

void AngularProfile::multiply(double factor) {
    mean_ *= factor;
    for (Bin& bin : bins_) {
        bin.value *= factor;
        bin.first *= factor;
        bin.second *= factor;
    }
}

void AngularProfile::take_out(AngularProfile& other, double phi) {
    const double width = kPi / static_cast<double>(bins_.size());
    const double theirs = other.over(phi, width, width);
    other.multiply(theirs > 0 ? std::min(1.0, over(phi, width, width) / theirs) : 0.0);
    std::vector<double> rest(bins_.size());
    for (std::size_t b = 0; b < rest.size(); ++b) {
        rest[b] = std::max(0.0, mean_ + bins_[b].value - other.mean_ - other.bins_[b].value);
    }
    const double left = turn() - other.turn();
    *this = AngularProfile(rest);
    multiply(mean_ > 0 ? std::max(0.0, left) / turn() : 0.0);
}

double AngularProfile::second_integral(double bins) const {
    const auto size = static_cast<double>(bins_.size());
    bins -= size * std::floor(bins / size);
    const std::size_t b = std::min(static_cast<std::size_t>(bins), bins_.size() - 1);
    const double t = bins - static_cast<double>(b);
    const Bin& bin = bins_[b];
    return bin.second + t * (bin.first + 0.5 * t * bin.value);
}

double AngularProfile::over(double phi, double side_a, double side_b) const {
    const double bins_per_rad = static_cast<double>(bins_.size()) / kPi;
    const double centre = phi * bins_per_rad + 0.5;
    // A side seen end on would divide by 0.
    const double widest = std::max(side_a, side_b);
    const double a = bins_per_rad * std::max(side_a, 0.02 * widest);
    const double b = bins_per_rad * std::max(side_b, 0.02 * widest);
    const double outer = 0.5 * (a + b);
    const double inner = 0.5 * (a - b);
    const double sum = second_integral(centre + outer) - second_integral(centre + inner) -
                       second_integral(centre - inner) + second_integral(centre - outer);
    return std::max(0.0, mean_ + sum / (a * b));
}

SpikeProfile::SpikeProfile(AngularProfile profile, double first_rad, double spacing_rad,
                           double width_rad)
    : profile_(std::move(profile)),
      first_rad_(first_rad),
      spacing_rad_(spacing_rad),
      width_rad_(width_rad) {}

// A straight edge makes a spike that falls as 1 / rho^2 and stays as wide as it is: seen at an
// angle delta from it, p(s rho, delta) = s p(rho, s delta). Around it p falls as 1 / (delta^2 rho),
// for which that is the same as p(rho, delta) / s: that form serves for what lies farther from a
// spike than its neighbours allow. A spike much narrower than a pixel need not be made narrower.
double SpikeProfile::over(double phi, double side_a, double side_b, double stretch) const {
    const double narrow_enough = 2 * width_rad_ / std::max(side_a, side_b);
    const double s = std::min(stretch, narrow_enough);
    if (!(s > 1)) return profile_.over(phi, side_a, side_b);
    const double delta = std::remainder(phi - first_rad_, spacing_rad_);
    const double far_share = smoothstep(0.3, 0.9, s * std::abs(delta) / (0.5 * spacing_rad_));
    double p = 0;
    if (far_share < 1) {
        p += (1 - far_share) * s * profile_.over(phi + (s - 1) * delta, s * side_a, s * side_b);
    }
    if (far_share > 0) p += far_share / s * profile_.over(phi, side_a, side_b);
    return p;
}

double fitted_at(double end) { return end / std::sqrt(kRing); }

}  // namespace aureole::lens
