#include "spread_options.h"

#include <cmath>
#include <map>

#include "aureole/base/error.h"
#include "aureole/color/tone_curve.h"
#include "aureole/eye/thesis_glare.h"
#include "option_checks.h"

namespace aureole::app {

void SpreadSettings::add_options(CLI::App& group) {
    one_of(group.add_option("--passes", passes_name,
                            "one: streaks and bloom at once; both: first the streaks of lashes or "
                            "iris, then the bloom of eye or film on the picture with streaks; "
                            "streaks, bloom: one of the two alone. In these, --threshold, --method "
                            "and what belongs to it are for streaks; bloom is exact and of all "
                            "light"),
           {"one", "both", "streaks", "bloom"})
        ->capture_default_str();
    CLI::Option* const method_option =
        one_of(group.add_option("--method", method,
                                "fft: exact; direct: the plain double sum, exact and slow. To "
                                "within --cluster-error: sprites: the kernel drawn for each light; "
                                "hybrid: near by fft, far by sprites; auto: for each picture the "
                                "fastest, which depends on the machine"),
               {"fft", "direct", "sprites", "hybrid", "auto"});
    method_option->capture_default_str();
    one_of(group.add_option("--resolution", resolution,
                            "Of what is done by fft. half, quarter: what lights send far away is "
                            "computed on a raster of 2 or 4 pixels, what is near is as at full "
                            "resolution; quarter is some 20 % faster. The error, at most 1e-3 of "
                            "the light, is in --json"),
           {"full", "half", "quarter"})
        ->capture_default_str();
    cluster_options_ = {
        number(group.add_option("--cluster-error", cluster_error,
                                "Of sprites, hybrid and auto: largest sum of |difference| from "
                                "fft, over the sum of the light (default: 0.01, camera 0.001)"),
               1e-6, 0.5)
            ->type_name("E"),
        one_of(group.add_option("--cluster-side", cluster_side,
                                "Of the same: side in pixels of the largest clusters of lights "
                                "that are drawn as one; 1: each pixel by itself"),
               {"1", "2", "4", "8", "16", "32", "64"})
            ->capture_default_str()};
    threshold_option_ =
        number(group.add_option("--threshold", threshold,
                                "Pixel values below make no glare (continuous ramp); 0 is "
                                "physical"),
               0, 1e30)
            ->type_name("V")
            ->capture_default_str();
    gain_option_ =
        number(group.add_option("--gain", gain, "Scales the scattered light; 1 conserves energy"),
               0, 1e6)
            ->type_name("G")
            ->capture_default_str();
    one_of(group.add_option("--surround", surround,
                            "What lies beyond the border. dark: nothing, borders lose light; same: "
                            "for each pixel surroundings as bright as itself"),
           {"dark", "same"})
        ->capture_default_str();
    streak_options_ = cluster_options_;
    streak_options_.insert(streak_options_.begin(), {threshold_option_, method_option});
}

void SpreadSettings::check() const {
    if (passes() == Passes::kBloom) {
        for (const CLI::Option* option : streak_options_) {
            if (option->count() == 0) continue;
            throw InvalidArgument(option->get_name(), option->results().front(),
                                  "is for streaks: has no effect with --passes bloom");
        }
    }
    const bool bloom = passes() == Passes::kBoth || passes() == Passes::kBloom;
    if (resolution != "full" && method != "fft" && !bloom) {
        throw InvalidArgument("--resolution", resolution,
                              "must be full with --method " + method + ": it is for what fft does");
    }
    if (method != "fft" && method != "direct") return;
    for (const CLI::Option* option : cluster_options_) {
        if (option->count() == 0) continue;
        throw InvalidArgument(option->get_name(), option->results().front(),
                              "needs --method sprites, hybrid or auto: " + method + " is exact");
    }
}

Passes SpreadSettings::passes() const {
    static const std::map<std::string, Passes> kNames = {{"one", Passes::kOne},
                                                         {"both", Passes::kBoth},
                                                         {"streaks", Passes::kStreaks},
                                                         {"bloom", Passes::kBloom}};
    return kNames.at(passes_name);
}

void SpreadSettings::set_thesis_look() {
    if (threshold_option_->count() == 0) threshold = eye::kThesisThreshold;
    if (gain_option_->count() == 0) gain = eye::kThesisFinalGain;
    source_tone_map = "unity";
    source_factor = eye::kThesisSourceFactor;
    added = true;
}

void SpreadSettings::set_star_error() {
    constexpr double kStarError = 0.001;
    if (cluster_options_.front()->count() == 0) cluster_error = kStarError;
}

glare::GlareOptions SpreadSettings::options(bool matte, double exposure_ev) const {
    glare::GlareOptions options = bloom_options(matte);
    options.method = glare::method_from_name(method);
    if (options.method != glare::Method::kFft) options.resolution = glare::Resolution::kFull;
    options.cluster_error = cluster_error;
    options.cluster_side = cluster_side;
    options.threshold = static_cast<float>(threshold);
    options.gain = static_cast<float>(source_factor * gain);
    options.added = added;
    if (source_tone_map != "none") {
        options.source_curve = color::tone_curve_from_name(source_tone_map);
        options.exposure_scale = static_cast<float>(std::exp2(exposure_ev));
    }
    return options;
}

glare::GlareOptions SpreadSettings::bloom_options(bool matte) const {
    glare::GlareOptions options;
    options.resolution = glare::resolution_from_name(resolution);
    options.gain = static_cast<float>(gain);
    options.matte = matte;
    options.surround = glare::surround_from_name(surround);
    return options;
}

std::string SpreadSettings::first_selective() const {
    if (passes() != Passes::kOne) return "--passes " + passes_name;
    if (method != "fft") return "--method " + method;
    if (resolution != "full") return "--resolution " + resolution;
    if (threshold != 0) return "--threshold";
    if (gain != 1) return "--gain";
    return surround == "same" ? "--surround same" : "";
}

nlohmann::ordered_json SpreadSettings::report() const {
    nlohmann::ordered_json json = {{"passes", passes_name},
                                   {"resolution", resolution},
                                   {"gain", gain},
                                   {"surround", surround},
                                   {"source_tone_map", source_tone_map},
                                   {"source_factor", source_factor},
                                   {"composite", added ? "added" : "conserving"}};
    if (passes() != Passes::kBloom) {
        json.update({{"cluster_error", cluster_error},
                     {"cluster_side", cluster_side},
                     {"threshold", threshold}});
    }
    return json;
}

}  // namespace aureole::app
