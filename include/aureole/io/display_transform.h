// From linear scene values to a display through OpenColorIO. The tone curves that need no
// OpenColorIO are in color/tone_curve.h.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "aureole/image/image.h"

namespace aureole::io {

// What of an OpenColorIO configuration to use.
struct OcioSettings {
    std::string config;       // file; empty: the environment variable OCIO
    std::string input_space;  // colour space or role of the picture; empty: role scene_linear
    std::string display;      // empty: the configuration's default
    std::string view;         // empty: the default view of the display
};

// Constructed once, then applied to any number of pictures, from any number of threads.
class DisplayTransform {
  public:
    // The ACES 1.x output transform for a standard display: linear sRGB (D65) -> ACES2065-1 ->
    // RRT and ODT "SDR-VIDEO" -> sRGB encoding. Grey stays grey; .18 becomes .356, 1 becomes .812,
    // 16.3 reaches 1.
    static DisplayTransform aces();

    // A display and view of a configuration.
    // Throws FileError if there is no configuration or it cannot be read, InvalidArgument (naming
    // what the configuration offers) for an unknown space, display or view.
    static DisplayTransform ocio(const OcioSettings& settings);

    // `rgb` and `out` have 3 channels and equal size, and may be the same memory. `exposure_scale`
    // multiplies the input first (2^EV). The result is encoded for the display; values beyond
    // [0, 1] may remain and are clipped by write_picture().
    void apply(const ConstImageView& rgb, const ImageView& out,
               float exposure_scale) const noexcept;

  private:
    struct Impl;
    explicit DisplayTransform(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
    std::shared_ptr<const Impl> impl_;
};

}  // namespace aureole::io
