// What luminance an eye may adapt to when it looks at a picture.
#pragma once

#include "aureole/image/image.h"
#include "aureole/image/view.h"

namespace aureole::eye {

// Mean of the pixels' luminances, negative ones as 0, in units of the picture. 1 channel (taken as
// luminance) or 3 (linear sRGB); at least one pixel.
double mean_luminance(const ConstImageView& picture);

// In cd/m2.
struct MeteredLuminance {
    double mean = 0;
    double log_mean = 0;  // exp of the mean of ln L, L at least kDarknessCdM2: of the typical pixel
    double central = 0;  // mean within kCentralRadiusDeg of the optical axis; the mean of all if no
                         // pixel's centre lies there
};
inline constexpr double kCentralRadiusDeg = 5;

// `white_luminance_cd_m2`: what pixel value 1 means. The view has the size of the picture.
MeteredLuminance meter(const ConstImageView& picture, const View& view,
                       double white_luminance_cd_m2);

}  // namespace aureole::eye
