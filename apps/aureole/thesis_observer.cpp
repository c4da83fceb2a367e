#include "thesis_observer.h"

#include <fmt/format.h>

#include <utility>

#include "eye_observer.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

nlohmann::ordered_json json_of(const eye::ThesisTone& tone, double weight) {
    return {{"power", tone.power},
            {"threshold", tone.threshold},
            {"factor", tone.factor},
            {"weight", weight}};
}

}  // namespace

ThesisObserver::ThesisObserver(const EyeOptions& eye, const MotionOptions& motion,
                               const ViewOptions& view, bool moving, Session& session)
    : options_(eye),
      view_options_(view),
      moving_(moving),
      lids_move_(moving && !eye.given("--eyelid") &&
                 (motion.blink_word() != "off" || !motion.given("--blink"))),
      session_(session) {
    for (const char* name : {"--age", "--pigmentation", "--scatter", "--corona-contrast",
                             "--source-spectrum", "--pupil-shape", "--pupil-rotation"}) {
        refuse(eye.given(name) ? name : "",
               "is about the physical eye: --preset thesis has nothing that it could change");
    }
    refuse(motion.given("--motion") ? "--motion" : "",
           "particles of --preset thesis go round in a loop: leave it out");
    refuse(motion.given("--squint") ? "--squint" : "",
           "lids of --preset thesis do not know the light: --eyelid closes them");
    if (motion.given("--blink")) {
        const std::string word = motion.blink_word();
        refuse(word == "off" || word == "auto" ? "" : "--blink " + word,
               "lids of --preset thesis go up and down by themselves: must be auto or off");
        refuse(word == "auto" && eye.given("--eyelid") ? "--eyelid" : "",
               "cannot be combined with --blink auto");
    }
    refuse(eye.adaptation_file().empty() ? "" : "--adaptation " + eye.adaptation_file(),
           "is a table over time: --preset thesis takes auto or a number");
    if (!moving_) motion.check();
    look_.eyelashes = eye.eyelashes();
    look_.seed = eye.seed();
    look_.halo_weight *= eye.halo();
    look_.streaks_weight *= eye.streaks();
    eye::check(look_);
}

double ThesisObserver::time_of_frame(int number) { return number / eye::kThesisFramesPerSecond; }

View ThesisObserver::view_of(const io::Picture& picture) {
    view_ = view_options_.view_of(picture, session_);
    return view_;
}

bool ThesisObserver::adapt(const io::Picture& picture) {
    white_luminance_cd_m2_ = view_options_.white_luminance(picture);
    eye::ThesisFrames frames;
    if (moving_) {
        frames = eye::thesis_frames(eye::thesis_frame_at(time_s_));
        if (!lids_move_) frames.lids = 0;
    }
    if (options_.given("--eyelid")) frames.lids = eye::thesis_lid_page(options_.eyelid());
    if (options_.pupil_given()) {
        pupil_mm_ = options_.pupil_mm(
            options_.needs_adaptation() ? metered_cd_m2(picture, white_luminance_cd_m2_) : 0,
            view_);
        frames.pupil = eye::thesis_pupil_page(*pupil_mm_);
        note_clamped(*pupil_mm_);
        frames.gratings = frames.pupil;
    }
    const bool same = frames_ == frames;
    frames_ = frames;
    return same;
}

void ThesisObserver::note_clamped(double pupil_mm) {
    const double narrowest_mm = eye::thesis_pupil_mm(0);
    const double widest_mm = eye::thesis_pupil_mm(eye::kThesisFrames - 1);
    constexpr double kRoundingMm = 0.05;
    if (pupil_mm > narrowest_mm - kRoundingMm && pupil_mm < widest_mm + kRoundingMm) return;
    session_.note(fmt::format(
        "--preset thesis: pupils beyond its {:.2g} to {:.2g} mm are shown by its nearest page",
        narrowest_mm, widest_mm));
}

Spreading ThesisObserver::spreading(const View& /*display*/, const View& data) {
    eye::ThesisGlare glare = eye::thesis_glare(look_, *frames_, data, &session_);
    energy_ = glare.energy;
    return {.streaks = nullptr, .rest = shared(std::move(glare.psf))};
}

void ThesisObserver::report(nlohmann::ordered_json& json) const {
    auto& parameters = json["parameters"];
    parameters.update({{"preset", "thesis"},
                       {"white_luminance_cd_m2", white_luminance_cd_m2_},
                       {"pages",
                        {{"pupil", frames_->pupil},
                         {"gratings", frames_->gratings},
                         {"particles", frames_->particles},
                         {"lids", frames_->lids}}},
                       {"pupil_mm", eye::thesis_pupil_mm(frames_->pupil)},
                       {"lens_scale", eye::thesis_lens_scale(frames_->gratings)},
                       {"eyelid", eye::thesis_lid_closure(frames_->lids)},
                       {"bloom", json_of(look_.bloom, look_.bloom_weight)},
                       {"halo", json_of(look_.halo, look_.halo_weight)},
                       {"corona", json_of(look_.corona, look_.corona_weight)},
                       {"streaks", json_of(look_.streaks, look_.streaks_weight)},
                       {"gratings", look_.gratings},
                       {"particles", look_.particles},
                       {"eyelashes", look_.eyelashes},
                       {"wavelengths", look_.wavelengths},
                       {"bend", look_.bend},
                       {"height_deg", look_.height_deg},
                       {"kernel_energy", energy_},
                       {"seed", look_.seed}});
    if (moving_) {
        parameters.update({{"time_s", time_s_},
                           {"pages_per_second", eye::kThesisFramesPerSecond},
                           {"blink", lids_move_ ? "auto" : "off"}});
    }
}

}  // namespace aureole::app
