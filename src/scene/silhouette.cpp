#include "scene/silhouette.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/parallel.h"

namespace aureole::scene {
namespace {

constexpr int kBand = 16;  // rows painted by one task

void paint_band(const Stroke& s, int first_row, int last_row, Image& picture) {
    const float widest = std::max(s.radius_from, s.radius_to) + 1;
    const auto low_y = static_cast<int>(std::floor(std::min(s.from.y, s.to.y) - double{widest}));
    const auto high_y = static_cast<int>(std::ceil(std::max(s.from.y, s.to.y) + double{widest}));
    const auto low_x = static_cast<int>(std::floor(std::min(s.from.x, s.to.x) - double{widest}));
    const auto high_x = static_cast<int>(std::ceil(std::max(s.from.x, s.to.x) + double{widest}));
    const auto ax = static_cast<float>(s.to.x - s.from.x);
    const auto ay = static_cast<float>(s.to.y - s.from.y);
    const float squared = std::max(ax * ax + ay * ay, 1e-6F);
    const float inverse_length = 1 / std::sqrt(squared);
    for (int y = std::max(low_y, first_row); y < std::min(high_y, last_row); ++y) {
        for (int x = std::max(low_x, 0); x < std::min(high_x, picture.width()); ++x) {
            const float px = static_cast<float>(x + 0.5 - s.from.x);
            const float py = static_cast<float>(y + 0.5 - s.from.y);
            const float free = (px * ax + py * ay) / squared;
            const float along = clamp01(free);
            const float dx = px - along * ax;
            const float dy = py - along * ay;
            const float distance = std::sqrt(dx * dx + dy * dy);
            float ends = 1;
            if (s.flat) {
                const float beyond = (std::abs(free - 0.5F) - 0.5F) / inverse_length;
                ends = clamp01(0.5F - beyond);
            }
            const float radius = mix(s.radius_from, s.radius_to, along);
            // A pixel-wide edge; strokes thinner than a pixel become transparent instead.
            const float cover =
                clamp01(radius + 0.5F - distance) * std::min(1.0F, 2 * radius + 0.02F) * ends;
            if (cover <= 0) continue;
            const float across = (px * ay - py * ax) * inverse_length / std::max(radius, 0.5F);
            const float shade = 1 + s.shading * std::clamp(across, -1.0F, 1.0F);
            const float values[] = {s.radiance.x * shade, s.radiance.y * shade,
                                    s.radiance.z * shade};
            for (int c = 0; c < 3; ++c) {
                float& v = picture.at(x, y, c);
                v += cover * (values[c] - v);
            }
        }
    }
}

}  // namespace

bool project_stroke(const Camera& camera, Vec3 from, Vec3 to, float radius_from, float radius_to,
                    Vec3 radiance, float shading, std::vector<Stroke>& strokes, bool flat) {
    const float depth_from = camera.depth(from);
    const float depth_to = camera.depth(to);
    const auto a = camera.project(from);
    const auto b = camera.project(to);
    if (!a || !b || depth_from < 0.3F || depth_to < 0.3F) return false;
    strokes.push_back({*a, *b, radius_from / (depth_from * camera.pixel_size()),
                       radius_to / (depth_to * camera.pixel_size()), 0.5F * (depth_from + depth_to),
                       radiance, shading, flat});
    return true;
}

void paint(std::vector<Stroke>& strokes, Image& picture) {
    std::stable_sort(strokes.begin(), strokes.end(),
                     [](const Stroke& a, const Stroke& b) { return a.depth > b.depth; });
    const auto bands = static_cast<std::size_t>((picture.height() + kBand - 1) / kBand);
    parallel_for(bands, [&](std::size_t band, int) {
        const int first = static_cast<int>(band) * kBand;
        const int last = std::min(first + kBand, picture.height());
        for (const Stroke& stroke : strokes) paint_band(stroke, first, last, picture);
    });
}

}  // namespace aureole::scene
