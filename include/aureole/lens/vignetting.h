// How much of the light from off the axis reaches the sensor.
#pragma once

#include <span>
#include <vector>

#include "aureole/lens/lens.h"

namespace aureole::lens {

struct FieldPoint {
    double angle_deg = 0;        // of the light, upwards from the axis
    double image_height_mm = 0;  // of the chief ray (through the middle of the light that passes)
    double distortion = 0;       // image height / (EFL tan angle) - 1; 0 on the axis
    double open_area_mm2 = 0;    // of the beam that passes all apertures, across its direction
    double relative_area = 0;    // the same over that on the axis: vignetting
    double transmission = 0;     // mean over that beam of what coatings let through
    double relative_illumination = 0;  // irradiance on the sensor over that on the axis
};

// Exact rays, `rays_per_side`^2 over the front element. Angles in [0, 90),
// rays_per_side in [8, 4096].
// Throws InvalidArgument for values outside.
std::vector<FieldPoint> field_sweep(const Lens& lens, std::span<const double> angles_deg,
                                    double wavelength_nm, int rays_per_side = 201);

}  // namespace aureole::lens
