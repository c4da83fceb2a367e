#include "camera_options.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/image/finite.h"
#include "aureole/io/picture.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

constexpr double kWidestSensorMm = 1000;

// Width and height in mm, or nothing.
std::optional<std::array<double, 2>> sensor_size(const std::string& text) {
    const auto size = given_numbers(text, 'x');
    if (!size || size->size() != 2) return std::nullopt;
    for (const double side : *size) {
        if (!(side > 0 && side <= kWidestSensorMm)) return std::nullopt;
    }
    return std::array{(*size)[0], (*size)[1]};
}

Image colour_of(const std::string& file) {
    io::Picture picture = io::read_picture(file);
    replace_nonfinite(picture.color());
    return copy(picture.color());
}

// What the library says of a picture, with the name of its file.
template <class Make>
auto made_from(const std::string& file, const Make& make) {
    const Image image = colour_of(file);
    try {
        return make(image);
    } catch (const InvalidArgument& error) {
        throw FileError(file, error.what());
    }
}

}  // namespace

double Camera::used_width_mm(int width, int height) const {
    double across = sensor_width_mm;
    double up = sensor_height_mm;
    if ((width < height) != (across < up)) std::swap(across, up);
    return std::min(across, up * width / height);
}

double Camera::field_deg(int width, int height) const {
    return deg_from_rad(2 * std::atan(used_width_mm(width, height) / (2 * lens.efl_mm())));
}

void CameraOptions::add_options(CLI::App& command, const std::string& fallback_lens) {
    group_ = command.add_option_group("The camera");
    lens_.add_options(*group_, fallback_lens);
    blade_options_ = {
        whole_number(
            group_->add_option("--blades", shape_.blades, "Blades of the iris, 3 to 64; 0: round"),
            0, lens::Iris::kMaxBlades)
            ->type_name("N")
            ->capture_default_str(),
        number(group_->add_option("--blade-curvature", shape_.curvature,
                                  "0: straight blades; 1: the circle through their corners"),
               0, 1)
            ->type_name("0..1")
            ->capture_default_str(),
        number(group_->add_option("--iris-rotation", shape_.rotation_deg,
                                  "0: a corner points to the right of the picture"))
            ->type_name("DEG")
            ->capture_default_str(),
        number(group_->add_option("--iris-smoothing", shape_.smoothing,
                                  "Rounds the corners: k of a smooth maximum of the blades' "
                                  "distances"),
               0, 0.5)
            ->type_name("0..0.5")
            ->capture_default_str()};
    group_
        ->add_option("--iris", iris_file_,
                     "Picture of the opening in place of blades: white lets light through; its "
                     "shorter side spans the iris. The finer it is, the further the starburst "
                     "reaches: 2000 pixels and more")
        ->type_name("FILE");
    group_
        ->add_option("--occluder", occluder_file_,
                     "Picture of dirt, scratches, fibres on the front element: black blocks light; "
                     "its shorter side spans the element")
        ->type_name("FILE");
    CLI::Option* const sensor =
        group_->add_option("--sensor", sensor_,
                           "Width and height in mm of the sensor; the largest part that has the "
                           "picture's shape is used, turned for upright pictures");
    sensor->check([](const std::string& text) {
        if (!sensor_size(text)) {
            throw InvalidArgument("--sensor", text,
                                  "must be WIDTHxHEIGHT in mm, each above 0 and at most 1000, as "
                                  "in 36x24");
        }
        return std::string();
    });
    sensor->type_name("WxH")->capture_default_str();
}

std::string CameraOptions::first_given() const { return app::first_given(*group_); }

lens::Iris CameraOptions::iris() const {
    if (iris_file_.empty()) {
        if (shape_.blades == 1 || shape_.blades == 2) {
            throw InvalidArgument("--blades", std::to_string(shape_.blades),
                                  "must be 0 (round) or from 3 to 64");
        }
        return lens::Iris(shape_);
    }
    for (const CLI::Option* option : blade_options_) {
        if (option->count() == 0) continue;
        throw InvalidArgument("--iris", iris_file_,
                              "replaces the blades: leave out " + option->get_name());
    }
    return made_from(iris_file_, [](const Image& image) { return lens::Iris(image); });
}

Camera CameraOptions::camera(Session& session) const {
    if (group_->get_option("--lens")->count() == 0) {
        session.note("no lens given: using " + lens_.name() + " (--lens)");
    }
    const std::array<double, 2> sensor_mm = *sensor_size(sensor_);
    Camera camera{lens_.lens(session), iris(), std::nullopt, sensor_mm[0], sensor_mm[1]};
    if (!occluder_file_.empty()) {
        const double diameter_mm = 2 * camera.lens.faces().front().semi_aperture_mm;
        camera.occluder = made_from(
            occluder_file_, [&](const Image& image) { return lens::Occluder(image, diameter_mm); });
    }
    return camera;
}

nlohmann::ordered_json CameraOptions::report(const Camera& camera) const {
    nlohmann::ordered_json json = lens_.report(camera.lens);
    json["efl_mm"] = camera.lens.efl_mm();
    json["sensor_mm"] = {camera.sensor_width_mm, camera.sensor_height_mm};
    if (iris_file_.empty()) {
        json["blades"] = shape_.blades;
        json["blade_curvature"] = shape_.curvature;
        json["iris_rotation_deg"] = shape_.rotation_deg;
        json["iris_smoothing"] = shape_.smoothing;
    } else {
        json["iris"] = iris_file_;
    }
    if (!occluder_file_.empty()) json["occluder"] = occluder_file_;
    return json;
}

}  // namespace aureole::app
