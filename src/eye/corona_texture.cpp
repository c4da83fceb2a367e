#include "eye/corona_texture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "aureole/base/parallel.h"
#include "eye/kernel_checks.h"

namespace aureole::eye {
namespace {

constexpr double kPlainRadiusPx = 1.5;
constexpr double kFullRadiusPx = 3.5;
// Spectral weights are negative in RGB where colours leave the gamut, so that T may be too.
constexpr float kSmallestTexture = 1e-3F;

// The ring that each pixel belongs to, and how much of the texture is there.
struct Rings {
    Rings(int width, int height)
        : ring(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
          presence(ring.size()) {
        parallel_for(static_cast<std::size_t>(height), [&](std::size_t row, int) {
            const std::size_t start = row * static_cast<std::size_t>(width);
            for (int x = 0; x < width; ++x) {
                const double rho = std::hypot(x - width / 2, static_cast<int>(row) - height / 2);
                ring[start + static_cast<std::size_t>(x)] = static_cast<int>(std::lround(rho));
                presence[start + static_cast<std::size_t>(x)] = static_cast<float>(std::clamp(
                    (rho - kPlainRadiusPx) / (kFullRadiusPx - kPlainRadiusPx), 0.0, 1.0));
            }
        });
        count = 1 + *std::max_element(ring.begin(), ring.end());
    }

    // Sum over each ring of plane * weight; of the weight alone without a plane.
    std::vector<double> sums(const float* plane, const float* weight) const {
        std::vector<double> sums(static_cast<std::size_t>(count));
        for (std::size_t i = 0; i < ring.size(); ++i) {
            sums[static_cast<std::size_t>(ring[i])] +=
                (plane == nullptr ? 1.0 : static_cast<double>(plane[i])) *
                static_cast<double>(weight[i]);
        }
        return sums;
    }

    std::vector<int> ring;
    std::vector<float> presence;
    int count = 0;
};

// Divides every ring of every channel by its mean, weighted by `weight`.
void normalise_rings(Image& image, const Image& weight, const Rings& rings) {
    const std::vector<double> weights = rings.sums(nullptr, weight.plane(0));
    parallel_for(static_cast<std::size_t>(image.channels()), [&](std::size_t c, int) {
        float* plane = image.plane(static_cast<int>(c));
        const std::vector<double> sums = rings.sums(plane, weight.plane(0));
        std::vector<float> scale(sums.size(), 1.0F);
        for (std::size_t r = 0; r < scale.size(); ++r) {
            if (sums[r] > 0) scale[r] = static_cast<float>(weights[r] / sums[r]);
        }
        for (std::size_t i = 0; i < rings.ring.size(); ++i) {
            plane[i] *= scale[static_cast<std::size_t>(rings.ring[i])];
        }
    });
}

}  // namespace

Image corona_texture(const Image& corona, const Image& scatter, double contrast) {
    const int width = corona.width();
    const int height = corona.height();
    Image texture(width, height, 3);
    const Rings rings(width, height);
    const auto exponent = static_cast<float>(contrast);
    parallel_for(static_cast<std::size_t>(height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int c = 0; c < 3; ++c) {
            const float* in = corona.row(y, c);
            float* out = texture.row(y, c);
            for (int x = 0; x < width; ++x) {
                const float value = std::max(in[x], kSmallestTexture);
                out[x] = contrast == 1 ? value : std::pow(value, exponent);
            }
        }
    });
    normalise_rings(texture, scatter, rings);
    for (int c = 0; c < 3; ++c) {
        float* plane = texture.plane(c);
        for (std::size_t i = 0; i < texture.pixels(); ++i) {
            plane[i] = 1 + (plane[i] - 1) * rings.presence[i];
        }
    }
    // Once more: the presence varies within a ring.
    normalise_rings(texture, scatter, rings);
    return texture;
}

Image texture_of_primaries(const Image& texture, const Image& corona, const Image& white,
                           const Image& scatter) {
    Image result(texture.width(), texture.height(), corona.channels());
    const Rings rings(texture.width(), texture.height());
    const std::vector<double> weights = rings.sums(nullptr, scatter.plane(0));
    parallel_for(static_cast<std::size_t>(result.channels()), [&](std::size_t index, int) {
        const int channel = static_cast<int>(index);
        const float own = is_own_colour(channel, result.channels()) ? 1.0F : 0.0F;
        const float* of_primary = corona.plane(channel);
        const float* of_white = white.plane(channel % 3);
        const float* whole = texture.plane(channel % 3);
        float* out = result.plane(channel);
        for (std::size_t i = 0; i < rings.ring.size(); ++i) {
            const float share = of_primary[i] / std::max(of_white[i], kSmallestTexture);
            out[i] = whole[i] * (own + rings.presence[i] * (share - own));
        }
        // What a ring holds too much is the same for all its pixels, and 0 over the primaries.
        std::vector<double> excess = rings.sums(out, scatter.plane(0));
        for (std::size_t r = 0; r < excess.size(); ++r) {
            excess[r] = weights[r] > 0 ? excess[r] / weights[r] - static_cast<double>(own) : 0;
        }
        for (std::size_t i = 0; i < rings.ring.size(); ++i) {
            out[i] -= static_cast<float>(excess[static_cast<std::size_t>(rings.ring[i])]);
        }
    });
    return result;
}

}  // namespace aureole::eye
