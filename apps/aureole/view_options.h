// How a picture sees the world: --fov, --perspective, --white-luminance.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "aureole/image/view.h"
#include "aureole/io/picture.h"
#include "session.h"

namespace aureole::app {

class ViewOptions {
  public:
    // --fov and --perspective.
    void add_options(CLI::App& command);
    void add_white_luminance_option(CLI::App& command);
    // Throws InvalidArgument for a --fov that no picture can have.
    void check() const;

    // The view of a picture's display window, whose field of view is --fov, else what the
    // picture's metadata say, else 60 deg and a note.
    View view_of(const io::Picture& picture, Session& session) const;
    // The view of a picture of width x height without a file; 60 deg unless --fov is given.
    View view_of_size(int width, int height) const;
    // What pixel value 1 means, in cd/m2: --white-luminance, else the attribute whiteLuminance of
    // the picture if it is positive, else 100.
    double white_luminance(const io::Picture& picture) const;

  private:
    // Throws InvalidArgument that names `source` unless the field of view fits the projection.
    Projection projection_for(double fov_deg, const std::string& source) const;

    std::optional<double> fov_deg_;
    std::string perspective_ = "auto";
    std::optional<double> white_luminance_cd_m2_;
};

// The view of the data window of a picture whose display window is seen as `display`.
View data_view(const View& display, const io::Picture& picture);

}  // namespace aureole::app
