#include "lens/matrix_pupil.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "lens/iris_pyramid.h"

namespace aureole::lens {

float Pupil::iris_picture(float u, float v, float footprint) const noexcept {
    return iris->is_image() ? iris->image_transmission(u, v, footprint) : 1.0F;
}

float Pupil::pictures(const Entrance& entrance, float u, float v, float footprint) const noexcept {
    float product = 1;
    if (texture != nullptr) {
        const Image& image = texture->front();
        const float half_width = 0.5F * static_cast<float>(image.width());
        const float half_height = 0.5F * static_cast<float>(image.height());
        product = sample(*texture, half_width * (1 + u), half_height * (1 - v),
                         footprint * std::sqrt(half_width * half_height), 0);
    } else {
        product = iris_picture(u, v, footprint);
    }
    if (occluder != nullptr && product > 0) {
        product *= occluder->transmission(
            entrance.x0 + entrance.x_per_u * u, entrance.y0 + entrance.y_per_v * v,
            footprint * std::sqrt(std::abs(entrance.x_per_u * entrance.y_per_v)));
    }
    return product;
}

float Pupil::outer_radius(float footprint) const noexcept {
    if (texture == nullptr && !iris->is_image()) return static_cast<float>(iris->outer_radius());
    // A texel of a pyramid is up to twice the footprint wide, and interpolation doubles that.
    const float reach = texture != nullptr ? std::numbers::sqrt2_v<float>
                                           : static_cast<float>(iris->outer_radius());
    return reach + 4 * footprint;
}

TransmissionPyramid texture_pyramid(const Image& texture) {
    Image clean(texture.width(), texture.height(), 1);
    for (int y = 0; y < texture.height(); ++y) {
        for (int x = 0; x < texture.width(); ++x) {
            const float value = texture.at(x, y, 0);
            clean.at(x, y) = std::isfinite(value) && value > 0 ? value : 0.0F;
        }
    }
    return transmission_pyramid(std::move(clean), 0);
}

}  // namespace aureole::lens
