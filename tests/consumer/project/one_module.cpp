#include <aureole/image/view.h>

#include <cmath>

// A 60 degree picture of 1920 pixels has its focal length at 960 / tan(30 deg) pixels.
int main() {
    const auto view = aureole::View::from_fov(1920, 1080, 60, aureole::Projection::kPerspective);
    return std::abs(view.focal_length_px() - 960 * std::sqrt(3.0)) < 1e-6 ? 0 : 1;
}
