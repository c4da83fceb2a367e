#include "io/decode.h"

#include <cmath>
#include <utility>

#include "aureole/base/parallel.h"
#include "aureole/color/rgb.h"

namespace aureole::io {
namespace {

// The exponent that decodes the file; 0 stands for sRGB.
float decoding_gamma(const OIIO::ImageSpec& spec) {
    if (spec.format.is_floating_point()) return 1;
    const OIIO::string_view space = spec.get_string_attribute("oiio:ColorSpace");
    if (OIIO::Strutil::iequals(space, "linear")) return 1;
    const float gamma = spec.get_float_attribute("oiio:Gamma", 0.0F);
    // PNG files of sRGB also carry its approximation by a power, 1 / 0.45455.
    const bool srgb = gamma <= 0 || std::abs(gamma - 2.2F) < 0.01F;
    return srgb ? 0 : gamma;
}

float decode(float value, float gamma) {
    if (gamma == 1) return value;
    if (gamma == 0) return color::srgb_decode(value);
    return std::copysign(std::pow(std::abs(value), gamma), value);
}

bool alpha_is_unmultiplied(const OIIO::ImageSpec& spec) {
    if (spec.get_int_attribute("tiff:UnassociatedAlpha") != 0) return true;
    // Set by readers of formats that define it so (PNG) when asked not to multiply.
    return spec.get_int_attribute("oiio:UnassociatedAlpha") != 0;
}

}  // namespace

void linearize(const OIIO::ImageSpec& spec, const ColorChannels& channels, Image& image) {
    const float gamma = decoding_gamma(spec);
    const bool unmultiplied = channels.alpha >= 0 && alpha_is_unmultiplied(spec);
    if (gamma == 1 && !unmultiplied) return;
    parallel_for(static_cast<std::size_t>(image.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        const float* alpha = channels.alpha >= 0 ? image.row(y, channels.alpha) : nullptr;
        for (const int c : channels.color) {
            float* values = image.row(y, c);
            for (int x = 0; x < image.width(); ++x) {
                // A transfer function belongs to the colour itself, not to its product with alpha.
                const float a = alpha != nullptr ? alpha[x] : 1.0F;
                const float divisor = unmultiplied || a <= 0 ? 1.0F : a;
                const float factor = unmultiplied ? a : divisor;
                values[x] = decode(values[x] / divisor, gamma) * factor;
            }
        }
    });
}

Image upright(Image image, int orientation) {
    if (orientation <= 1 || orientation > 8) return image;
    const bool swapped = orientation >= 5;  // rows of the file are columns of the picture
    // Exif 2.3, tag 274: which side of the picture row 0 and column 0 of the file are.
    const bool row_from_end =
        orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    const bool column_from_end =
        orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    const int width = swapped ? image.height() : image.width();
    const int height = swapped ? image.width() : image.height();
    Image result(width, height, image.channels());
    for (int c = 0; c < image.channels(); ++c) {
        for (int v = 0; v < image.height(); ++v) {
            const float* row = image.row(v, c);
            const int along_rows = row_from_end ? image.height() - 1 - v : v;
            for (int u = 0; u < image.width(); ++u) {
                const int along_columns = column_from_end ? image.width() - 1 - u : u;
                result.at(swapped ? along_rows : along_columns,
                          swapped ? along_columns : along_rows, c) = row[u];
            }
        }
    }
    return result;
}

}  // namespace aureole::io
