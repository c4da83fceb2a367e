#include "lens/starburst_pattern.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/wave/diffraction.h"

namespace aureole::lens {
namespace {

// The profile is taken from this ring outside-in, and the law takes over within its outer half.
constexpr double kRing = 2;
constexpr double kCrossover = 1.4142135623730951;

double smoothstep(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// Weight of a sample of the ring: fades in and out, so that fringes average out.
double ring_weight(double rho, double end) {
    const double t = std::log(kRing * rho / end) / std::log(kRing);
    if (!(t > 0 && t < 1)) return 0;
    const double s = std::sin(kPi * t);
    return s * s;
}

// Integral of weight(rho) / rho^2 over [low, high], by Simpson's rule in log rho.
template <class Weight>
double integral_over_square(double low, double high, const Weight& weight) {
    constexpr int kSteps = 512;
    const double step = std::log(high / low) / kSteps;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double rho = low * std::exp(i * step);
        const int factor = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
        sum += factor * weight(rho) / rho;
    }
    return sum * step / 3;
}

// Sums over the ring, by direction.
struct RingSums {
    std::vector<double> energy;   // sum of |F|^2 rho^3 weight
    std::vector<double> samples;  // sum of weight
    double total = 0;             // sum of |F|^2 weight
};

}  // namespace

AngularProfile::AngularProfile(const std::vector<double>& values) : bins_(values.size()) {
    double sum = 0;
    for (const double value : values) sum += value;
    mean_ = sum / static_cast<double>(values.size());
    // Bin b is p over [b - 1/2, b + 1/2]. Without the mean its integral repeats after a half turn;
    // without the mean of the integral, so does the second.
    double first = 0;
    double mean_first = 0;
    for (std::size_t b = 0; b < values.size(); ++b) {
        bins_[b].value = values[b] - mean_;
        bins_[b].first = first;
        mean_first += first + 0.5 * bins_[b].value;
        first += bins_[b].value;
    }
    mean_first /= static_cast<double>(values.size());
    double second = 0;
    for (Bin& bin : bins_) {
        bin.first -= mean_first;
        bin.second = second;
        second += bin.first + 0.5 * bin.value;
    }
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

double Crossover::raster_share(double rho) const {
    if (rho <= full) return 1;
    if (rho >= end) return 0;
    return 1 - smoothstep(std::log(rho / full) / std::log(end / full));
}

StarburstPattern starburst_pattern(StarburstAperture aperture, double end_samples) {
    wave::Field& field = aperture.field;
    const int full_size = field.grid.samples;
    const double extent_mm = field.grid.extent_mm;
    {
        fourier::Fft2d fft(full_size, full_size);
        wave::transform(field, fft);
    }
    const auto n = static_cast<std::size_t>(full_size);
    const int half = static_cast<int>(std::ceil(end_samples)) + 1;
    const auto side = 2 * static_cast<std::size_t>(half);
    const Crossover crossover{end_samples / kCrossover, end_samples};
    const auto bins = static_cast<std::size_t>(std::ceil(kPi * end_samples));

    // Row `half + l` of the middle is at l samples from the axis; the ring needs l >= 0 only.
    Buffer middle(side * side);
    std::vector<double> row_energy(side, 0.0);
    constexpr std::size_t kChunks = 32;
    std::vector<RingSums> chunks(kChunks);
    const std::size_t rows_per_chunk = (side + kChunks - 1) / kChunks;
    parallel_for(kChunks, [&](std::size_t chunk, int) {
        RingSums& ring = chunks[chunk];
        ring.energy.assign(bins, 0);
        ring.samples.assign(bins, 0);
        const std::size_t end = std::min((chunk + 1) * rows_per_chunk, side);
        for (std::size_t j = chunk * rows_per_chunk; j < end; ++j) {
            const int l = static_cast<int>(j) - half;
            const std::size_t row = (n + j - static_cast<std::size_t>(half)) % n * n;
            const float row_gain = aperture.gain[static_cast<std::size_t>(std::abs(l))];
            float* out = middle.data() + j * side;
            for (std::size_t i = 0; i < side; ++i) {
                const int k = static_cast<int>(i) - half;
                const double rho = std::hypot(k, l);
                if (rho >= end_samples) {
                    out[i] = 0;
                    continue;
                }
                const std::size_t at = row + (n + i - static_cast<std::size_t>(half)) % n;
                const float power =
                    (field.re[at] * field.re[at] + field.im[at] * field.im[at]) *
                    (aperture.gain[static_cast<std::size_t>(std::abs(k))] * row_gain);
                const double energy = static_cast<double>(power);
                const double inside = crossover.raster_share(rho) * energy;
                out[i] = static_cast<float>(inside);
                row_energy[j] += inside;
                if (l < 0 || (l == 0 && k < 0)) continue;
                const double weight = ring_weight(rho, end_samples);
                if (weight == 0) continue;
                ring.total += 2 * weight * energy;
                const double bin = std::atan2(l, k) / kPi * static_cast<double>(bins);
                const auto low = static_cast<std::size_t>(bin);
                const double share = bin - static_cast<double>(low);
                const double value = energy * rho * rho * rho;
                const std::size_t a = low % bins;
                const std::size_t b = (low + 1) % bins;
                ring.energy[a] += (1 - share) * weight * value;
                ring.samples[a] += (1 - share) * weight;
                ring.energy[b] += share * weight * value;
                ring.samples[b] += share * weight;
            }
        }
    });

    std::vector<double> profile(bins, 0.0);
    std::vector<double> samples(bins, 0.0);
    double ring_total = 0;
    for (const RingSums& ring : chunks) {
        ring_total += ring.total;
        for (std::size_t b = 0; b < bins; ++b) {
            profile[b] += ring.energy[b];
            samples[b] += ring.samples[b];
        }
    }
    double sum = 0;
    for (std::size_t b = 0; b < bins; ++b) {
        profile[b] = samples[b] > 0 ? profile[b] / samples[b] : 0;
        sum += profile[b];
    }
    // Integral of p over the turn: the law holds the energy of the ring.
    const double turn = ring_total / integral_over_square(
                                         end_samples / kRing, end_samples,
                                         [&](double rho) { return ring_weight(rho, end_samples); });
    const double beyond =
        turn * (integral_over_square(crossover.full, crossover.end,
                                     [&](double rho) { return 1 - crossover.raster_share(rho); }) +
                1 / crossover.end);
    double inside = 0;
    for (const double row : row_energy) inside += row;
    const double scale = 1 / (inside + beyond);

    parallel_for(side, [&](std::size_t j, int) {
        float* out = middle.data() + j * side;
        for (std::size_t i = 0; i < side; ++i) {
            out[i] = static_cast<float>(static_cast<double>(out[i]) * scale);
        }
    });
    const double to_profile =
        sum > 0 ? scale * turn * static_cast<double>(bins) / (2 * kPi * sum) : 0;
    for (double& value : profile) value *= to_profile;
    return {extent_mm, crossover, wave::PatternIntegral(middle.data(), static_cast<int>(side)),
            AngularProfile(profile)};
}

}  // namespace aureole::lens
