// aureole flare: what a lens adds to pictures and sequences.
#include <memory>

#include "aureole/base/error.h"
#include "camera_observer.h"
#include "commands.h"
#include "frame_files.h"
#include "option_checks.h"
#include "picture_job.h"

namespace aureole::app {
namespace {

struct FlareCommand {
    void add_options(CLI::App& command);
    void run();

    Session session;
    PictureSettings settings;
    SpreadSettings spread;  // as they are without options
    ViewOptions view;
    CameraOptions camera;
    GhostOptions ghosts;
    LightOptions lights;
    std::vector<std::string> inputs;
    std::string frames;
    std::string preset = "physical";
    bool starburst = false;
    bool only = false;
};

void FlareCommand::add_options(CLI::App& command) {
    command
        .add_option("INPUT", inputs,
                    "Linear HDR pictures, or a numbered sequence (shot.%04d.exr, shot.####.exr) "
                    "with --frames")
        ->required()
        ->type_name("FILE");
    settings.output.add_options(command,
                                "EXR, HDR or TIFF (linear), PNG or JPEG (tone-mapped); a numbered "
                                "name for a sequence; a folder for several pictures; may be "
                                "repeated; may be missing with --dump-ghosts");
    settings.output.make_optional();
    command.add_option("--frames", frames, "Frames of a sequence: 1001-1240, 1-10x2, 1,5,9")
        ->type_name("RANGE");
    one_of(command.add_option("--preset", preset,
                              "physical: ghosts in the picture's units, no gain; blog: as "
                              "drawn by a game: faded polygons, one colour each (matrix, "
                              "same-side pairs)"),
           {"physical", "blog"})
        ->capture_default_str();
    command.add_flag("--starburst", starburst,
                     "Also spread the picture's light by the diffraction at the iris");
    command.add_flag("--only", only,
                     "The flare without the picture: short for --output-layers glare");
    view.add_options(command, "the lens's own on the sensor");
    camera.add_options(command);
    lights.add_options(command);
    ghosts.add_options(command);
    settings.add_options(*command.add_option_group("Pictures"), command);
    session.add_options(command);
}

void FlareCommand::run() {
    session.start();
    if (settings.output.paths().empty() && ghosts.dump_file().empty()) {
        throw InvalidArgument("--output is required, unless --dump-ghosts is given");
    }
    if (only) {
        if (settings.layers_option->count() > 0) {
            throw InvalidArgument("--output-layers", settings.layers,
                                  "contradicts --only, which is --output-layers glare");
        }
        settings.layers = "glare";
    }
    const std::vector<FrameFiles> list =
        frame_files(inputs, settings.output.paths(), settings.side_by_side_file, frames);
    settings.prepare(list);
    view.check();
    ghosts.set_preset(preset);
    ghosts.check();
    ghosts.check_pictures(list.size());
    lights.check();
    if (!ghosts.any()) {
        const std::string option = lights.first_given();
        if (!option.empty()) {
            throw InvalidArgument(option + ": has no effect with --ghosts none");
        }
        if (!starburst) {
            throw InvalidArgument("--ghosts", "none", "leaves nothing to do without --starburst");
        }
    }
    const FieldVaryingOption same_everywhere;
    CameraObserver observer(camera, ghosts, lights, view, {.starburst = starburst, .halation = {}},
                            same_everywhere, session);
    PictureJob job(settings, spread, observer, session);
    job.process(list);
    const std::string summary = job.report();
    session.json()["method"] = session.json()["parameters"]["ghosts"];
    session.finish(summary);
}

}  // namespace

Run add_flare_command(CLI::App& app) {
    CLI::App& command = *app.add_subcommand(
        "flare", "Add the ghosts of a lens, and the starburst of its iris, to HDR pictures");
    const auto state = std::make_shared<FlareCommand>();
    state->add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
