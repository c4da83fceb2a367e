// How a picture sees the world: --fov, --perspective, --white-luminance.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "aureole/image/view.h"
#include "aureole/io/field_of_view.h"
#include "aureole/io/picture.h"
#include "session.h"

namespace aureole::app {

class ViewOptions {
  public:
    // --fov and --perspective. `otherwise`: what is assumed when nothing tells the field, for the
    // help.
    void add_options(CLI::App& command, const std::string& otherwise = "60");
    void add_white_luminance_option(CLI::App& command);
    // Throws InvalidArgument for a --fov that no picture can have.
    void check() const;

    // The view of a picture's display window, whose field of view is --fov, else what the
    // picture's metadata say, else 60 deg and a note.
    View view_of(const io::Picture& picture, Session& session) const;
    // The two steps of that for those who know better than 60 deg. known_field(): --fov, or what
    // the metadata say, or nothing.
    std::optional<io::FieldOfView> known_field(const io::Picture& picture) const;
    View view_with(const io::FieldOfView& field, const io::Picture& picture,
                   Session& session) const;
    // The view of a picture of width x height without a file, whose field of view is
    // `otherwise_deg` unless --fov is given.
    View view_of_size(int width, int height, double otherwise_deg = kDefaultFovDeg) const;
    // What pixel value 1 means, in cd/m2: --white-luminance, else the attribute whiteLuminance of
    // the picture if it is positive, else 100.
    double white_luminance(const io::Picture& picture) const;
    bool white_luminance_given() const { return white_luminance_cd_m2_.has_value(); }

  private:
    static constexpr double kDefaultFovDeg = 60;

    // Throws InvalidArgument that names `source` unless the field of view fits the projection.
    Projection projection_for(double fov_deg, const std::string& source) const;

    std::optional<double> fov_deg_;
    std::string perspective_ = "auto";
    std::optional<double> white_luminance_cd_m2_;
};

// The view of the data window of a picture whose display window is seen as `display`.
View data_view(const View& display, const io::Picture& picture);

}  // namespace aureole::app
