// aureole psf: the point spread function of an eye, as a kernel for any tool.
#include <fmt/core.h>

#include <map>
#include <memory>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/eye/joint_psf.h"
#include "aureole/io/picture.h"
#include "commands.h"
#include "eye_options.h"
#include "kernel_file.h"
#include "option_checks.h"
#include "output_options.h"
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
    OutputOptions output;
    int width = 1920;
    std::optional<int> height;
    int size = 1025;
    std::string component = "all";
};

void PsfCommand::add_options(CLI::App& command) {
    output.add_options(command,
                       "EXR (the kernel), PNG or JPEG (a logarithmic picture of it); may be "
                       "repeated");
    whole_number(
        command.add_option("--width", width, "Width in pixels of the pictures the kernel is for"),
        1, 1 << 16)
        ->type_name("PIXELS")
        ->capture_default_str();
    whole_number(
        command.add_option("--height", height, "Their height (default: 9/16 of the width)"), 1,
        1 << 16)
        ->type_name("PIXELS");
    whole_number(command.add_option("--size", size, "Width and height of the kernel, odd"), 1,
                 (1 << 14) - 1)
        ->type_name("PIXELS")
        ->capture_default_str();
    one_of(command.add_option("--component", component,
                              "One part alone, with energy 1: bloom (the pupil's Airy pattern), "
                              "corona, halo, streaks; joint: diffraction of all in one mask, as "
                              "the thesis does it"),
           {"all", "bloom", "corona", "halo", "streaks", "joint"})
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
    check_outputs(output.paths());
    output.check_depth(output.paths());
    if (size % 2 == 0) {
        throw InvalidArgument("--size", fmt::format("{}", size),
                              "must be odd: the source is in the middle of a pixel");
    }
    const View view = view_options.view_of_size(width, height.value_or((width * 9 + 8) / 16));
    const eye::Eye eye = eye_options.eye(kDefaultAdaptation, view);
    if (eye_options.needs_adaptation()) {
        session.note(
            fmt::format("no adaptation luminance: assuming {} cd/m2 (--adaptation, --pupil)",
                        kDefaultAdaptation));
    }
    const wave::KernelGrid grid = wave::KernelGrid::square(view, size);
    const wave::Psf psf = session.timed("psf", [&] { return compute(eye, grid); });
    session.check_interrupt();
    session.timed("write", [&] {
        for (const std::string& path : output.paths()) {
            if (is_display_file(path)) {
                io::write_picture(path, io::Picture(logarithmic_picture(psf)));
            } else {
                output.write(path, picture_of(psf), session);
            }
        }
    });
    auto& json = session.json();
    json["outputs"] = output.paths();
    json["energy"] = {{"off_kernel", psf.off_kernel_energy}};
    json["parameters"] = eye_options.report(eye, kDefaultAdaptation);
    json["parameters"].update({{"component", component},
                               {"width", view.width},
                               {"height", view.height},
                               {"fov_deg", view.horizontal_field_deg()},
                               {"perspective", grid.projection == Projection::kPerspective},
                               {"size", size},
                               {"pitch_deg", grid.pitch_deg},
                               {"depth", output.depth()},
                               {"threads", thread_count()}});
    std::string summary;
    for (const std::string& path : output.paths()) summary += path + "\n";
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
