#include "sources/find_lights_regions.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "aureole/base/parallel.h"

namespace aureole::sources {
namespace {

constexpr float kRed = 0.2126F;
constexpr float kGreen = 0.7152F;
constexpr float kBlue = 0.0722F;

// 0 for NaN, infinities and negative values, by the bits: one comparison in vector registers.
float usable(float value) {
    const auto bits = std::bit_cast<std::int32_t>(value);
    return bits > 0 && bits < 0x7f800000 ? value : 0.0F;
}

float luminance(float r, float g, float b) { return kRed * r + kGreen * g + kBlue * b; }

// Runs of a row and their sums. `values` is scratch of a row's width.
void scan_row(const BrightPixels& pixels, int y, std::vector<float>& values, std::vector<Run>& runs,
              std::vector<LightSums>& sums) {
    const int width = pixels.picture().width;
    const float threshold = pixels.threshold();
    luminance_row(pixels.picture(), y, values.data());
    constexpr int kBlock = 64;
    bool open = false;
    const auto visit = [&](int x) {
        LightSums pixel;
        if (!(values[static_cast<std::size_t>(x)] > threshold) || !pixels.add(x, y, 1, pixel)) {
            open = false;
            return;
        }
        if (!open) {
            runs.push_back({y, x, x, 0});
            sums.emplace_back();
            open = true;
        }
        runs.back().end = x + 1;
        sums.back().add(pixel);
    };
    for (int start = 0; start < width; start += kBlock) {
        const int end = std::min(start + kBlock, width);
        int bright = 0;
        for (int x = start; x < end; ++x) {
            bright |= values[static_cast<std::size_t>(x)] > threshold ? 1 : 0;
        }
        if (bright == 0) {
            open = false;
            continue;
        }
        for (int x = start; x < end; ++x) visit(x);
    }
}

// Smallest member of the set of `i`; shortens the way there (path halving).
std::size_t root_of(std::vector<std::size_t>& parents, std::size_t i) {
    while (parents[i] != i) {
        parents[i] = parents[parents[i]];
        i = parents[i];
    }
    return i;
}

}  // namespace

void LightSums::add(const LightSums& other) {
    for (std::size_t c = 0; c < 3; ++c) energy[c] += other.energy[c];
    luminous += other.luminous;
    luminous_squared += other.luminous_squared;
    x += other.x;
    y += other.y;
    xx += other.xx;
    xy += other.xy;
    yy += other.yy;
    extent += other.extent;
}

Moments LightSums::central() const {
    const double mean_x = x / luminous;
    const double mean_y = y / luminous;
    return {xx / luminous - mean_x * mean_x, xy / luminous - mean_x * mean_y,
            yy / luminous - mean_y * mean_y};
}

bool BrightPixels::add(int x, int y, double share, LightSums& sums) const {
    PixelRay ray;
    if (!geometry_.ray(x + 0.5, y + 0.5, ray)) return false;
    std::array<float, 3> rgb;
    for (int c = 0; c < 3; ++c) {
        rgb[static_cast<std::size_t>(c)] =
            usable(picture_.at(x, y, picture_.channels == 1 ? 0 : c));
    }
    const double value = static_cast<double>(luminance(rgb[0], rgb[1], rgb[2]));
    // smoothstep from the threshold to twice it.
    const double t = std::clamp(value / static_cast<double>(threshold_) - 1, 0.0, 1.0);
    const double ramp = t * t * (3 - 2 * t);
    const double weight = share * ramp * ray.solid_angle_sr;
    const double luminous = weight * value;
    for (std::size_t c = 0; c < 3; ++c) sums.energy[c] += weight * static_cast<double>(rgb[c]);
    sums.luminous += luminous;
    sums.luminous_squared += luminous * ramp * value;
    sums.x += luminous * ray.tan_x;
    sums.y += luminous * ray.tan_y;
    sums.xx += luminous * (ray.tan_x * ray.tan_x + ray.extent.xx);
    sums.xy += luminous * (ray.tan_x * ray.tan_y + ray.extent.xy);
    sums.yy += luminous * (ray.tan_y * ray.tan_y + ray.extent.yy);
    sums.extent += luminous * ray.extent.trace();
    return true;
}

void luminance_row(const ConstImageView& picture, int y, float* out) {
    const float* r = picture.data + picture.offset(0, y, 0);
    if (picture.channels == 1) {
        for (int x = 0; x < picture.width; ++x) {
            const float value = usable(r[x * picture.pixel_stride]);
            out[x] = luminance(value, value, value);
        }
        return;
    }
    const float* g = r + picture.channel_stride;
    const float* b = g + picture.channel_stride;
    if (picture.pixel_stride == 1) {  // the same, in vector registers
        for (int x = 0; x < picture.width; ++x) {
            out[x] = luminance(usable(r[x]), usable(g[x]), usable(b[x]));
        }
        return;
    }
    for (int x = 0; x < picture.width; ++x) {
        const std::ptrdiff_t i = x * picture.pixel_stride;
        out[x] = luminance(usable(r[i]), usable(g[i]), usable(b[i]));
    }
}

Regions find_regions(const BrightPixels& pixels) {
    const auto rows = static_cast<std::size_t>(pixels.picture().height);
    std::vector<std::vector<float>> scratch(static_cast<std::size_t>(max_workers()));
    std::vector<std::vector<Run>> row_runs(rows);
    std::vector<std::vector<LightSums>> row_sums(rows);
    parallel_for(rows, [&](std::size_t y, int worker) {
        auto& values = scratch[static_cast<std::size_t>(worker)];
        values.resize(static_cast<std::size_t>(pixels.picture().width));
        scan_row(pixels, static_cast<int>(y), values, row_runs[y], row_sums[y]);
    });

    Regions result;
    std::vector<LightSums> run_sums;
    std::vector<std::size_t> parents;
    std::size_t above = 0;  // first run of the row above
    for (std::size_t y = 0; y < rows; ++y) {
        const std::size_t first = result.runs.size();
        result.runs.insert(result.runs.end(), row_runs[y].begin(), row_runs[y].end());
        run_sums.insert(run_sums.end(), row_sums[y].begin(), row_sums[y].end());
        parents.resize(result.runs.size());
        std::iota(parents.begin() + static_cast<std::ptrdiff_t>(first), parents.end(), first);
        // Both rows are sorted: whichever run ends first is done with. Corners touch.
        std::size_t i = above;
        std::size_t j = first;
        while (i < first && j < result.runs.size()) {
            const Run& upper = result.runs[i];
            const Run& lower = result.runs[j];
            if (upper.begin <= lower.end && lower.begin <= upper.end) {
                const std::size_t a = root_of(parents, i);
                const std::size_t b = root_of(parents, j);
                parents[std::max(a, b)] = std::min(a, b);
            }
            if (upper.end < lower.end) {
                ++i;
            } else {
                ++j;
            }
        }
        above = first;
    }
    // A root comes before all others of its set.
    for (std::size_t i = 0; i < result.runs.size(); ++i) {
        const std::size_t root = root_of(parents, i);
        if (root == i) {
            result.runs[i].region = static_cast<int>(result.sums.size());
            result.sums.emplace_back();
        } else {
            result.runs[i].region = result.runs[root].region;
        }
        result.sums[static_cast<std::size_t>(result.runs[i].region)].add(run_sums[i]);
    }
    return result;
}

}  // namespace aureole::sources
