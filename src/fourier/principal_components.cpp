#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/fourier/kernel_nodes.h"

namespace aureole::fourier {
namespace {

// Passes of the iteration; the spectrum of streaks falls slowly, and the result no longer changes.
constexpr int kPasses = 6;
// Of the largest mean: what is darker counts as bright as that.
constexpr float kDarkest = 1e-5F;

std::size_t samples(const Image& image) {
    return image.pixels() * static_cast<std::size_t>(image.channels());
}

// Columns of node factors, each as long as there are nodes.
using Factors = std::vector<std::vector<double>>;

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

// Gram-Schmidt, twice for the sake of rounding.
void orthonormalise(Factors& columns) {
    for (std::size_t t = 0; t < columns.size(); ++t) {
        for (const int pass : {0, 1}) {
            static_cast<void>(pass);
            for (std::size_t s = 0; s < t; ++s) {
                const double along = dot(columns[t], columns[s]);
                for (std::size_t n = 0; n < columns[t].size(); ++n) {
                    columns[t][n] -= along * columns[s][n];
                }
            }
            const double length = std::sqrt(dot(columns[t], columns[t]));
            for (double& value : columns[t]) value = length > 0 ? value / length : 0;
        }
    }
}

// Rows: what each node differs from the mean by.
struct Deviations {
    std::vector<std::vector<float>> rows;

    // sum over nodes of factors[n] row n
    std::vector<float> mix(const std::vector<double>& factors) const {
        std::vector<float> sum(rows.front().size());
        for (std::size_t n = 0; n < rows.size(); ++n) {
            const auto factor = static_cast<float>(factors[n]);
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * rows[n][i];
        }
        return sum;
    }
    // row n . term, for all n, times the weights of the samples
    std::vector<double> project(const std::vector<float>& term,
                                const std::vector<float>& weights) const {
        std::vector<double> result(rows.size());
        for (std::size_t n = 0; n < rows.size(); ++n) {
            float sum = 0;
            for (std::size_t i = 0; i < term.size(); ++i) {
                sum += rows[n][i] * term[i] * weights[i];
            }
            result[n] = static_cast<double>(sum);
        }
        return result;
    }
};

Image image_of(const std::vector<float>& values, const Image& like) {
    Image image(like.width(), like.height(), like.channels());
    std::copy(values.begin(), values.end(), image.plane(0));
    return image;
}

}  // namespace

KernelNodes principal_components(const KernelNodes& part, int rank) {
    if (rank < 1) throw InvalidArgument("rank", std::to_string(rank), "must be at least 1");
    if (rank + 1 >= part.nodes()) return part;
    const auto nodes = static_cast<std::size_t>(part.nodes());
    const std::size_t count = samples(part.halves.front());
    Deviations deviations;
    std::vector<float> mean(count);
    for (std::size_t n = 0; n < nodes; ++n) {
        const Image half = part.half_of(static_cast<int>(n));
        deviations.rows.emplace_back(half.plane(0), half.plane(0) + count);
        for (std::size_t i = 0; i < count; ++i) mean[i] += deviations.rows[n][i];
    }
    for (float& value : mean) value /= static_cast<float>(nodes);
    for (auto& row : deviations.rows) {
        for (std::size_t i = 0; i < count; ++i) row[i] -= mean[i];
    }
    // The scale of the weights is free: about 1.
    const float brightest = *std::max_element(mean.begin(), mean.end());
    std::vector<float> weights(count, 1.0F);
    if (brightest > 0) {
        for (std::size_t i = 0; i < count; ++i) {
            weights[i] = brightest / std::max(mean[i], kDarkest * brightest);
        }
    }

    Factors factors(static_cast<std::size_t>(rank), std::vector<double>(nodes));
    Random random(1, 0);
    for (auto& column : factors) {
        for (double& value : column) value = random.normal();
    }
    orthonormalise(factors);
    for (int pass = 0; pass < kPasses; ++pass) {
        parallel_for(factors.size(), [&](std::size_t t, int) {
            factors[t] = deviations.project(deviations.mix(factors[t]), weights);
        });
        orthonormalise(factors);
    }

    KernelNodes result{part.columns, part.rows, {image_of(mean, part.halves.front())}, {}};
    for (const auto& column : factors) {
        result.halves.push_back(image_of(deviations.mix(column), part.halves.front()));
    }
    for (std::size_t n = 0; n < nodes; ++n) {
        result.mixture.push_back(1);
        for (const auto& column : factors) result.mixture.push_back(static_cast<float>(column[n]));
    }
    return result;
}

}  // namespace aureole::fourier
