// Statistics over rings of a kernel, for tests.
#pragma once

#include <cmath>
#include <vector>

#include "aureole/base/units.h"
#include "aureole/wave/psf.h"

namespace aureole::eye {

struct Ring {
    double mean = 0;       // of the value
    double deviation = 0;  // standard deviation
    int pixels = 0;
};

// Of value(x, y) over the pixels whose centres are from_deg <= theta < to_deg away.
template <class Value>
Ring ring_statistics(const wave::KernelGrid& grid, double from_deg, double to_deg,
                     const Value& value) {
    const View view = grid.view();
    double sum = 0;
    double square = 0;
    Ring ring;
    for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x) {
            const double angle = view.angle_from_axis_deg(x + 0.5, y + 0.5);
            if (angle < from_deg || angle >= to_deg) continue;
            const double v = value(x, y);
            sum += v;
            square += v * v;
            ++ring.pixels;
        }
    }
    ring.mean = sum / ring.pixels;
    ring.deviation = std::sqrt(std::max(0.0, square / ring.pixels - ring.mean * ring.mean));
    return ring;
}

}  // namespace aureole::eye
