// From linear results to pictures for a display: --tone-map, --exposure, --antialias, --ocio-*.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "aureole/image/image.h"
#include "aureole/io/display_transform.h"
#include "aureole/io/picture.h"

namespace aureole::app {

class DisplayOptions {
  public:
    void add_options(CLI::App& command);
    // Loads what the options need (an OpenColorIO configuration), so that errors come before the
    // work. `outputs` are the files that will be written: a tone curve that was asked for needs a
    // PNG or JPEG among them. Throws InvalidArgument, FileError.
    void prepare(const std::vector<std::string>& outputs);
    // Exposure in EV: --exposure, else the attribute aureole:exposure_ev of the picture if it is
    // within +-100, else 0.
    double exposure_ev(const io::Picture& picture) const;
    const std::string& tone_map() const { return tone_map_; }
    const std::string& antialias() const { return antialias_; }

    // Encodes 1 or 3 linear channels for the display, in [0, 1].
    Image encode(const ConstImageView& linear, double exposure_ev) const;

  private:
    std::string tone_map_ = "hill";
    CLI::Option* tone_map_option_ = nullptr;
    std::string antialias_ = "none";
    CLI::Option* antialias_option_ = nullptr;
    std::vector<CLI::Option*> ocio_options_;
    std::optional<double> exposure_ev_;
    io::OcioSettings ocio_;
    std::unique_ptr<io::DisplayTransform> transform_;
};

}  // namespace aureole::app
