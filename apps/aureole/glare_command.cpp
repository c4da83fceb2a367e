// aureole glare: glare on pictures and sequences.
#include <memory>

#include "commands.h"
#include "frame_files.h"
#include "glare_job.h"

namespace aureole::app {
namespace {

struct GlareCommand {
    void add_options(CLI::App& command);
    void run();

    Session session;
    GlareSettings settings;
    std::vector<std::string> inputs;
    std::string frames;
};

void GlareCommand::add_options(CLI::App& command) {
    command
        .add_option("INPUT", inputs,
                    "Linear HDR pictures, or a numbered sequence (shot.%04d.exr, shot.####.exr) "
                    "with --frames")
        ->required()
        ->type_name("FILE");
    settings.output.add_options(command,
                                "EXR, HDR or TIFF (linear), PNG or JPEG (tone-mapped); a numbered "
                                "name for a sequence; a folder for several pictures; may be "
                                "repeated");
    command.add_option("--frames", frames, "Frames of a sequence: 1001-1240, 1-10x2, 1,5,9")
        ->type_name("RANGE");
    settings.add_options(command);
    session.add_options(command);
}

void GlareCommand::run() {
    session.start();
    const std::vector<FrameFiles> list =
        frame_files(inputs, settings.output.paths(), settings.side_by_side_file, frames);
    settings.prepare(list);
    GlareJob job(settings, session, frames.empty() ? Metering::kEachPicture : Metering::kFirst);
    for (std::size_t i = 0; i < list.size(); ++i) {
        session.check_interrupt();
        job.process(list[i]);
        if (list.size() > 1) {
            session.report("frames", static_cast<double>(i + 1) / static_cast<double>(list.size()));
        }
    }
    session.finish(job.report());
}

}  // namespace

Run add_glare_command(CLI::App& app) {
    CLI::App& command = *app.add_subcommand("glare", "Add the glare of an eye to HDR pictures");
    const auto state = std::make_shared<GlareCommand>();
    state->add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
