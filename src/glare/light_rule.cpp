#include "glare/light_rule.h"

#include <cstddef>

#include "aureole/color/tone_curve.h"
#include "aureole/sources/threshold.h"

namespace aureole::glare {

void LightRule::row(const ConstImageView& in, int y, const float* matte, const ImageView& to,
                    int to_y) const noexcept {
    const float* factors =
        matte == nullptr ? nullptr
                         : matte + static_cast<std::size_t>(y) * static_cast<std::size_t>(in.width);
    const float exposure = options_.exposure_scale;
    for (int x = 0; x < in.width; ++x) {
        const float factor = factors == nullptr ? 1.0F : factors[x];
        if (!options_.source_curve) {
            for (int c = 0; c < in.channels; ++c) {
                to.at(x, to_y, c) = sources::ramp(in.at(x, y, c), options_.threshold) * factor;
            }
            continue;
        }
        const int last = in.channels - 1;
        const color::Rgbf shown = color::tone_map(
            *options_.source_curve, {exposure * in.at(x, y, 0), exposure * in.at(x, y, last / 2),
                                     exposure * in.at(x, y, last)});
        for (int c = 0; c < in.channels; ++c) {
            to.at(x, to_y, c) =
                sources::ramp(shown[static_cast<std::size_t>(c)], options_.threshold) * factor /
                exposure;
        }
    }
}

}  // namespace aureole::glare
