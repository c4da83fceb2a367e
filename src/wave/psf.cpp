#include "aureole/wave/psf.h"

#include <string>

#include "aureole/base/error.h"

namespace aureole::wave {

KernelGrid KernelGrid::full_reach(const View& view) {
    return {2 * view.width - 1, 2 * view.height - 1, view.pitch_deg, view.projection};
}

KernelGrid KernelGrid::square(const View& view, int size) {
    if (size < 1 || size % 2 == 0) {
        throw InvalidArgument("kernel size", std::to_string(size), "must be odd and positive");
    }
    return {size, size, view.pitch_deg, view.projection};
}

View KernelGrid::view() const {
    View view;
    view.width = width;
    view.height = height;
    view.projection = projection;
    view.pitch_deg = pitch_deg;
    view.axis_x = width / 2.0;
    view.axis_y = height / 2.0;
    return view;
}

}  // namespace aureole::wave
