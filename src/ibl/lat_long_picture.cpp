#include <algorithm>
#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/ibl/cube_sampler.h"
#include "aureole/ibl/lat_long.h"

namespace aureole::ibl {

Image lat_long_from_cube(const CubeMap& map, int width) {
    if (width < 2 || width > 65536 || width % 2 != 0) {
        throw InvalidArgument("width", std::to_string(width), "must be even, 2 to 65536");
    }
    if (map.empty()) throw InvalidArgument("map", "empty", "must have texels");
    const int height = width / 2;
    Image picture(width, height, 3);
    const CubeSampler sampler({map});
    // A texel is a quarter of a turn over size wide on the mean, and 2/3 of that in corners.
    const int down = std::max(2, (8 * map.size() + height - 1) / height);
    parallel_for(static_cast<std::size_t>(height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        const double round = std::sin(kPi * (y + 0.5) / height);  // radius of the row
        const int across = std::max(2, static_cast<int>(std::ceil(down * round)));
        for (int x = 0; x < width; ++x) {
            double sum[3] = {};
            double weights = 0;
            for (int j = 0; j < down; ++j) {
                const double v = y + (j + 0.5) / down;
                const double weight = std::sin(kPi * v / height);
                for (int i = 0; i < across; ++i) {
                    const auto rgb =
                        sampler.sample(direction_of({x + (i + 0.5) / across, v}, width, height), 0);
                    for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * double{rgb[c]};
                }
                weights += weight * across;
            }
            for (int c = 0; c < 3; ++c) {
                picture.at(x, y, c) = static_cast<float>(sum[c] / weights);
            }
        }
    });
    return picture;
}

}  // namespace aureole::ibl
