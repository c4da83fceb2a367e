#include "eye/corona_texture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "aureole/base/parallel.h"

namespace aureole::eye {
namespace {

constexpr double kPlainRadiusPx = 1.5;
constexpr double kFullRadiusPx = 3.5;
// Spectral weights are negative in RGB where colours leave the gamut, so that T may be too.
constexpr float kSmallestTexture = 1e-3F;

// Divides every ring of every channel by its mean, weighted by `weight`.
void normalise_rings(Image& image, const Image& weight, const std::vector<int>& ring, int rings) {
    const std::size_t pixels = image.pixels();
    std::vector<double> weights(static_cast<std::size_t>(rings));
    for (std::size_t i = 0; i < pixels; ++i) {
        weights[static_cast<std::size_t>(ring[i])] += static_cast<double>(weight.plane(0)[i]);
    }
    parallel_for(3, [&](std::size_t c, int) {
        float* plane = image.plane(static_cast<int>(c));
        std::vector<double> sums(static_cast<std::size_t>(rings));
        for (std::size_t i = 0; i < pixels; ++i) {
            sums[static_cast<std::size_t>(ring[i])] +=
                static_cast<double>(plane[i]) * static_cast<double>(weight.plane(0)[i]);
        }
        std::vector<float> scale(static_cast<std::size_t>(rings), 1.0F);
        for (std::size_t r = 0; r < scale.size(); ++r) {
            if (sums[r] > 0) scale[r] = static_cast<float>(weights[r] / sums[r]);
        }
        for (std::size_t i = 0; i < pixels; ++i)
            plane[i] *= scale[static_cast<std::size_t>(ring[i])];
    });
}

}  // namespace

Image corona_texture(const Image& corona, const Image& scatter, double contrast) {
    const int width = corona.width();
    const int height = corona.height();
    Image texture(width, height, 3);
    std::vector<int> ring(texture.pixels());
    std::vector<float> presence(texture.pixels());
    const auto exponent = static_cast<float>(contrast);
    parallel_for(static_cast<std::size_t>(height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        const std::size_t start = row * static_cast<std::size_t>(width);
        for (int x = 0; x < width; ++x) {
            const double rho = std::hypot(x - width / 2, y - height / 2);
            ring[start + static_cast<std::size_t>(x)] = static_cast<int>(std::lround(rho));
            presence[start + static_cast<std::size_t>(x)] = static_cast<float>(
                std::clamp((rho - kPlainRadiusPx) / (kFullRadiusPx - kPlainRadiusPx), 0.0, 1.0));
        }
        for (int c = 0; c < 3; ++c) {
            const float* in = corona.row(y, c);
            float* out = texture.row(y, c);
            for (int x = 0; x < width; ++x) {
                const float value = std::max(in[x], kSmallestTexture);
                out[x] = contrast == 1 ? value : std::pow(value, exponent);
            }
        }
    });
    const int rings = 1 + *std::max_element(ring.begin(), ring.end());
    normalise_rings(texture, scatter, ring, rings);
    for (int c = 0; c < 3; ++c) {
        float* plane = texture.plane(c);
        for (std::size_t i = 0; i < texture.pixels(); ++i) {
            plane[i] = 1 + (plane[i] - 1) * presence[i];
        }
    }
    // Once more: the presence varies within a ring.
    normalise_rings(texture, scatter, ring, rings);
    return texture;
}

}  // namespace aureole::eye
