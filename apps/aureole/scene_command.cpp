// aureole scene: the built-in procedural HDR pictures.
#include <fmt/core.h>

#include <cmath>
#include <memory>

#include "aureole/base/error.h"
#include "aureole/io/picture.h"
#include "aureole/scene/scene.h"
#include "commands.h"
#include "display_options.h"
#include "session.h"

namespace aureole::app {
namespace {

struct SceneCommand {
    void add_options(CLI::App& command);
    void run();

    Session session;
    DisplayOptions display;
    std::string name;
    std::vector<std::string> outputs;
    scene::SceneOptions options;
    double white_luminance_cd_m2 = 100;
};

std::string scene_names() {
    std::string text = "One of:";
    for (const scene::SceneInfo& info : scene::list_scenes()) {
        text += fmt::format("\n  {:<14}{}", info.name, info.description);
    }
    return text;
}

void SceneCommand::add_options(CLI::App& command) {
    command.add_option("NAME", name, scene_names())->required();
    command
        .add_option("-o,--output", outputs,
                    "Picture to write: EXR, HDR or TIFF (linear), PNG or JPEG (tone-mapped); may "
                    "be repeated")
        ->required()
        ->type_name("FILE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--width", options.width, "Pixels")->capture_default_str();
    command.add_option("--height", options.height, "Pixels")->capture_default_str();
    command.add_option("--fov", options.fov_deg, "Horizontal field of view (default: the scene's)")
        ->type_name("DEG");
    command
        .add_option("--white-luminance", white_luminance_cd_m2,
                    "What pixel value 1 means, in cd/m2")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_option("--seed", options.seed, "Another town, another sky")->capture_default_str();
    command.add_option("--point-x", options.point_x, "point: column of the lit pixel");
    command.add_option("--point-y", options.point_y, "point: row of the lit pixel");
    command.add_option("--point-luminance", options.point_cd_m2, "point: its luminance in cd/m2")
        ->capture_default_str();
    display.add_options(command);
    session.add_options(command);
}

void SceneCommand::run() {
    session.start();
    for (const std::string& output : outputs) io::check_picture_extension(output);
    display.prepare(outputs);
    scene::Scene scene = session.timed("scene", [&] { return scene::make_scene(name, options); });
    const auto scale = static_cast<float>(1 / white_luminance_cd_m2);
    for (int c = 0; c < 3; ++c) {
        float* plane = scene.rgb.plane(c);
        for (std::size_t i = 0; i < scene.rgb.pixels(); ++i) plane[i] *= scale;
    }
    const double ev = std::log2(white_luminance_cd_m2 / scene.display_white_cd_m2);
    io::Picture picture(std::move(scene.rgb));
    picture.set_attribute("whiteLuminance", static_cast<float>(white_luminance_cd_m2));
    picture.set_attribute("aureole:fov_deg", static_cast<float>(2 * scene.view.angle_from_axis_deg(
                                                                        0, scene.view.axis_y)));
    picture.set_attribute("aureole:adaptation_cd_m2", static_cast<float>(scene.adaptation_cd_m2));
    picture.set_attribute("aureole:exposure_ev", static_cast<float>(ev));
    session.timed("write", [&] {
        for (const std::string& output : outputs) {
            if (is_display_file(output)) {
                io::write_picture(output, io::Picture(display.encode(
                                              picture.color(), display.exposure_ev(picture))));
            } else {
                io::write_picture(output, picture);
            }
        }
    });
    auto& json = session.json();
    json["scene"] = name;
    json["outputs"] = outputs;
    json["parameters"] = {{"width", options.width},
                          {"height", options.height},
                          {"fov_deg", 2 * scene.view.angle_from_axis_deg(0, scene.view.axis_y)},
                          {"white_luminance_cd_m2", white_luminance_cd_m2},
                          {"adaptation_cd_m2", scene.adaptation_cd_m2},
                          {"exposure_ev", ev},
                          {"seed", options.seed}};
    std::string summary;
    for (const std::string& output : outputs) summary += output + "\n";
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
