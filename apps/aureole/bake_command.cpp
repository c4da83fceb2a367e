// aureole bake: the range of motion of an eye's glare as a flipbook.
#include <fmt/core.h>

#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/eye/flipbook_bake.h"
#include "aureole/fourier/sizes.h"
#include "aureole/io/binary_file.h"
#include "commands.h"
#include "eye_options.h"
#include "option_checks.h"
#include "output_options.h"
#include "session.h"
#include "view_options.h"

namespace aureole::app {
namespace {

struct BakeCommand {
    void add_options(CLI::App& command);
    void run();
    void check();
    // Measures and reports how far the book is from direct computation; a summary of it.
    std::string measure(const eye::Flipbook& book, const eye::Eye& eye,
                        const eye::EyePsfOptions& options);

    Session session;
    ViewOptions view_options;
    EyeOptions eye_options;
    std::string output;
    int width = 1920;
    std::optional<int> height;
    int size = 512;
    std::string pupils = "2,8";
    std::string texture_frames;
    int halo_frames = eye::FlipbookRange().halo_pupils;
    int streak_frames = eye::FlipbookRange().streak_pupils;
    int lid_states = eye::FlipbookRange().lid_states;
    int poses = 4;
    eye::FlipbookRange range;
};

void BakeCommand::add_options(CLI::App& command) {
    const eye::FlipbookRange usual;
    texture_frames = fmt::format("{},{},{},{}", usual.texture_pupils, usual.lens_states,
                                 usual.vitreous_phases, usual.covered_phases);
    command.add_option("-o,--output", output, "The flipbook: for `aureole glare --book`")
        ->required()
        ->type_name("BOOK");
    whole_number(
        command.add_option("--width", width, "Width in pixels of the pictures the book is for"), 1,
        1 << 16)
        ->type_name("PIXELS")
        ->capture_default_str();
    whole_number(
        command.add_option("--height", height, "Their height (default: 9/16 of the width)"), 1,
        1 << 16)
        ->type_name("PIXELS");
    whole_number(command.add_option("--size", size,
                                    "Pixels of diffraction, square: even, with no prime factor "
                                    "above 7. What lies farther out is scatter alone"),
                 64, 4096)
        ->type_name("PIXELS")
        ->capture_default_str();
    CLI::Option_group& group = *command.add_option_group("Its range of motion");
    group.add_option("--pupils", pupils, "Smallest and largest pupil, 1 to 9 mm")
        ->type_name("MM,MM")
        ->capture_default_str();
    whole_number(group.add_option("--lid-states", lid_states,
                                  fmt::format("Closures of lids and lashes, from open to {:.0f} %",
                                              100 * usual.largest_closure)),
                 1, 100)
        ->type_name("C")
        ->capture_default_str();
    group
        .add_option("--texture-frames", texture_frames,
                    "Of the corona: pupils, states of the lens (odd) and phases of the vitreous "
                    "with open lids, phases behind closing ones; P x (L + V - 1 + (C - 1) x B) "
                    "frames")
        ->type_name("P,L,V,B")
        ->capture_default_str();
    whole_number(group.add_option("--halo-frames", halo_frames,
                                  "Of the halo: pupils, from 4 mm on; P x C frames"),
                 1, 100)
        ->type_name("P")
        ->capture_default_str();
    whole_number(group.add_option("--streak-frames", streak_frames,
                                  "Of the streaks: pupils; P x (2 C - 1) frames, of lashes alone "
                                  "and of lids"),
                 1, 100)
        ->type_name("P")
        ->capture_default_str();
    whole_number(group.add_option("--measure", poses,
                                  "Poses at which the book is compared with direct computation: "
                                  "so many at frames and between, with open and with closing "
                                  "lids; 0: none"),
                 0, 100)
        ->type_name("N")
        ->capture_default_str();
    view_options.add_options(command, "60");
    eye_options.add_options_of_the_person(command);
    session.add_options(command);
}

// "7,3,4" as whole numbers; `count` of them.
std::vector<int> whole_numbers(const char* option, const std::string& text, std::size_t count) {
    const auto numbers = given_numbers(text, ',');
    std::vector<int> result;
    for (const double number : numbers.value_or(std::vector<double>())) {
        if (number == std::floor(number) && number >= 1 && number <= 100) {
            result.push_back(static_cast<int>(number));
        }
    }
    if (numbers && numbers->size() == count && result.size() == count) return result;
    throw InvalidArgument(
        option, text,
        fmt::format("must be {} whole numbers from 1 to 100, with commas between", count));
}

void BakeCommand::check() {
    check_folder(output);
    view_options.check();
    if (size % 2 != 0 || !fourier::is_smooth(size)) {
        throw InvalidArgument("--size", fmt::format("{}", size),
                              "must be even, without prime factors above 7");
    }
    const auto limits = given_numbers(pupils, ',');
    if (!limits || limits->size() != 2 || !((*limits)[0] >= 1) || !((*limits)[1] <= 9) ||
        !((*limits)[0] <= (*limits)[1])) {
        throw InvalidArgument("--pupils", pupils,
                              "must be two numbers from 1 to 9, the smaller first");
    }
    range.pupil_from_mm = (*limits)[0];
    range.pupil_to_mm = (*limits)[1];
    const std::vector<int> texture = whole_numbers("--texture-frames", texture_frames, 4);
    range.texture_pupils = texture[0];
    range.lens_states = texture[1];
    range.vitreous_phases = texture[2];
    range.covered_phases = texture[3];
    if (range.lens_states % 2 == 0) {
        throw InvalidArgument("--texture-frames", texture_frames,
                              "states of the lens must be odd: the middle one is at rest");
    }
    range.halo_pupils = halo_frames;
    range.streak_pupils = streak_frames;
    range.lid_states = lid_states;
    if (eye_options.by_color()) {
        throw InvalidArgument("--source-spectrum", "rgb",
                              "must be a lamp's: a flipbook has no PSF for each colour of light");
    }
}

// A number as a number.
nlohmann::ordered_json json_of(const std::string& value) {
    auto number = nlohmann::ordered_json::parse(value, nullptr, false);
    return number.is_number() ? number : nlohmann::ordered_json(value);
}

nlohmann::ordered_json json_of(const eye::FlipbookErrors& errors) {
    return {{"poses", errors.poses}, {"texture", errors.texture},
            {"halo", errors.halo},   {"streaks", errors.streaks},
            {"psf", errors.psf},     {"worst_ring", errors.worst_ring}};
}

std::string BakeCommand::measure(const eye::Flipbook& book, const eye::Eye& eye,
                                 const eye::EyePsfOptions& options) {
    auto& json = session.json()["errors"];
    std::string at_frames;
    std::string between_frames;
    const auto measure_with = [&](eye::FlipbookLids lids, const char* key, const char* words) {
        const auto at = errors_at_frames(book, eye, options, lids, poses, &session);
        if (at.poses == 0) return;
        const auto between = errors_between_frames(book, eye, options, lids, poses, &session);
        json["from_deg"] = at.from_deg;
        json["to_deg"] = at.to_deg;
        json["at_frames"][key] = json_of(at);
        json["between_frames"][key] = json_of(between);
        at_frames += fmt::format("{}{:.2g} %{}", at_frames.empty() ? "at its frames within " : ", ",
                                 100 * at.worst_ring, words);
        between_frames += fmt::format(
            "between them{}: texture {:.0f} %, halo {:.0f} %, streaks {:.0f} %, all {:.1f} %\n",
            words, 100 * between.texture, 100 * between.halo, 100 * between.streaks,
            100 * between.psf);
    };
    session.timed("measure", [&] {
        measure_with(eye::FlipbookLids::kOpen, "open_lids", "");
        measure_with(eye::FlipbookLids::kCovering, "covering_lids", " behind closing lids");
    });
    if (at_frames.empty()) {
        return "no pose to measure: its patterns end within 0.3 deg, or no frames of all its terms "
               "belong together\n";
    }
    return fmt::format("{} (worst ring from {:.2g} to {:.2g} deg)\n{}", at_frames,
                       json["from_deg"].get<double>(), json["to_deg"].get<double>(),
                       between_frames);
}

void BakeCommand::run() {
    session.start();
    check();
    const View view = view_options.view_of_size(width, height.value_or((width * 9 + 8) / 16));
    const wave::KernelGrid grid = wave::KernelGrid::square(view, size - 1);
    constexpr double kAnyLuminance = 10;  // the pupil does not matter
    const eye::Eye eye = eye_options.eye(kAnyLuminance, view);
    if (eye.scatter == eye::ScatterModel::kNone) {
        throw InvalidArgument("--scatter", "none",
                              "must be cie or ijspeert: what a flipbook stores is relative to it");
    }
    eye::EyePsfOptions options;
    options.spectral = eye_options.sampling();
    const std::vector<std::byte> bytes = session.timed(
        "bake", [&] { return eye::bake_flipbook(eye, grid, range, options, &session); });
    const eye::Flipbook book(bytes);
    auto& json = session.json();
    json["outputs"] = {output};
    std::map<eye::Component, int> frames;
    for (const auto& frame : eye::frames_of(range)) ++frames[frame.component];
    json["frames"] = {{"texture", frames[eye::Component::kCorona]},
                      {"halo", frames[eye::Component::kHalo]},
                      {"streaks", frames[eye::Component::kStreaks]}};
    json["bytes"] = bytes.size();
    std::string summary = fmt::format("{}\n{} frames, {:.1f} MB\n", output, book.frames().size(),
                                      static_cast<double>(bytes.size()) / 1e6);
    if (poses > 0) summary += measure(book, eye, options);
    session.check_interrupt();
    session.timed("write", [&] { io::write_binary_file(output, bytes); });

    auto& parameters = json["parameters"];
    for (const auto& [name, value] : book.identity()) parameters[name] = json_of(value);
    parameters.update(
        {{"width", view.width},
         {"height", view.height},
         {"fov_deg", view.horizontal_field_deg()},
         {"perspective", view.projection == Projection::kPerspective},
         {"pitch_deg", grid.pitch_deg},
         {"size", size},
         {"pupils_mm", {range.pupil_from_mm, range.pupil_to_mm}},
         {"texture_frames",
          {range.texture_pupils, range.lens_states, range.vitreous_phases, range.covered_phases}},
         {"halo_frames", range.halo_pupils},
         {"streak_frames", range.streak_pupils},
         {"lid_states", range.lid_states},
         {"lens_scale_span", range.lens_scale_span},
         {"vitreous_step_deg", range.vitreous_step_deg},
         {"largest_closure", range.largest_closure},
         {"threads", thread_count()}});
    session.finish(summary);
}

}  // namespace

Run add_bake_command(CLI::App& app) {
    CLI::App& command = *app.add_subcommand(
        "bake", "Compute the range of motion of an eye's glare once, as a flipbook");
    const auto state = std::make_shared<BakeCommand>();
    state->add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
