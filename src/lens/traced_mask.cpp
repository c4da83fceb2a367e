#include "lens/traced_mask.h"

#include <algorithm>
#include <cmath>

namespace aureole::lens {

TracedMask::TracedMask(const Iris& iris, const Occluder* occluder, const Image& texture)
    : iris_(iris), texture_(texture) {
    if (occluder) occluder_.emplace(*occluder);
}

float TracedMask::inner_radius() const noexcept {
    return texture_.empty() ? static_cast<float>(iris_.inner_radius()) : 0.0F;
}

float TracedMask::outer_radius() const noexcept {
    return texture_.empty() ? static_cast<float>(iris_.outer_radius()) : std::sqrt(2.0F);
}

MeshMask TracedMask::mesh_mask() const noexcept {
    MeshMask mask;
    mask.iris = field();
    mask.open = !texture_.empty() || iris_.is_image();
    if (mask.open || occluder_) {
        mask.extra = &transmit;
        mask.context = this;
    }
    return mask;
}

// Bilinear over [-1, 1]^2, 0 outside.
float TracedMask::texture_at(float u, float v) const noexcept {
    const int w = texture_.width();
    const int h = texture_.height();
    const float x = 0.5F * (u + 1) * static_cast<float>(w) - 0.5F;
    const float y = 0.5F * (1 - v) * static_cast<float>(h) - 0.5F;
    if (!(std::abs(u) <= 1 && std::abs(v) <= 1)) return 0;
    const int x0 = std::clamp(static_cast<int>(std::floor(x)), 0, w - 1);
    const int y0 = std::clamp(static_cast<int>(std::floor(y)), 0, h - 1);
    const int x1 = std::min(x0 + 1, w - 1);
    const int y1 = std::min(y0 + 1, h - 1);
    const float px = std::clamp(x - static_cast<float>(x0), 0.0F, 1.0F);
    const float py = std::clamp(y - static_cast<float>(y0), 0.0F, 1.0F);
    const float upper = texture_.at(x0, y0) + px * (texture_.at(x1, y0) - texture_.at(x0, y0));
    const float lower = texture_.at(x0, y1) + px * (texture_.at(x1, y1) - texture_.at(x0, y1));
    return upper + py * (lower - upper);
}

void TracedMask::transmit(const void* context, const float* u, const float* v,
                          const float* iris_width, const float* entrance_x, const float* entrance_y,
                          float entrance_width, int count, float* light) {
    const auto& mask = *static_cast<const TracedMask*>(context);
    for (int k = 0; k < count; ++k) {
        if (light[k] <= 0) continue;
        if (!mask.texture_.empty()) {
            light[k] *= mask.texture_at(u[k], v[k]);
        } else if (mask.iris_.is_image()) {
            light[k] *= mask.iris_.image_transmission(u[k], v[k], iris_width[k]);
        }
        if (mask.occluder_) {
            light[k] *= mask.occluder_->transmission(entrance_x[k], entrance_y[k], entrance_width);
        }
    }
}

}  // namespace aureole::lens
