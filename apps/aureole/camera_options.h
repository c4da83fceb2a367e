// The camera: its lens, the iris in it, dirt on it, the sensor behind it.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "aureole/lens/iris.h"
#include "aureole/lens/lens.h"
#include "lens_choice.h"
#include "session.h"

namespace aureole::app {

// What the options name, loaded.
struct Camera {
    lens::Lens lens;
    lens::Iris iris;
    std::optional<lens::Occluder> occluder;
    double sensor_width_mm = 0;
    double sensor_height_mm = 0;

    const lens::Occluder* dirt() const { return occluder ? &*occluder : nullptr; }
    double entrance_pupil_mm() const { return lens.efl_mm() / lens.f_number(); }
    // Width in mm of the largest part of the sensor that has the shape of width x height pixels;
    // for an upright picture the camera is held upright.
    double used_width_mm(int width, int height) const;
    // Horizontal field of view that the lens gives a picture of width x height on this sensor.
    double field_deg(int width, int height) const;
};

class CameraOptions {
  public:
    // In a group of their own. The lens must be named unless there is a fallback, the id of one
    // that comes with Aureole.
    void add_options(CLI::App& command, const std::string& fallback_lens = "");

    // The first of these options that was given, or nothing.
    std::string first_given() const;
    // Throws InvalidArgument, FileError.
    Camera camera(Session& session) const;
    const std::string& lens_name() const { return lens_.name(); }
    // Every value in force.
    nlohmann::ordered_json report(const Camera& camera) const;

  private:
    lens::Iris iris() const;

    CLI::Option_group* group_ = nullptr;
    std::vector<CLI::Option*> blade_options_;
    LensOptions lens_;
    lens::IrisShape shape_;
    std::string iris_file_;
    std::string occluder_file_;
    std::string sensor_ = "36x24";
};

}  // namespace aureole::app
