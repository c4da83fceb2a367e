// Antialiasing by looking harder where it matters: two samples in every pixel, more where a pixel
// and its neighbours differ.
#pragma once

#include <algorithm>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/image/image.h"
#include "scene/camera.h"
#include "scene/vec.h"

namespace aureole::scene {

struct Sample {
    Vec3 radiance;
    // What edges are looked for in: equal steps should matter equally to the eye. In [0, 1] for
    // light; other values mark things whose radiance comes later.
    float brightness = 0;
    int share = -1;  // which of the shares the sample counts for, -1: none
};

struct Refinement {
    float contrast;  // difference of brightness within 3x3 pixels from which on ...
    int samples;     // ... this many samples are added
};
inline constexpr int kBaseSamples = 2;
inline constexpr Refinement kRefinements[] = {{0.13F, 4}, {0.28F, 8}};

// Fills `picture` with the means of samples and plane i of `shares` with the part of the samples
// that count for it. look(x, y, scratch) takes a continuous position; `scratch` is a fresh Scratch
// for every pixel and pass. Sample positions are the same in every pixel, so that edges come out
// even instead of ragged.
template <class Scratch, class Look>
void render_adaptive(const Look& look, Image& picture, Image& shares) {
    const int width = picture.width();
    const int height = picture.height();
    Image range(width, height, 2);  // least and greatest brightness

    const auto sample_pixel = [&](int x, int y, int first, int count, float& low, float& high) {
        Scratch scratch;
        for (int i = first; i < first + count; ++i) {
            const auto offset = sample_offset(i);
            const Sample sample = look(x + offset[0], y + offset[1], scratch);
            low = std::min(low, sample.brightness);
            high = std::max(high, sample.brightness);
            picture.at(x, y, 0) += sample.radiance.x;
            picture.at(x, y, 1) += sample.radiance.y;
            picture.at(x, y, 2) += sample.radiance.z;
            if (sample.share >= 0) shares.at(x, y, sample.share) += 1;
        }
    };

    parallel_for(static_cast<std::size_t>(height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < width; ++x) {
            float low = 1e9F;
            float high = -1e9F;
            sample_pixel(x, y, 0, kBaseSamples, low, high);
            range.at(x, y, 0) = low;
            range.at(x, y, 1) = high;
        }
    });
    parallel_for(static_cast<std::size_t>(height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < width; ++x) {
            float low = 1e9F;
            float high = -1e9F;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v) {
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
                    low = std::min(low, range.at(u, v, 0));
                    high = std::max(high, range.at(u, v, 1));
                }
            }
            int count = kBaseSamples;
            for (const Refinement& more : kRefinements) {
                if (high - low <= more.contrast) continue;
                float ignored_low = 0;
                float ignored_high = 0;
                sample_pixel(x, y, count, more.samples, ignored_low, ignored_high);
                count += more.samples;
            }
            const float scale = 1 / static_cast<float>(count);
            for (int c = 0; c < 3; ++c) picture.at(x, y, c) *= scale;
            for (int c = 0; c < shares.channels(); ++c) shares.at(x, y, c) *= scale;
        }
    });
}

}  // namespace aureole::scene
