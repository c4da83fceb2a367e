// aureole psf: the point spread function of an eye, as a kernel for any tool.
#include <fmt/core.h>

#include <map>
#include <memory>

#include "aureole/base/error.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/eye/joint_psf.h"
#include "aureole/io/picture.h"
#include "commands.h"
#include "display_options.h"
#include "eye_options.h"
#include "kernel_file.h"
#include "session.h"
#include "view_options.h"

namespace aureole::app {
namespace {

// A lit room in the evening, or a street at dusk.
constexpr double kDefaultAdaptation = 10;  // cd/m2

struct PsfCommand {
    void add_options(CLI::App& command);
    void run();
    wave::Psf compute(const eye::Eye& eye, const wave::KernelGrid& grid);

    Session session;
    ViewOptions view_options;
    EyeOptions eye_options;
    std::vector<std::string> outputs;
    int width = 1920;
    std::optional<int> height;
    int size = 1025;
    std::string component = "all";
    std::string depth = "float";
};

void PsfCommand::add_options(CLI::App& command) {
    command
        .add_option("-o,--output", outputs,
                    "EXR (the kernel), PNG or JPEG (a logarithmic picture of it); may be repeated")
        ->required()
        ->type_name("FILE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--width", width, "Width in pixels of the pictures the kernel is for")
        ->check(CLI::Range(1, 1 << 16))
        ->capture_default_str();
    command.add_option("--height", height, "Their height (default: 9/16 of the width)")
        ->check(CLI::Range(1, 1 << 16));
    command.add_option("--size", size, "Width and height of the kernel in pixels, odd")
        ->check(CLI::Range(1, 1 << 14))
        ->capture_default_str();
    command
        .add_option("--component", component,
                    "One part alone, with energy 1: bloom (the pupil's Airy pattern), corona, "
                    "halo, streaks; joint: diffraction of all in one mask, as the thesis does it")
        ->check(CLI::IsMember({"all", "bloom", "corona", "halo", "streaks", "joint"}))
        ->capture_default_str();
    command.add_option("--depth", depth, "Of EXR channels; half loses the wings of a kernel")
        ->check(CLI::IsMember({"float", "half"}))
        ->capture_default_str();
    view_options.add_options(command);
    eye_options.add_options(command);
    session.add_options(command);
}

wave::Psf PsfCommand::compute(const eye::Eye& eye, const wave::KernelGrid& grid) {
    if (component == "all") return eye::eye_psf(eye, grid, {}, &session);
    if (component == "joint") return eye::joint_psf(eye, grid, {}, &session);
    const std::map<std::string, eye::Component> components = {
        {"bloom", eye::Component::kBloom},
        {"corona", eye::Component::kCorona},
        {"halo", eye::Component::kHalo},
        {"streaks", eye::Component::kStreaks}};
    return eye::eye_component(components.at(component), eye, grid, {}, &session);
}

void PsfCommand::run() {
    session.start();
    for (const std::string& output : outputs) io::check_picture_extension(output);
    const View view = view_options.view_of_size(width, height.value_or((width * 9 + 8) / 16));
    if (eye_options.needs_adaptation()) {
        session.note(
            fmt::format("no adaptation luminance: assuming {} cd/m2 (--adaptation, "
                        "--pupil)",
                        kDefaultAdaptation));
    }
    const eye::Eye eye = eye_options.eye(kDefaultAdaptation, view);
    const wave::KernelGrid grid = wave::KernelGrid::square(view, size);
    const wave::Psf psf = session.timed("psf", [&] { return compute(eye, grid); });
    session.timed("write", [&] {
        for (const std::string& output : outputs) {
            io::WriteOptions options;
            options.depth = depth == "half" ? io::Depth::kHalf : io::Depth::kFloat;
            io::write_picture(
                output,
                is_display_file(output) ? io::Picture(logarithmic_picture(psf)) : picture_of(psf),
                options);
        }
    });
    auto& json = session.json();
    json["outputs"] = outputs;
    json["energy"] = {{"off_kernel", psf.off_kernel_energy}};
    json["parameters"] = to_json(eye);
    json["parameters"].update({{"component", component},
                               {"size", size},
                               {"pitch_deg", grid.pitch_deg},
                               {"perspective", grid.projection == Projection::kPerspective}});
    std::string summary;
    for (const std::string& output : outputs) summary += output + "\n";
    session.finish(summary);
}

}  // namespace

Run add_psf_command(CLI::App& app) {
    CLI::App& command =
        *app.add_subcommand("psf", "Write the point spread function of an eye as a kernel");
    const auto state = std::make_shared<PsfCommand>();
    state->add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
