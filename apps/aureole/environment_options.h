// The environment that `aureole ibl` reads: INPUT, --size, --layout, --rotate, --mirror,
// --exposure,
// --clamp.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "aureole/ibl/cube_map.h"
#include "aureole/ibl/environment_transform.h"
#include "aureole/ibl/layout.h"
#include "aureole/io/picture_rows.h"
#include "session.h"

namespace aureole::app {

class EnvironmentOptions {
  public:
    void add_options(CLI::App& command);
    // Throws InvalidArgument for options that contradict each other.
    void check() const;

    int size() const { return size_; }

    // Reads and resamples, with progress; what was replaced or lost goes into notes and the report.
    // Throws FileError, InvalidArgument, Cancelled.
    ibl::CubeMap read(Session& session);
    nlohmann::ordered_json parameters() const;

  private:
    ibl::CubeMap read_one(const std::string& file, Session& session,
                          ibl::EnvironmentReport& report);
    ibl::CubeMap read_lat_long(const std::string& file, io::PictureRows& rows, Session& session,
                               ibl::EnvironmentReport& report);
    ibl::CubeMap read_six(Session& session, ibl::EnvironmentReport& report);
    ibl::CubeMap from_picture(const std::string& file, const Image& picture,
                              ibl::EnvironmentReport& report);
    // As asked for, or by the picture's shape.
    ibl::Layout layout_of(const std::string& file, int width, int height);
    ibl::EnvironmentTransform transform() const;

    std::vector<std::string> inputs_;
    int size_ = 256;
    std::string layout_ = "auto";
    std::string layout_used_;
    std::string mirror_ = "none";
    std::string rotation_text_;
    double exposure_ev_ = 0;
    std::optional<double> max_luminance_;
};

}  // namespace aureole::app
