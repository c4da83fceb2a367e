#include "glare/luminance_kernel.h"

#include <cstddef>

#include "aureole/base/parallel.h"
#include "aureole/color/rgb.h"

namespace aureole::glare {

Image luminance_kernel(const Image& kernel) {
    Image grey(kernel.width(), kernel.height(), 1);
    const auto& w = color::kLuminanceWeights;
    parallel_for(static_cast<std::size_t>(kernel.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < kernel.width(); ++x) {
            grey.at(x, y) = static_cast<float>(
                w[0] * kernel.at(x, y, 0) + w[1] * kernel.at(x, y, 1) + w[2] * kernel.at(x, y, 2));
        }
    });
    return grey;
}

}  // namespace aureole::glare
