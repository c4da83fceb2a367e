// aureole psf: the point spread function of an eye or a camera, as a kernel for any tool.
#include <fmt/core.h>

#include <map>
#include <memory>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/eye/joint_psf.h"
#include "aureole/io/picture.h"
#include "aureole/lens/starburst.h"
#include "camera_options.h"
#include "commands.h"
#include "eye_options.h"
#include "kernel_file.h"
#include "living_eye.h"
#include "motion_options.h"
#include "option_checks.h"
#include "output_options.h"
#include "session.h"
#include "view_options.h"

namespace aureole::app {
namespace {

// A lit room in the evening, or a street at dusk.
constexpr double kDefaultAdaptation = 10;  // cd/m2
constexpr const char* kFallbackLens = "heliar";

struct PsfCommand {
    void add_options(CLI::App& command);
    void run();
    void check();
    wave::Psf compute(const eye::Eye& eye, const wave::KernelGrid& grid);
    // At rest, or at --time.
    eye::Eye eye_at_its_moment(const View& view, nlohmann::ordered_json& parameters);
    // Each makes the PSF of one observer, and says in "parameters" whose it is.
    wave::Psf of_eye(const View& view);
    wave::Psf of_camera(const Camera& seen_by, const View& view);

    Session session;
    ViewOptions view_options;
    EyeOptions eye_options;
    MotionOptions motion_options;
    CameraOptions camera_options;
    std::string observer = "eye";
    OutputOptions output;
    int width = 1920;
    std::optional<int> height;
    int size = 1025;
    std::string component = "all";
    CLI::Option* component_option = nullptr;
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
    one_of(command.add_option("--observer", observer,
                              "eye; camera: the starburst of an iris (ghosts are no part of a "
                              "PSF: `aureole flare`)"),
           {"eye", "camera"})
        ->capture_default_str();
    component_option =
        one_of(command.add_option("--component", component,
                                  "One part of the eye's alone, with energy 1: bloom (the pupil's "
                                  "Airy pattern), corona, halo, streaks; joint: diffraction of all "
                                  "in one mask, as the thesis does it"),
               {"all", "bloom", "corona", "halo", "streaks", "joint"});
    component_option->capture_default_str();
    view_options.add_options(command, "60, or the lens's for a camera");
    eye_options.add_options(command);
    motion_options.add_options_of_a_moment(command);
    camera_options.add_options(command, kFallbackLens);
    session.add_options(command);
}

wave::Psf PsfCommand::compute(const eye::Eye& eye, const wave::KernelGrid& grid) {
    if (component == "joint") {
        eye::JointPsfOptions options;
        options.spectral = eye_options.sampling();
        return eye::joint_psf(eye, grid, options, &session);
    }
    eye::EyePsfOptions options;
    options.spectral = eye_options.sampling();
    if (component == "all") return eye::eye_psf(eye, grid, options, &session);
    const std::map<std::string, eye::Component> components = {
        {"bloom", eye::Component::kBloom},
        {"corona", eye::Component::kCorona},
        {"halo", eye::Component::kHalo},
        {"streaks", eye::Component::kStreaks}};
    return eye::eye_component(components.at(component), eye, grid, options, &session);
}

void PsfCommand::check() {
    check_outputs(output.paths());
    output.check_depth(output.paths());
    if (size % 2 == 0) {
        throw InvalidArgument("--size", fmt::format("{}", size),
                              "must be odd: the source is in the middle of a pixel");
    }
    if (observer == "camera") {
        for (const std::string& option :
             {component_option->count() > 0 ? component_option->get_name() : "",
              eye_options.first_given(), motion_options.first_given()}) {
            refuse(option, "is an option of the eye: leave it out with --observer camera");
        }
        return;
    }
    refuse(eye_options.by_color() ? "--source-spectrum rgb" : "",
           "makes a kernel for each pair of colours, which no kernel file holds; `aureole glare` "
           "applies it");
    refuse(camera_options.first_given(), "is an option of the camera: needs --observer camera");
    check_eye(eye_options, motion_options);
    refuse(motion_options.squints() && motion_options.given("--squint") && eye_options.meters()
               ? "--squint"
               : "",
           "the luminance that lids close against is not known: needs --adaptation");
}

eye::Eye PsfCommand::eye_at_its_moment(const View& view, nlohmann::ordered_json& parameters) {
    if (!motion_options.alive()) {
        const eye::Eye eye = eye_options.eye(kDefaultAdaptation, view);
        parameters = eye_options.report(eye, kDefaultAdaptation);
        return eye;
    }
    LivingEye living(eye_options, motion_options, session);
    constexpr int kFirstFrame = 0;
    const double time_s = motion_options.time_s(kFirstFrame);
    const eye::Moment moment = living.at(time_s, kDefaultAdaptation, view);
    if (moment.closed) {
        session.note(
            fmt::format("--time {}: the lids are closed (light_share {:.2g} in --json): the kernel "
                        "is that of their last opening",
                        time_s, moment.light_share));
    }
    parameters = living.report();
    return moment.eye;
}

wave::Psf PsfCommand::of_eye(const View& view) {
    auto& parameters = session.json()["parameters"];
    const eye::Eye eye = eye_at_its_moment(view, parameters);
    if (eye_options.needs_adaptation()) {
        session.note(
            fmt::format("no adaptation luminance: assuming {} cd/m2 (--adaptation, --pupil)",
                        kDefaultAdaptation));
    }
    parameters["component"] = component;
    return session.timed("psf", [&] { return compute(eye, wave::KernelGrid::square(view, size)); });
}

wave::Psf PsfCommand::of_camera(const Camera& seen_by, const View& view) {
    auto& parameters = session.json()["parameters"];
    parameters = camera_options.report(seen_by);
    parameters["lens_fov_deg"] = seen_by.field_deg(view.width, view.height);
    return session.timed("psf", [&] {
        return lens::starburst_psf(seen_by.iris, seen_by.entrance_pupil_mm(),
                                   wave::KernelGrid::square(view, size), {}, seen_by.dirt(),
                                   &session);
    });
}

void PsfCommand::run() {
    session.start();
    check();
    session.json()["outputs"] = output.paths();
    const int rows = height.value_or((width * 9 + 8) / 16);
    View view;
    wave::Psf psf;
    if (observer == "camera") {
        const Camera camera = camera_options.camera(session);
        view = view_options.view_of_size(width, rows, camera.field_deg(width, rows));
        psf = of_camera(camera, view);
    } else {
        view = view_options.view_of_size(width, rows);
        psf = of_eye(view);
    }
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
    json["energy"] = {{"off_kernel", psf.off_kernel_energy}};
    json["parameters"].update({{"observer", observer},
                               {"width", view.width},
                               {"height", view.height},
                               {"fov_deg", view.horizontal_field_deg()},
                               {"perspective", psf.grid.projection == Projection::kPerspective},
                               {"size", size},
                               {"pitch_deg", psf.grid.pitch_deg},
                               {"depth", output.depth()},
                               {"threads", thread_count()}});
    std::string summary;
    for (const std::string& path : output.paths()) summary += path + "\n";
    session.finish(summary);
}

}  // namespace

Run add_psf_command(CLI::App& app) {
    CLI::App& command = *app.add_subcommand(
        "psf", "Write the point spread function of an eye or a camera as a kernel");
    const auto state = std::make_shared<PsfCommand>();
    state->add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
