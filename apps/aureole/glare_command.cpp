// aureole glare: glare on pictures and sequences.
#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "aureole/base/error.h"
#include "aureole/io/sequence.h"
#include "commands.h"
#include "glare_job.h"

namespace aureole::app {
namespace {

namespace fs = std::filesystem;

struct GlareCommand {
    void add_options(CLI::App& command);
    void run();
    std::vector<FrameFiles> files() const;

    Session session;
    GlareSettings settings;
    std::vector<std::string> inputs;
    std::vector<std::string> outputs;
    std::string frames;
};

void GlareCommand::add_options(CLI::App& command) {
    command
        .add_option("INPUT", inputs,
                    "Linear HDR pictures, or a numbered sequence (shot.%04d.exr, shot.####.exr) "
                    "with --frames")
        ->required()
        ->type_name("FILE");
    command
        .add_option("-o,--output", outputs,
                    "EXR, HDR or TIFF (linear), PNG or JPEG (tone-mapped); a numbered name for a "
                    "sequence; a folder for several pictures; may be repeated")
        ->required()
        ->type_name("FILE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--frames", frames, "Frames of a sequence: 1001-1240, 1-10x2, 1,5,9")
        ->type_name("RANGE");
    settings.add_options(command);
    session.add_options(command);
}

// One entry per picture, in order, with everything that can be wrong about names found now.
std::vector<FrameFiles> GlareCommand::files() const {
    std::vector<FrameFiles> list;
    if (!frames.empty()) {
        if (inputs.size() != 1) {
            throw InvalidArgument("--frames", frames, "needs exactly one numbered INPUT");
        }
        const std::vector<int> numbers = io::parse_frames(frames);
        const std::vector<std::string> in = io::frame_paths(inputs[0], numbers);
        list.resize(in.size());
        for (std::size_t i = 0; i < in.size(); ++i) list[i].input = in[i];
        for (const std::string& output : outputs) {
            const std::vector<std::string> out = io::frame_paths(output, numbers);
            for (std::size_t i = 0; i < in.size(); ++i) list[i].outputs.push_back(out[i]);
        }
    } else {
        for (const std::string& input : inputs) {
            FrameFiles& files = list.emplace_back();
            files.input = input;
            for (const std::string& output : outputs) {
                if (fs::is_directory(output)) {
                    files.outputs.push_back(
                        (fs::path(output) / fs::path(input).filename()).string());
                } else if (inputs.size() == 1) {
                    files.outputs.push_back(output);
                } else {
                    throw InvalidArgument("output", output,
                                          "must be an existing folder for several inputs");
                }
            }
        }
    }
    for (const FrameFiles& files : list) {
        for (const std::string& output : files.outputs) io::check_picture_extension(output);
    }
    return list;
}

void GlareCommand::run() {
    session.start();
    const std::vector<FrameFiles> list = files();
    settings.prepare(list.front().outputs);
    GlareJob job(settings, session);
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
