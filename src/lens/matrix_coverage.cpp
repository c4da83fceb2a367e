// The plain form of what the kernels draw.
#include <algorithm>
#include <cmath>
#include <utility>

#include "lens/blog_look.h"
#include "lens/matrix_ghosts.h"

namespace aureole::lens {
namespace {

// An aperture at (0, 0) with radius 1 in its own coordinates, of which a pixel is (sx, sy) wide.
struct Aperture {
    float sx, sy;
    float edge;    // softening, own units
    float radius;  // of the part of its boundary that straightens corners: see OutlinePart::shift

    // From the signed distance in own units and how fast it grows per pixel.
    float coverage(float distance, float growth_per_px) const {
        const float scale = std::sqrt(std::abs(sx * sy));
        const float half = std::sqrt(0.25F + edge * edge / (scale * scale));
        const float shift = std::min(half * half * scale / (6 * radius), 0.5F * half);
        return std::clamp(0.5F - (distance / growth_per_px + shift) / (2 * half), 0.0F, 1.0F);
    }
};

float disc_coverage(const Aperture& aperture, float u, float v) {
    const float q = std::hypot(u, v);
    const float growth =
        q > 1e-6F ? std::hypot(u * aperture.sx, v * aperture.sy) / q : std::abs(aperture.sx);
    return aperture.coverage(q - 1, growth);
}

float iris_coverage(const Iris& iris, const Aperture& aperture, float u, float v) {
    if (iris.is_image()) {
        return iris.image_transmission(u, v, std::sqrt(std::abs(aperture.sx * aperture.sy)));
    }
    float growth = std::abs(aperture.sx);
    if (std::abs(aperture.sx) != std::abs(aperture.sy)) {
        const float along_x =
            iris.distance(u + 0.5F * aperture.sx, v) - iris.distance(u - 0.5F * aperture.sx, v);
        const float along_y =
            iris.distance(u, v + 0.5F * aperture.sy) - iris.distance(u, v - 0.5F * aperture.sy);
        growth = std::max(std::hypot(along_x, along_y), 1e-6F);
    }
    return aperture.coverage(iris.distance(u, v) - 1, growth);
}

}  // namespace

float MatrixGhost::coverage(const Iris& iris, float x, float y) const noexcept {
    if (u_per_px == 0 || v_per_px == 0) return 0;
    if (blog != nullptr) return blog->mask(*this, x, y);
    const float u = (x - center_x) * u_per_px;
    const float v = (y - center_y) * v_per_px;
    if (spot) {
        const float dx = x - open_x;
        const float dy = y - open_y;
        const float determinant = spot_xx * spot_yy - spot_xy * spot_xy;
        const float q =
            (spot_yy * dx * dx - 2 * spot_xy * dx * dy + spot_xx * dy * dy) / (8 * determinant);
        // Of unit integral over pixels: 3 / (8 pi sqrt(det)); times the open area.
        constexpr float kPeak = 3.0F / 8;
        return q < 1 ? kPeak * open_radius_px * open_radius_px / std::sqrt(determinant) * (1 - q) *
                           (1 - q)
                     : 0.0F;
    }
    const float apothem = iris.shape().blades == 0 ? 1.0F : static_cast<float>(iris.apothem());
    float least = iris_coverage(iris, {u_per_px, v_per_px, edge, apothem}, u, v);
    float pictures = 1;  // those of several crossings of an iris multiply
    if (iris.is_image()) std::swap(least, pictures);
    for (int k = 0; k < clip_count; ++k) {
        const Clip& clip = clips[k];
        const float own_u = (u - clip.u0) / clip.ru;
        const float own_v = (v - clip.v0) / clip.rv;
        const Aperture aperture = {u_per_px / clip.ru, v_per_px / clip.rv, clip.edge,
                                   clip.iris ? apothem : 1.0F};
        if (!clip.iris) {
            least = std::min(least, disc_coverage(aperture, own_u, own_v));
        } else if (iris.is_image()) {
            pictures *= iris_coverage(iris, aperture, own_u, own_v);
        } else {
            least = std::min(least, iris_coverage(iris, aperture, own_u, own_v));
        }
    }
    return least * pictures;
}

}  // namespace aureole::lens
