// From float samples to those of a file: internal to the module.
#pragma once

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <vector>

#include "aureole/io/picture.h"

namespace aureole::io {

enum class Encoding {
    kExr,      // half, float or uint by channel
    kFloat,    // as it is
    kRgbe,     // float, rounded to what the shared exponent of HDR files can hold
    kDisplay,  // 8 bits of [0, 1]
};

// Turns rows of a picture into the native samples of `spec`, pixel by pixel.
class RowEncoder {
  public:
    // `channels`: which of the picture's; `window`: what part of the plane, zero where the picture
    // has no data. `picture` and `spec` must outlive the encoder.
    RowEncoder(const Picture& picture, Encoding encoding, const std::vector<int>& channels,
               const OIIO::ImageSpec& spec, const Window& window);

    std::size_t row_bytes() const { return row_bytes_; }
    // Row `y` of the window. Returns how many finite samples were clipped.
    std::size_t encode(int y, std::byte* out) const;

  private:
    const Picture& picture_;
    Encoding encoding_;
    const std::vector<int>& channels_;
    const OIIO::ImageSpec& spec_;
    Window window_;
    std::size_t pixel_bytes_;
    std::size_t row_bytes_;
};

}  // namespace aureole::io
