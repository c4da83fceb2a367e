#include "aureole/eye/metering.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"
#include "aureole/color/rgb.h"
#include "aureole/eye/ranges.h"

namespace aureole::eye {
namespace {

// Calls visit(luminance, x, y) for every pixel.
template <class Visit>
void over_luminances(const ConstImageView& picture, const Visit& visit) {
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const double value = picture.channels == 3
                                     ? color::luminance({picture.at(x, y, 0), picture.at(x, y, 1),
                                                         picture.at(x, y, 2)})
                                     : picture.at(x, y, 0);
            visit(std::max(value, 0.0), x, y);
        }
    }
}

}  // namespace

double mean_luminance(const ConstImageView& picture) {
    double sum = 0;
    over_luminances(picture, [&](double luminance, int, int) { sum += luminance; });
    return sum / (static_cast<double>(picture.width) * picture.height);
}

MeteredLuminance meter(const ConstImageView& picture, const View& view,
                       double white_luminance_cd_m2) {
    const double angle_rad = rad_from_deg(kCentralRadiusDeg);
    const double radius_px =
        view.focal_length_px() *
        (view.projection == Projection::kPerspective ? std::tan(angle_rad) : angle_rad);
    double logs = 0;
    double central = 0;
    double central_count = 0;
    over_luminances(picture, [&](double luminance, int x, int y) {
        logs += std::log(std::max(luminance * white_luminance_cd_m2, kDarknessCdM2));
        if (std::hypot(x + 0.5 - view.axis_x, y + 0.5 - view.axis_y) > radius_px) return;
        central += luminance;
        ++central_count;
    });
    MeteredLuminance metered;
    metered.mean = mean_luminance(picture) * white_luminance_cd_m2;
    metered.log_mean = std::exp(logs / (static_cast<double>(picture.width) * picture.height));
    metered.central =
        central_count > 0 ? central / central_count * white_luminance_cd_m2 : metered.mean;
    return metered;
}

}  // namespace aureole::eye
