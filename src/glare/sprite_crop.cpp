#include "glare/sprite_crop.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace aureole::glare {
namespace {

double largest_energy(const sources::Cluster& cluster) {
    double most = 0;
    for (const float e : cluster.energy) most = std::max(most, std::abs(static_cast<double>(e)));
    return most;
}

double amount(const sources::Cluster& cluster) {
    double sum = 0;
    for (const float e : cluster.energy) sum += std::abs(static_cast<double>(e));
    return sum;
}

// Clusters of nearly the same energy, to be looked up together.
struct EnergyBin {
    double least = 0;   // energy of the channel with most
    double amount = 0;  // sum over clusters and channels
};

std::vector<EnergyBin> bins_of(const std::vector<sources::Cluster>& clusters) {
    constexpr int kBinsPerOctave = 32;
    constexpr int kOctaves = 300;  // all floats
    std::vector<EnergyBin> bins(static_cast<std::size_t>(kBinsPerOctave) * kOctaves);
    for (const sources::Cluster& cluster : clusters) {
        const double energy = largest_energy(cluster);
        if (!(energy > 0)) continue;
        const double place = (std::log2(energy) + 0.5 * kOctaves) * kBinsPerOctave;
        const auto bin =
            static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(bins.size() - 1)));
        bins[bin].least = std::exp2(static_cast<double>(bin) / kBinsPerOctave - 0.5 * kOctaves);
        bins[bin].amount += amount(cluster);
    }
    std::erase_if(bins, [](const EnergyBin& bin) { return bin.amount == 0; });
    return bins;
}

}  // namespace

double crop_level(const std::vector<sources::Cluster>& clusters, const KernelProfile& profile,
                  double most_lost) {
    const std::vector<EnergyBin> bins = bins_of(clusters);
    if (bins.empty()) return 0;
    const auto lost = [&](double level) {
        double sum = 0;
        for (const EnergyBin& bin : bins) {
            sum += bin.amount * profile.lost(profile.radius_below(level / bin.least));
        }
        return sum;
    };
    double high = bins.back().least;
    double low = high * 1e-30;
    if (lost(low) > most_lost) return 0;
    while (high > 1.0001 * low) {
        const double middle = std::sqrt(low * high);
        (lost(middle) > most_lost ? high : low) = middle;
    }
    return low;
}

int crop_radius(const sources::Cluster& cluster, const KernelProfile& profile, double level) {
    const double energy = largest_energy(cluster);
    return energy > 0 ? profile.radius_below(level / energy) : 0;
}

double energy_lost(const sources::Cluster& cluster, const KernelProfile& profile, int radius) {
    return amount(cluster) * profile.lost(radius);
}

}  // namespace aureole::glare
