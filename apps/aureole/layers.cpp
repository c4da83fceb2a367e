#include "layers.h"

#include <numeric>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/color/rgb.h"

namespace aureole::app {

Image difference(const ConstImageView& after, const ConstImageView& before) {
    Image result(after.width, after.height, after.channels);
    for (int c = 0; c < after.channels; ++c) {
        for (int y = 0; y < after.height; ++y) {
            float* out = result.row(y, c);
            for (int x = 0; x < after.width; ++x) {
                out[x] = after.at(x, y, c) - before.at(x, y, c);
            }
        }
    }
    return result;
}

void add_light(const Image& light, Image& to) {
    parallel_for(static_cast<std::size_t>(to.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < to.width(); ++x) {
            const float r = light.at(x, y, 0);
            const float g = light.at(x, y, 1);
            const float b = light.at(x, y, 2);
            if (to.channels() == 1) {
                to.at(x, y) += static_cast<float>(color::luminance({r, g, b}));
            } else {
                to.at(x, y, 0) += r;
                to.at(x, y, 1) += g;
                to.at(x, y, 2) += b;
            }
        }
    });
}

io::Picture with_color(const io::Picture& picture, const ConstImageView& color) {
    io::Picture result = picture;
    const ImageView to = result.color();
    for (int c = 0; c < to.channels; ++c) {
        for (int y = 0; y < to.height; ++y) {
            for (int x = 0; x < to.width; ++x) to.at(x, y, c) = color.at(x, y, c);
        }
    }
    return result;
}

double energy_of(const ConstImageView& image, const View& view, const Image& solid_angles) {
    const bool perspective = view.projection == Projection::kPerspective;
    const double f = view.focal_length_px();
    std::vector<double> rows(static_cast<std::size_t>(image.height));
    parallel_for(rows.size(), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        const float* weight = solid_angles.row(y, 0);
        for (int c = 0; c < image.channels; ++c) {
            for (int x = 0; x < image.width; ++x) {
                rows[row] += double{image.at(x, y, c)} * double{weight[x]};
            }
        }
    });
    return std::accumulate(rows.begin(), rows.end(), 0.0) / (perspective ? f * f : 1.0);
}

}  // namespace aureole::app
