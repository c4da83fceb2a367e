// What environments have in common, and one function per environment.
#pragma once

#include <cmath>

#include "aureole/base/units.h"
#include "aureole/scene/environment.h"
#include "scene/adaptive.h"
#include "scene/vec.h"

namespace aureole::scene {

Environment make_studio(const EnvironmentOptions& options);
Environment make_interior(const EnvironmentOptions& options);
Environment make_overcast(const EnvironmentOptions& options);
Environment make_clear_sky(const EnvironmentOptions& options);

// Of continuous pixel coordinates, by the convention of environment.h.
inline Vec3 lat_long_direction(double x, double y, int width, int height) {
    const double longitude = kPi - 2 * kPi * x / width;
    const double latitude = kPi / 2 - kPi * y / height;
    return {static_cast<float>(std::sin(longitude) * std::cos(latitude)),
            static_cast<float>(std::sin(latitude)),
            static_cast<float>(std::cos(longitude) * std::cos(latitude))};
}

// Textures take the seed as an int.
inline int texture_seed(const EnvironmentOptions& options) {
    return static_cast<int>(options.seed % 100003U) * 131;
}

// A picture of look(direction), cd/m2, antialiased. `white_cd_m2`: where the eye stops to care
// about contrast.
template <class Look>
Image render_sphere(const EnvironmentOptions& options, float white_cd_m2, const Look& look) {
    struct Nothing {};
    Image picture(options.width, options.height, 3);
    Image no_shares;
    render_adaptive<Nothing>(
        [&](double x, double y, Nothing&) {
            const Vec3 radiance = look(lat_long_direction(x, y, options.width, options.height));
            const float level = luminance(radiance);
            return Sample{radiance, std::sqrt(level / (level + white_cd_m2)), -1};
        },
        picture, no_shares);
    return picture;
}

}  // namespace aureole::scene
