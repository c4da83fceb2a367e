#include "aureole/io/supersampling.h"

#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/image/resample.h"
#include "io/picture_metadata.h"

namespace aureole::io {
namespace {

bool divides(int n, const Window& window) {
    return window.x % n == 0 && window.y % n == 0 && window.width % n == 0 &&
           window.height % n == 0;
}

// One value of each n x n, the middle one.
template <class From, class To>
void keep_middle(const From* from, int n, int width, int height, To* to) {
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto row = static_cast<std::size_t>(n) * static_cast<std::size_t>(width);
            *to++ = from[static_cast<std::size_t>(n * y + n / 2) * row +
                         static_cast<std::size_t>(n * x + n / 2)];
        }
    }
}

}  // namespace

void average_samples(Picture& picture, int n) {
    if (n < 1) throw InvalidArgument("supersampling", fmt::format("{}", n), "must be positive");
    if (n == 1) return;
    const Window display = picture.display_window();
    const Window data = picture.data_window();
    for (const Window& window : {display, data}) {
        if (divides(n, window)) continue;
        throw InvalidArgument(
            "supersampling", fmt::format("{}", n),
            fmt::format("must divide the windows of the picture, and one is {}x{} "
                        "pixels at ({}, {})",
                        window.width, window.height, window.x, window.y));
    }
    if (picture.other_parts() > 0) {
        throw InvalidArgument("supersampling", fmt::format("{}", n),
                              fmt::format("cannot be of a file with other parts, whose size would "
                                          "stay, and there are {}",
                                          picture.other_parts()));
    }
    Image smaller = area_average(picture.image(), n);
    const int averaged = picture.color_channels() + (picture.alpha_channel() < 0 ? 0 : 1);
    PictureMetadata& metadata = PictureAccess::own_metadata(picture);
    for (int c = averaged; c < smaller.channels(); ++c) {
        keep_middle(picture.image().plane(c), n, smaller.width(), smaller.height(),
                    smaller.plane(c));
        auto& exact = metadata.storage[static_cast<std::size_t>(c)].exact;
        if (!exact) continue;
        const auto ids = std::make_shared<std::vector<std::uint32_t>>(smaller.pixels());
        keep_middle(exact->data(), n, smaller.width(), smaller.height(), ids->data());
        exact = ids;
    }
    picture.image() = std::move(smaller);
    picture.set_data_origin(data.x / n, data.y / n);
    picture.set_display_window(
        {display.x / n, display.y / n, display.width / n, display.height / n});
}

}  // namespace aureole::io
