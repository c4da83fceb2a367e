// aureole glare: glare on pictures and sequences.
#include <memory>

#include "aureole/base/error.h"
#include "camera_observer.h"
#include "commands.h"
#include "eye_observer.h"
#include "field_varying_option.h"
#include "film_options.h"
#include "frame_files.h"
#include "glare_preset.h"
#include "living_eye_observer.h"
#include "motion_options.h"
#include "option_checks.h"
#include "picture_job.h"
#include "thesis_observer.h"

namespace aureole::app {
namespace {

constexpr const char* kFallbackLens = "heliar";

struct GlareCommand {
    void add_options(CLI::App& command);
    void run();
    void check();
    void check_camera();
    void check_eye();
    void check_thesis();
    std::unique_ptr<Observer> observer();

    CLI::App* command_line = nullptr;

    Session session;
    PictureSettings settings;
    SpreadSettings spread;
    ViewOptions view;
    EyeOptions eye;
    MotionOptions motion;
    CameraOptions camera;
    FilmOptions film;
    GhostOptions ghosts;
    LightOptions lights;
    std::vector<std::string> inputs;
    std::string frames;
    std::string observer_name = "eye";
    std::string preset = "physical";
    CLI::Option* preset_option = nullptr;
    std::string psf_file;
    std::string book_file;
    FieldVaryingOption field_varying;
};

void GlareCommand::add_options(CLI::App& command) {
    command_line = &command;
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
    one_of(command.add_option("--observer", observer_name,
                              "eye: scatter and diffraction in an eye; camera: the starburst of an "
                              "iris, and the ghosts of a lens"),
           {"eye", "camera"})
        ->capture_default_str();
    preset_option = one_of(
        command.add_option(
            "--preset", preset,
            "physical: as measured; vivid (eye): what people say they see "
            "(corona contrast 2.5 to 4, streaks x1.5); thesis (eye): the look of "
            "\"Physically-based Real-time Glare\": bright pixels only, saturated needles, halo "
            "and streaks, added; sikachev: streaks of "
            "what is brighter than 1, as clusters, then bloom (--passes both "
            "--method sprites --cluster-error 0.001 --threshold 1 --resolution half "
            "--tone-map xyz --antialias edges; camera: --blades 6 --ghosts none); blog (camera): "
            "ghosts as "
            "drawn by a game, faded polygons of one colour each"),
        {"physical", "vivid", "thesis", "sikachev", "blog"});
    preset_option->capture_default_str();
    view.add_options(command, "60, or the lens's for a camera");
    view.add_white_luminance_option(command);
    CLI::Option_group& group = *command.add_option_group("Applying it");
    group
        .add_option("--psf", psf_file,
                    "Use this kernel (EXR of `aureole psf`, or any odd-sized picture) instead of "
                    "an eye's")
        ->type_name("FILE");
    group
        .add_option("--book", book_file,
                    "With --time or --fps: PSFs of the eye that moves from this flipbook of "
                    "`aureole bake`, instead of computing each")
        ->type_name("FILE");
    field_varying.add_to(group);
    spread.add_options(group);
    settings.add_options(group, command);
    eye.add_options_but_preset(command);
    motion.add_options(command);
    camera.add_options(command, kFallbackLens);
    film.add_options(command);
    lights.add_options(command);
    ghosts.add_options(command);
    session.add_options(command);
}

void GlareCommand::check() {
    view.check();
    spread.check();
    field_varying.check();
    if (field_varying.on()) {
        const auto alone = [&](const std::string& option) {
            if (!option.empty()) {
                throw InvalidArgument(field_varying.first_given() + ": cannot be combined with " +
                                      option);
            }
        };
        alone(psf_file.empty() ? "" : "--psf");
        alone(settings.matte_file.empty() ? "" : "--matte");
        alone(spread.first_selective());
        alone(motion.first_given());
    }
    if (observer_name == "camera") {
        check_camera();
    } else {
        check_eye();
    }
}

void GlareCommand::check_camera() {
    refuse(eye.first_given(), "is an option of the eye: leave it out with --observer camera");
    refuse(motion.first_given(), "is an option of the eye: leave it out with --observer camera");
    refuse(psf_file.empty() ? "" : "--psf", "replaces the eye: leave out --observer camera");
    refuse(view.white_luminance_given() ? "--white-luminance" : "",
           "matters for the eye's pupil only: leave it out with --observer camera");
    refuse(book_file.empty() ? "" : "--book", "needs --observer eye");
    refuse(field_varying.needles() ? "--needles-by-position" : "", "needs --observer eye");
    refuse(preset == "vivid" || preset == "thesis" ? "--preset " + preset : "",
           "needs --observer eye");
    spread.set_star_error();
    const Passes passes = spread.passes();
    refuse(passes == Passes::kOne || passes == Passes::kStreaks ? film.first_given() : "",
           "needs --passes both or bloom");
    ghosts.set_preset(preset);
    ghosts.check();
    refuse(ghosts.any() ? "" : lights.first_given(), "has no effect with --ghosts none");
    lights.check();
}

void GlareCommand::check_eye() {
    for (const std::string& option :
         {camera.first_given(), film.first_given(), lights.first_given(), ghosts.first_given()}) {
        refuse(option, "is an option of the camera: needs --observer camera");
    }
    refuse(preset == "blog" ? "--preset blog" : "", "needs --observer camera");
    if (preset == "thesis") {
        check_thesis();
        return;
    }
    eye.set_preset(preset == "vivid" ? "vivid" : "physical");
    app::check_eye(eye, motion);
    refuse(field_varying.needles() && !eye.has_corona() ? "--needles-by-position" : "",
           "has no effect without a corona: needs --scatter and a --corona-contrast above 0");
    refuse(book_file.empty() || motion.alive() ? "" : "--book " + book_file,
           "is for an eye that moves: needs --time or --fps");
    // The first picture that a run happens to render must not decide for the others.
    refuse(motion.has_rate() && eye.needs_adaptation() ? "--fps" : "",
           "needs a luminance that is known for every frame: --adaptation with a table of `aureole "
           "meter` or a number, or --pupil");
    refuse(motion.has_rate() && motion.squints() && motion.given("--squint") && eye.meters()
               ? "--squint"
               : "",
           "with --fps needs a luminance that is known for every frame: --adaptation with a table "
           "of `aureole meter` or a number");
    refuse(field_varying.streaks() && (eye.streaks() == 0 || eye.eyelashes() == 0)
               ? "--field-varying"
               : "",
           "varies streaks: has no effect with --streaks 0 or --eyelashes 0");
    if (eye.by_color()) {
        const auto alone = [](const std::string& option) {
            if (!option.empty()) {
                throw InvalidArgument("--source-spectrum rgb: cannot be combined with " + option);
            }
        };
        alone(field_varying.first_given());
        alone(spread.method == "fft" || spread.method == "direct" ? ""
                                                                  : "--method " + spread.method);
        alone(spread.surround == "same" ? "--surround same" : "");
        alone(spread.resolution == "full" ? "" : "--resolution " + spread.resolution);
        alone(spread.passes() == Passes::kOne ? "" : "--passes " + spread.passes_name);
        alone(book_file.empty() ? "" : "--book");
    }
    refuse(book_file.empty() || spread.passes() == Passes::kOne ? ""
                                                                : "--passes " + spread.passes_name,
           "cannot be combined with --book: it holds the PSF of everything");
    if (psf_file.empty()) return;
    const std::string option = preset_option->count() > 0   ? preset_option->get_name()
                               : !eye.first_given().empty() ? eye.first_given()
                                                            : motion.first_given();
    if (!option.empty()) {
        throw InvalidArgument("--psf", psf_file, "replaces the eye: leave out " + option);
    }
    refuse(spread.passes() == Passes::kOne ? "" : "--passes " + spread.passes_name,
           "needs an eye or a camera: leave out --psf");
}

void GlareCommand::check_thesis() {
    const auto alone = [](const std::string& option) {
        if (!option.empty()) {
            throw InvalidArgument("--preset thesis: cannot be combined with " + option);
        }
    };
    alone(psf_file.empty() ? "" : "--psf");
    alone(field_varying.first_given());
    alone(spread.passes() == Passes::kOne ? "" : "--passes " + spread.passes_name);
    alone(book_file.empty() ? "" : "--book");
    alone(spread.surround == "dark" ? "" : "--surround " + spread.surround);
    eye.check();
    eye.set_default_pupil_model("thesis");
    spread.set_thesis_look();
}

std::unique_ptr<Observer> GlareCommand::observer() {
    if (observer_name == "camera") {
        return std::make_unique<CameraObserver>(
            camera, ghosts, lights, view,
            CameraSpread{.passes = spread.passes(), .halation = film.halation()}, field_varying,
            session);
    }
    if (!psf_file.empty()) return std::make_unique<KernelObserver>(psf_file, view, session);
    if (preset == "thesis") {
        const bool moving = motion.alive() || !frames.empty();
        return std::make_unique<ThesisObserver>(eye, motion, view, moving, session);
    }
    if (motion.alive()) {
        return std::make_unique<LivingEyeObserver>(eye, motion, view, spread.passes(), book_file,
                                                   session);
    }
    const Metering metering = frames.empty() ? Metering::kEachPicture : Metering::kFirst;
    return std::make_unique<EyeObserver>(eye, view, metering, spread.passes(), field_varying,
                                         session);
}

void GlareCommand::run() {
    session.start();
    std::vector<FrameFiles> list =
        frame_files(inputs, settings.output.paths(), settings.side_by_side_file, frames);
    apply_preset(preset, observer_name, *command_line);
    const bool turns_pages = preset == "thesis" && !motion.alive();
    for (FrameFiles& frame : list) {
        frame.time_s =
            turns_pages ? ThesisObserver::time_of_frame(frame.number) : motion.time_s(frame.number);
    }
    settings.prepare(list);
    check();
    const bool one_moment = list.size() > 1 && motion.alive() && !motion.has_rate();
    refuse(one_moment && !frames.empty() ? "--time" : "",
           "with --frames every frame would be seen at the same moment: needs --fps");
    ghosts.check_pictures(list.size());
    const std::unique_ptr<Observer> who = observer();
    PictureJob job(settings, spread, *who, session);
    job.process(list);
    const std::string summary = job.report();
    auto& parameters = session.json()["parameters"];
    parameters["observer"] = observer_name;
    if (psf_file.empty()) parameters["preset"] = preset;
    session.finish(summary);
}

}  // namespace

Run add_glare_command(CLI::App& app) {
    CLI::App& command =
        *app.add_subcommand("glare", "Add the glare of an eye or a camera to HDR pictures");
    const auto state = std::make_shared<GlareCommand>();
    state->add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
