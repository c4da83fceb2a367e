// What a rough surface reflects of an environment: the whole integral, which the split sum
// approximates. An estimate by sampling, right for suns and for smooth surfaces alike.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "aureole/ibl/cube_map.h"
#include "aureole/ibl/cube_sampler.h"

namespace aureole::ibl {

// With Schlick's Fresnel term, f0 + (1 - f0) (1 - V.H)^5, reflected radiance is f0 * scale + bias.
struct SpecularRadiance {
    std::array<double, 3> scale = {};
    std::array<double, 3> bias = {};
};

// The environment is constant over each texel, as for ExactFilter; only mirrors interpolate.
class SpecularIntegral {
  public:
    // Throws InvalidArgument for an empty environment.
    explicit SpecularIntegral(const CubeMap& environment);

    // Samples [first, first + count) of a sequence whose every stretch is spread evenly, moved by
    // `seed`; the mean of several stretches of one length is a better estimate. count is even.
    // Unit vectors; normal.view > 0. From any number of threads.
    SpecularRadiance estimate(const Direction& normal, const Direction& view, double alpha,
                              int first, int count, std::uint32_t seed) const noexcept;

  private:
    struct Texel {
        std::array<float, 3> rgb = {};
        float density = 0;  // probability by area of the face, whose sides are 2
    };
    struct LightSample {
        Direction direction;
        std::array<float, 3> rgb = {};
        float density = 0;  // probability by solid angle
    };
    const Texel& texel_at(const CubePoint& point) const noexcept;
    LightSample sample_light(const std::vector<double>& cumulative, double u, double v) const;

    CubeSampler sampler_;
    int size_ = 0;
    std::vector<Texel> texels_;  // face by face, row by row
    // Drawn once for all: the same are of use everywhere, each place takes a stretch of them.
    std::vector<LightSample> lights_;
};

}  // namespace aureole::ibl
