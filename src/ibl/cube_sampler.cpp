#include "aureole/ibl/cube_sampler.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "ibl/bordered_chain.h"

namespace aureole::ibl {
namespace {

struct Texel {
    float value[kTexelFloats] = {};
};

void add(Texel& sum, const float* texel, float weight) {
    for (int c = 0; c < kTexelFloats; ++c) sum.value[c] += weight * texel[c];
}

// Adds `weight` times the level at `point`, linear in s and t.
void add_bilinear(Texel& sum, const BorderedChain& chain, std::size_t index, const CubePoint& point,
                  float weight) {
    const BorderedLevel& level = chain.levels()[index];
    // From the centre of the first texel of the border; texels' centres are at halves.
    const double x = (point.s + 1) / 2 * level.size + 0.5;
    const double y = (point.t + 1) / 2 * level.size + 0.5;
    const int column = static_cast<int>(x);  // 0 to size
    const int row = static_cast<int>(y);
    const auto right = static_cast<float>(x - column);
    const auto down = static_cast<float>(y - row);
    const float* top =
        chain.texels() + std::size_t{kTexelFloats} * level.texel(point.face, column - 1, row - 1);
    const float* bottom = top + std::size_t{kTexelFloats} * level.stride;
    add(sum, top, weight * (1 - right) * (1 - down));
    add(sum, top + kTexelFloats, weight * right * (1 - down));
    add(sum, bottom, weight * (1 - right) * down);
    add(sum, bottom + kTexelFloats, weight * right * down);
}

std::vector<int> sizes_of(const CubeChain& chain) {
    if (chain.empty()) throw InvalidArgument("levels", "0", "a chain to sample has at least one");
    std::vector<int> sizes;
    for (const CubeMap& level : chain) {
        if (level.empty()) {
            throw InvalidArgument("level", std::to_string(sizes.size()),
                                  "is empty; a level to sample has at least 1 x 1 texels");
        }
        sizes.push_back(level.size());
    }
    return sizes;
}

}  // namespace

struct CubeSampler::Impl {
    BorderedChain chain;
};

CubeSampler::CubeSampler(const CubeChain& chain) : impl_(std::make_unique<Impl>()) {
    impl_->chain = BorderedChain(sizes_of(chain));
    for (std::size_t level = 0; level < chain.size(); ++level) {
        impl_->chain.fill(level, chain[level]);
    }
}

CubeSampler::~CubeSampler() = default;
CubeSampler::CubeSampler(CubeSampler&&) noexcept = default;
CubeSampler& CubeSampler::operator=(CubeSampler&&) noexcept = default;

int CubeSampler::levels() const noexcept { return static_cast<int>(impl_->chain.levels().size()); }

std::array<float, 3> CubeSampler::sample(const Direction& direction, double level) const noexcept {
    const CubePoint point = cube_point_of(direction);
    const double clamped = std::clamp(level, 0.0, static_cast<double>(levels() - 1));
    const auto finer = static_cast<std::size_t>(clamped);
    const auto coarser = static_cast<float>(clamped - static_cast<double>(finer));
    Texel sum;
    add_bilinear(sum, impl_->chain, finer, point, 1 - coarser);
    if (coarser > 0) add_bilinear(sum, impl_->chain, finer + 1, point, coarser);
    return {sum.value[0], sum.value[1], sum.value[2]};
}

}  // namespace aureole::ibl
