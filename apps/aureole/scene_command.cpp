// aureole scene: the built-in procedural HDR pictures, of a camera or of the whole sphere.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/io/picture.h"
#include "aureole/scene/environment.h"
#include "aureole/scene/scene.h"
#include "commands.h"
#include "display_options.h"
#include "option_checks.h"
#include "output_options.h"
#include "session.h"

namespace aureole::app {
namespace {

constexpr int kMostPixels = 32768;

bool is_environment(std::string_view name) {
    const auto infos = scene::list_environments();
    return std::any_of(infos.begin(), infos.end(),
                       [&](const auto& info) { return info.name == name; });
}

// A scene or an environment.
struct MadePicture {
    Image rgb;
    double adaptation_cd_m2 = 0;
    double display_white_cd_m2 = 0;
    std::optional<double> fov_deg;  // of a camera
};

struct SceneCommand {
    void add_options(CLI::App& command);
    void run();
    MadePicture make();

    Session session;
    DisplayOptions display;
    OutputOptions output;
    std::string name;
    scene::SceneOptions options;
    std::optional<int> width;
    std::optional<int> height;
    double white_luminance_cd_m2 = 100;
};

std::string scene_names() {
    std::string text = "One of:";
    for (const scene::SceneInfo& info : scene::list_scenes()) {
        text += fmt::format("\n  {:<14}{}", info.name, info.description);
    }
    for (const scene::EnvironmentInfo& info : scene::list_environments()) {
        text += fmt::format("\n  {:<14}{}", info.name, info.description);
    }
    return text;
}

void SceneCommand::add_options(CLI::App& command) {
    command.add_option("NAME", name, scene_names())->required()->type_name("");
    output.add_options(command,
                       "Picture to write: EXR, HDR or TIFF (linear), PNG or JPEG (tone-mapped); "
                       "may be repeated");
    const auto pixels = [&](const char* option, std::optional<int>& value, const char* text) {
        whole_number(command.add_option(option, value, text), 1, kMostPixels)->type_name("PIXELS");
    };
    pixels("--width", width, "Pixels (default: 1920, environments 2048)");
    pixels("--height", height, "Pixels (default: 1080, environments half their width)");
    number(
        command.add_option("--fov", options.fov_deg,
                           "Horizontal field of view, at most 170 (default: the scene's); not of "
                           "environments"))
        ->type_name("DEG");
    positive_number(command.add_option("--white-luminance", white_luminance_cd_m2,
                                       "What pixel value 1 means, in cd/m2"))
        ->type_name("CD_M2")
        ->capture_default_str();
    seed_number(command.add_option("--seed", options.seed, "Another town, another sky"))
        ->type_name("N")
        ->capture_default_str();
    const auto position = [&](const char* option, std::optional<int>& value, const char* text) {
        whole_number(command.add_option(option, value, text), 0, kMostPixels - 1)
            ->type_name("PIXEL");
    };
    position("--point-x", options.point_x, "point: column of the lit pixel");
    position("--point-y", options.point_y, "point: row of the lit pixel");
    number(command.add_option("--point-luminance", options.point_cd_m2,
                              "point: its luminance in cd/m2"),
           0, 1e30)
        ->type_name("CD_M2")
        ->capture_default_str();
    display.add_options(command);
    session.add_options(command);
}

MadePicture SceneCommand::make() {
    const bool sphere = is_environment(name);
    options.width = width.value_or(sphere ? 2048 : 1920);
    options.height = height.value_or(sphere ? options.width / 2 : 1080);
    if (!sphere) {
        scene::Scene scene = scene::make_scene(name, options);
        return {std::move(scene.rgb), scene.adaptation_cd_m2, scene.display_white_cd_m2,
                2 * scene.view.angle_from_axis_deg(0, scene.view.axis_y)};
    }
    if (options.fov_deg) {
        throw InvalidArgument("--fov", fmt::format("{}", *options.fov_deg),
                              name + " is an environment, which shows the whole sphere");
    }
    if (!height && options.width % 2 != 0) {
        throw InvalidArgument("--width", std::to_string(options.width),
                              "environments are twice as wide as high: must be even, or --height "
                              "given");
    }
    scene::Environment made =
        scene::make_environment(name, {options.width, options.height, options.seed});
    return {std::move(made.rgb), made.adaptation_cd_m2, made.display_white_cd_m2, std::nullopt};
}

void SceneCommand::run() {
    session.start();
    check_outputs(output.paths());
    output.check_depth(output.paths());
    display.prepare(output.paths());
    MadePicture scene = session.timed("scene", [&] { return make(); });
    const auto scale = static_cast<float>(1 / white_luminance_cd_m2);
    for (int c = 0; c < 3; ++c) {
        float* plane = scene.rgb.plane(c);
        for (std::size_t i = 0; i < scene.rgb.pixels(); ++i) plane[i] *= scale;
    }
    const double ev = std::log2(white_luminance_cd_m2 / scene.display_white_cd_m2);
    io::Picture picture(std::move(scene.rgb));
    picture.set_attribute("whiteLuminance", static_cast<float>(white_luminance_cd_m2));
    if (scene.fov_deg) {
        picture.set_attribute("aureole:fov_deg", static_cast<float>(*scene.fov_deg));
    }
    picture.set_attribute("aureole:adaptation_cd_m2", static_cast<float>(scene.adaptation_cd_m2));
    picture.set_attribute("aureole:exposure_ev", static_cast<float>(ev));
    session.check_interrupt();
    session.timed("write", [&] {
        for (const std::string& path : output.paths()) {
            if (is_display_file(path)) {
                const Image encoded = display.encode(picture.color(), display.exposure_ev(picture));
                io::write_picture(path, io::Picture(encoded));
            } else {
                output.write(path, picture, session);
            }
        }
    });
    auto& json = session.json();
    json["scene"] = name;
    json["outputs"] = output.paths();
    json["parameters"] = {{"width", options.width},
                          {"height", options.height},
                          {"white_luminance_cd_m2", white_luminance_cd_m2},
                          {"adaptation_cd_m2", scene.adaptation_cd_m2},
                          {"exposure_ev", display.exposure_ev(picture)},
                          {"tone_map", display.tone_map()},
                          {"antialias", display.antialias()},
                          {"depth", output.depth()},
                          {"seed", options.seed},
                          {"threads", thread_count()}};
    if (scene.fov_deg) json["parameters"]["fov_deg"] = *scene.fov_deg;
    std::string summary;
    for (const std::string& path : output.paths()) summary += path + "\n";
    session.finish(summary);
}

}  // namespace

Run add_scene_command(CLI::App& app) {
    CLI::App& command = *app.add_subcommand("scene", "Write a built-in procedural HDR scene");
    const auto state = std::make_shared<SceneCommand>();
    state->add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
