#include <algorithm>
#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/lens/iris.h"
#include "lens/iris_pyramid.h"

namespace aureole::lens {

Occluder::Occluder(const ConstImageView& transmission, double diameter_mm)
    : diameter_mm_(diameter_mm) {
    if (!(diameter_mm > 0) || !std::isfinite(diameter_mm)) {
        throw InvalidArgument("occluder diameter (mm)", std::to_string(diameter_mm),
                              "must be positive and finite");
    }
    pyramid_ = transmission_pyramid(transmission_of(transmission, "occluder picture"), 1);
    const float* const first = image().plane(0);
    if (std::none_of(first, first + image().pixels(), [](float t) { return t > 0; })) {
        throw InvalidArgument("occluder picture", "all black", "must let some light through");
    }
    pixels_per_mm_ = std::min(transmission.width, transmission.height) / diameter_mm;
}

float Occluder::transmission(float x_mm, float y_mm, float footprint_mm) const noexcept {
    const auto scale = static_cast<float>(pixels_per_mm_);
    return sample(pyramid_, 0.5F * static_cast<float>(image().width()) + x_mm * scale,
                  0.5F * static_cast<float>(image().height()) - y_mm * scale, footprint_mm * scale,
                  1);
}

}  // namespace aureole::lens
