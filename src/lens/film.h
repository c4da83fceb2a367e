// From the sensor to the picture.
#pragma once

#include "aureole/base/units.h"
#include "aureole/image/view.h"
#include "aureole/lens/lens.h"

namespace aureole::lens {

// The sensor of a lens as the pixels of a view. The image is turned by half a turn, as it is in
// every camera: sensor +X is picture left, sensor +Y is picture down.
struct Film {
    int width = 0;  // pixels
    int height = 0;
    double axis_x = 0;  // continuous pixel coordinates of the optical axis
    double axis_y = 0;
    double mm_per_px = 0;
    // Irradiance on the sensor per radiance of the scene on the axis, without the transmission of
    // the glass: pi / (4 N^2).
    double irradiance_per_radiance = 0;

    Film(const Lens& lens, const View& view)
        : width(view.width),
          height(view.height),
          axis_x(view.axis_x),
          axis_y(view.axis_y),
          mm_per_px(lens.efl_mm() / view.focal_length_px()),
          irradiance_per_radiance(kPi / (4 * lens.f_number() * lens.f_number())) {}

    double px(double sensor_x_mm) const { return axis_x - sensor_x_mm / mm_per_px; }
    double py(double sensor_y_mm) const { return axis_y + sensor_y_mm / mm_per_px; }
};

}  // namespace aureole::lens
