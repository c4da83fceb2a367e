#include "lens/iris_pyramid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "aureole/base/error.h"

namespace aureole::lens {
namespace {

float texel(const Image& image, int x, int y, float outside) {
    const bool inside = x >= 0 && y >= 0 && x < image.width() && y < image.height();
    return inside ? image.at(x, y) : outside;
}

// (x, y) in texels; far away it is pulled to where all is `outside`, so that it fits an int.
float bilinear(const Image& image, float x, float y, float outside) {
    x = std::clamp(x - 0.5F, -2.0F, static_cast<float>(image.width()) + 1);
    y = std::clamp(y - 0.5F, -2.0F, static_cast<float>(image.height()) + 1);
    const float floor_x = std::floor(x);
    const float floor_y = std::floor(y);
    const int i = static_cast<int>(floor_x);
    const int j = static_cast<int>(floor_y);
    const float fx = x - floor_x;
    const float fy = y - floor_y;
    const float top = (1 - fx) * texel(image, i, j, outside) + fx * texel(image, i + 1, j, outside);
    const float bottom =
        (1 - fx) * texel(image, i, j + 1, outside) + fx * texel(image, i + 1, j + 1, outside);
    return (1 - fy) * top + fy * bottom;
}

Image half_of(const Image& image, float outside) {
    Image half((image.width() + 1) / 2, (image.height() + 1) / 2, 1);
    for (int y = 0; y < half.height(); ++y) {
        for (int x = 0; x < half.width(); ++x) {
            half.at(x, y) = 0.25F * (texel(image, 2 * x, 2 * y, outside) +
                                     texel(image, 2 * x + 1, 2 * y, outside) +
                                     texel(image, 2 * x, 2 * y + 1, outside) +
                                     texel(image, 2 * x + 1, 2 * y + 1, outside));
        }
    }
    return half;
}

}  // namespace

Image transmission_of(const ConstImageView& picture, const char* what) {
    if (picture.data == nullptr || picture.width < 1 || picture.height < 1 ||
        picture.channels < 1) {
        throw InvalidArgument(what,
                              std::to_string(picture.width) + " x " +
                                  std::to_string(picture.height) + " pixels, " +
                                  std::to_string(picture.channels) + " channels",
                              "must not be empty");
    }
    Image image(picture.width, picture.height, 1);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const float value =
                picture.channels < 3
                    ? picture.at(x, y, 0)
                    : (picture.at(x, y, 0) + picture.at(x, y, 1) + picture.at(x, y, 2)) / 3;
            image.at(x, y) = value > 0 ? std::min(value, 1.0F) : 0.0F;
        }
    }
    return image;
}

TransmissionPyramid transmission_pyramid(Image level_0, float outside) {
    TransmissionPyramid pyramid;
    pyramid.push_back(std::move(level_0));
    while (pyramid.back().width() > 1 || pyramid.back().height() > 1) {
        pyramid.push_back(half_of(pyramid.back(), outside));
    }
    return pyramid;
}

float sample(const TransmissionPyramid& pyramid, float x, float y, float footprint_px,
             float outside) noexcept {
    const float level = footprint_px > 1 ? std::log2(footprint_px) : 0.0F;
    const auto last = pyramid.size() - 1;
    const auto fine = std::min(static_cast<std::size_t>(std::min(level, 30.0F)), last);
    const auto at_level = [&](std::size_t l) {
        const float scale = 1 / static_cast<float>(1U << l);
        return bilinear(pyramid[l], x * scale, y * scale, outside);
    };
    const float between = level - static_cast<float>(fine);
    const float value = at_level(fine);
    if (between <= 0 || fine == last) return value;
    return value + between * (at_level(fine + 1) - value);
}

}  // namespace aureole::lens
