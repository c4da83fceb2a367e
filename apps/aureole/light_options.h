// Which lights make ghosts: --light, --found-lights, --light-threshold, --max-lights.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "aureole/image/view.h"
#include "aureole/io/picture.h"
#include "aureole/sources/light.h"
#include "session.h"

namespace aureole::app {

// The lights of one picture: first those given, then those found.
struct PictureLights {
    std::vector<sources::Light> lights;
    std::size_t given = 0;
    bool searched = false;
    sources::FoundLights search;  // if searched; its lights are in `lights`
};

class LightOptions {
  public:
    void add_options(CLI::App& command);
    // The first of these options that was given, or nothing.
    std::string first_given() const;
    // Throws InvalidArgument for lights that cannot be, before any picture is read.
    void check() const;

    // For a picture whose display window is seen as `display` and data window as `data`. `matte`
    // weights the pixels in which lights are looked for; nullptr: all count. Notes when no light
    // is found.
    PictureLights lights(const io::Picture& picture, const View& display, const View& data,
                         const float* matte, Session& session) const;
    // Every value in force.
    nlohmann::ordered_json report() const;

  private:
    struct Given {
        bool angles = false;  // else pixels of the display window
        double x = 0, y = 0;  // right and down in pixels; right and up in degrees
        std::array<float, 3> radiance = {};
        double diameter_deg = 0;
    };
    static Given parse(const std::string& text);
    // As a light of a picture whose display window is seen as `display`.
    static sources::Light light(const std::string& text, const View& display);
    bool searches() const { return given_.empty() || found_too_; }

    CLI::Option_group* group_ = nullptr;
    std::vector<CLI::Option*> search_options_;  // of those found
    std::vector<std::string> given_;
    bool found_too_ = false;
    std::string threshold_ = "auto";
    int max_lights_ = 64;
};

// Position in pixels of the display window, angles from the axis, radiance and size of each light.
nlohmann::ordered_json report_of(const PictureLights& lights, const View& display);

}  // namespace aureole::app
