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
    void add_options(CLI::App& command);

    // The view of a whole data window. The field of view is that of the display window: from
    // --fov, else from the picture's metadata, else 60 deg and a note.
    View view_of(const io::Picture& picture, Session& session) const;
    // The view of a picture of width x height without a file; 60 deg unless --fov is given.
    View view_of_size(int width, int height) const;
    // What pixel value 1 means, in cd/m2: --white-luminance, else the attribute whiteLuminance of
    // the picture, else 100.
    double white_luminance(const io::Picture& picture) const;

  private:
    Projection projection_for(double fov_deg) const;

    std::optional<double> fov_deg_;
    std::string perspective_ = "auto";
    std::optional<double> white_luminance_cd_m2_;
};

}  // namespace aureole::app
