// aureole meter: what luminance an eye adapts to, frame by frame.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>

#include "aureole/base/error.h"
#include "aureole/eye/luminance_curve.h"
#include "aureole/eye/metering.h"
#include "aureole/eye/ranges.h"
#include "aureole/io/picture.h"
#include "aureole/io/text_file.h"
#include "commands.h"
#include "frame_files.h"
#include "input_picture.h"
#include "motion_options.h"
#include "option_checks.h"
#include "output_options.h"
#include "session.h"
#include "view_options.h"

namespace aureole::app {
namespace {

struct MeterCommand {
    void add_options(CLI::App& command);
    void run();
    std::vector<FrameFiles> checked_files() const;
    eye::MeteredLuminance metered(const std::string& file);

    Session session;
    ViewOptions view;
    std::vector<std::string> inputs;
    std::string frames;
    std::string output;
    double fps = 24;
    std::string adapt_to = "mean";
    std::size_t nonfinite_pixels = 0;
};

void MeterCommand::add_options(CLI::App& command) {
    command
        .add_option("INPUT", inputs,
                    "Linear HDR pictures, or a numbered sequence (shot.%04d.exr) with --frames")
        ->required()
        ->type_name("FILE");
    command.add_option("-o,--output", output, "Table to write (CSV), for `glare --adaptation`")
        ->required()
        ->type_name("FILE");
    command.add_option("--frames", frames, "Frames of a sequence: 1001-1240, 1-10x2, 1,5,9")
        ->type_name("RANGE");
    positive_number(
        command.add_option("--fps", fps, "Frames per second: frame N is seen at N / F seconds"))
        ->type_name("F")
        ->capture_default_str();
    one_of(command.add_option("--adapt-to", adapt_to, "Which luminance the eye adapts to"),
           {"mean", "log-mean", "central"})
        ->capture_default_str();
    view.add_options(command);
    view.add_white_luminance_option(command);
    session.add_options(command);
}

// In order of their times.
std::vector<FrameFiles> MeterCommand::checked_files() const {
    check_folder(output);
    if (io::has_picture_extension(output)) {
        throw InvalidArgument("--output", output,
                              "a table (CSV) is written, no picture: must not end like one");
    }
    std::vector<FrameFiles> list = frame_files(inputs, {}, "", frames);
    for (FrameFiles& frame : list) {
        std::error_code ignored;
        if (std::filesystem::equivalent(output, frame.input, ignored)) {
            throw InvalidArgument("--output", output, "is an INPUT, which would be overwritten");
        }
        frame.time_s = frame_time_s(frame.number, fps);
    }
    std::sort(list.begin(), list.end(),
              [](const FrameFiles& a, const FrameFiles& b) { return a.number < b.number; });
    return list;
}

eye::MeteredLuminance MeterCommand::metered(const std::string& file) {
    const InputPicture input = read_input(file, session);
    const io::Picture& picture = input.picture;
    nonfinite_pixels += input.nonfinite_pixels;
    const View seen = view.view_of(picture, session);
    return session.timed("meter", [&] {
        return eye::meter(over_display_window(picture.color(), picture), seen,
                          view.white_luminance(picture));
    });
}

void MeterCommand::run() {
    session.start();
    view.check();
    const std::vector<FrameFiles> list = checked_files();
    std::vector<eye::MeteredLuminance> rows;
    std::vector<double> times_s;
    std::vector<double> luminances;
    for (const FrameFiles& frame : list) {
        session.check_interrupt();
        rows.push_back(metered(frame.input));
        times_s.push_back(frame.time_s);
        const double seen = adapt_to == "mean"       ? rows.back().mean
                            : adapt_to == "log-mean" ? rows.back().log_mean
                                                     : rows.back().central;
        luminances.push_back(std::min(seen, eye::kBrightestCdM2));
        if (list.size() > 1) {
            session.report("frames",
                           static_cast<double>(rows.size()) / static_cast<double>(list.size()));
        }
    }
    const eye::LuminanceCurve curve(times_s, luminances);
    std::string text = "frame,time_s,mean_cd_m2,log_mean_cd_m2,central_cd_m2,adaptation_cd_m2\n";
    auto& json_rows = session.json()["frames"];
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double adaptation = eye::damped_luminance_cd_m2(curve, times_s[i]);
        fmt::format_to(std::back_inserter(text), "{},{},{:.9g},{:.9g},{:.9g},{:.9g}\n",
                       list[i].number, times_s[i], rows[i].mean, rows[i].log_mean, rows[i].central,
                       adaptation);
        json_rows.push_back({{"frame", list[i].number},
                             {"time_s", times_s[i]},
                             {"mean_cd_m2", rows[i].mean},
                             {"log_mean_cd_m2", rows[i].log_mean},
                             {"central_cd_m2", rows[i].central},
                             {"adaptation_cd_m2", adaptation}});
    }
    io::write_text_file(output, text);
    session.json()["outputs"] = {output};
    session.json()["nonfinite_pixels"] = nonfinite_pixels;
    const eye::PupilReflex reflex;
    session.json()["parameters"] = {{"fps", fps},
                                    {"adapt_to", adapt_to},
                                    {"delay_s", reflex.delay_s},
                                    {"constriction_s", reflex.constriction_s},
                                    {"dilation_s", reflex.dilation_s}};
    session.finish(output + "\n");
}

}  // namespace

Run add_meter_command(CLI::App& app) {
    CLI::App& command = *app.add_subcommand(
        "meter", "Measure the luminance of a sequence, and the eye's adaptation to it");
    const auto state = std::make_shared<MeterCommand>();
    state->add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
