#include "ghost_options.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/image/finite.h"
#include "aureole/io/picture.h"
#include "aureole/io/text_file.h"
#include "aureole/lens/ghost_settings.h"
#include "option_checks.h"
#include "output_options.h"

namespace aureole::app {
namespace {

using lens::GhostMethod;
using lens::GhostSet;

// Shares that must not be all, or not nothing.
constexpr double kAlmostOne = 0.999999;
constexpr double kAlmostZero = 1e-6;

const char* name_of(GhostMethod method) {
    switch (method) {
        case GhostMethod::kMatrix:
            return "matrix";
        case GhostMethod::kTraced:
            return "traced";
        case GhostMethod::kHybrid:
            return "hybrid";
    }
    return "";
}

// One number, or three for red, green and blue.
std::optional<std::array<float, 3>> weights_of(const std::string& text) {
    const auto numbers = given_numbers(text, ',');
    if (!numbers || (numbers->size() != 1 && numbers->size() != 3)) return std::nullopt;
    std::array<float, 3> rgb = {};
    for (std::size_t c = 0; c < 3; ++c) {
        rgb[c] = static_cast<float>(numbers->size() == 3 ? (*numbers)[c] : (*numbers)[0]);
        if (!(rgb[c] >= 0) || !std::isfinite(rgb[c])) return std::nullopt;
    }
    return rgb;
}

}  // namespace

void GhostOptions::add_options(CLI::App& command) {
    group_ = command.add_option_group("Ghosts");
    method_option_ =
        one_of(group_->add_option("--ghosts", method_,
                                  "matrix: linear optics, fast; traced: exact rays, with folds and "
                                  "dispersion; hybrid: matrix for the ghosts in which it agrees "
                                  "with rays (default); none: no ghosts"),
               {"matrix", "traced", "hybrid", "none"});
    pairs_option_ = one_of(
        group_->add_option("--pairs", pairs_,
                           "Which two surfaces reflect. same-side: both before or both behind the "
                           "stop; all: any (default)"),
        {"same-side", "all"});
    ray_options_ = {
        whole_number(group_->add_option("--wavelengths", options_.wavelengths,
                                        "Bands of the spectrum with rays of their own (traced)"),
                     1, 64)
            ->type_name("N")
            ->capture_default_str(),
        whole_number(group_->add_option("--rays", options_.rays_per_side,
                                        "Rays per side of the grid of a ghost (traced)"),
                     8, 1024)
            ->type_name("N")
            ->capture_default_str()};
    number(group_->add_option("--energy-dropped", options_.energy_dropped,
                              "Leaves out the weakest ghosts up to this share of all their energy"),
           0, kAlmostOne)
        ->type_name("SHARE")
        ->capture_default_str();
    number(group_->add_option("--strongest", options_.strongest,
                              "Draws only this share of the ghosts, the brightest; 1: all"),
           kAlmostZero, 1)
        ->type_name("SHARE")
        ->capture_default_str();
    tolerance_option_ =
        number(group_->add_option("--hybrid-tolerance", options_.hybrid_tolerance,
                                  "Share of the flare's energy that hybrid may displace"),
               kAlmostZero, 1)
            ->type_name("SHARE")
            ->capture_default_str();
    number(group_->add_option("--coarse-tolerance", options_.coarse_tolerance,
                              "Share that drawing large dim ghosts at low resolution may displace; "
                              "0: all at full resolution"),
           0, kAlmostOne)
        ->type_name("SHARE")
        ->capture_default_str();

    look_group_ = command.add_option_group("Looks of ghosts");
    look_group_
        ->add_option("--tint", tint_,
                     "Scales all ghosts: R,G,B in linear light, or one number; 1 is physical")
        ->type_name("R,G,B")
        ->capture_default_str()
        ->check([](const std::string& text) {
            if (!weights_of(text)) {
                throw InvalidArgument("--tint", text,
                                      "must be R,G,B or one number, each at least 0");
            }
            return std::string();
        });
    look_group_
        ->add_option("--ghost-texture", texture_file_,
                     "Picture in place of the iris's shape in every ghost: its first channel, "
                     "black lets no light through")
        ->type_name("FILE");
    look_group_
        ->add_option("--dump-ghosts", dump_file_,
                     "Writes every ghost of the lens as TOML, the strongest first: switch them "
                     "off, scale or tint them there")
        ->type_name("FILE");
    look_group_
        ->add_option("--ghosts-from", settings_file_,
                     "Reads such a file: what it says of a ghost holds")
        ->type_name("FILE");
}

std::string GhostOptions::first_given() const {
    const std::string first = app::first_given(*group_);
    return first.empty() ? app::first_given(*look_group_) : first;
}

GhostMethod GhostOptions::method() const {
    const std::string fallback = preset_ == "blog" ? "matrix" : "hybrid";
    return lens::ghost_method_from_name(any() ? method_.value_or(fallback) : fallback);
}

GhostSet GhostOptions::set() const {
    return pairs_.value_or(preset_ == "blog" ? "same-side" : "all") == "all" ? GhostSet::kAll
                                                                             : GhostSet::kSameSide;
}

void GhostOptions::refuse_with_blog(const CLI::Option* option, const char* unless) const {
    if (preset_ != "blog" || option->count() == 0 || option->results().front() == unless) return;
    throw InvalidArgument(option->get_name(), option->results().front(),
                          std::string("contradicts --preset blog, which is ") + unless);
}

void GhostOptions::refuse_without_ghosts(const CLI::App& group) const {
    for (const CLI::Option* option : group.get_options()) {
        if (option->count() == 0 || option == method_option_) continue;
        throw InvalidArgument(option->get_name(), option->results().front(),
                              "has no effect with --ghosts none");
    }
}

void GhostOptions::check() const {
    if (!any()) {
        refuse_without_ghosts(*group_);
        refuse_without_ghosts(*look_group_);
    }
    refuse_with_blog(method_option_, "matrix");
    refuse_with_blog(pairs_option_, "same-side");
    for (const CLI::Option* option : ray_options_) {
        if (option->count() > 0 && method() == GhostMethod::kMatrix) {
            throw InvalidArgument(option->get_name(), option->results().front(),
                                  "is for rays: needs --ghosts traced or hybrid");
        }
    }
    if (tolerance_option_->count() > 0 && method() != GhostMethod::kHybrid) {
        throw InvalidArgument(tolerance_option_->get_name(), tolerance_option_->results().front(),
                              "needs --ghosts hybrid");
    }
    if (!dump_file_.empty()) check_folder(dump_file_);
}

void GhostOptions::check_pictures(std::size_t pictures) const {
    if (dump_file_.empty() || pictures == 1) return;
    throw InvalidArgument(
        "--dump-ghosts", dump_file_,
        "tells of the ghosts in one picture, and there are " + std::to_string(pictures));
}

lens::FlareOptions GhostOptions::options(const lens::Lens& lens) const {
    lens::FlareOptions options = options_;
    options.method = method();
    options.set = set();
    options.look = preset_ == "blog" ? lens::Look::kBlog : lens::Look::kPhysical;
    options.tint = *weights_of(tint_);
    if (!settings_file_.empty()) {
        options.ghosts = lens::ghosts_from_toml(io::read_text_file(settings_file_), settings_file_,
                                                lens::enumerate_ghosts(lens, options.set));
    }
    if (!texture_file_.empty()) {
        io::Picture picture = io::read_picture(texture_file_);
        replace_nonfinite(picture.color());
        options.ghost_texture = copy(picture.image().view().channel_range(0, 1));
    }
    return options;
}

void GhostOptions::dump(const std::string& lens_name, const lens::Lens& lens,
                        const lens::FlareOptions& options, const lens::FlareReport& report) const {
    io::write_text_file(dump_file_,
                        lens::ghosts_to_toml(lens_name, lens::enumerate_ghosts(lens, options.set),
                                             options.ghosts, &report));
}

nlohmann::ordered_json GhostOptions::report(const lens::FlareOptions& options) const {
    if (!any()) return {{"preset", preset_}, {"ghosts", "none"}};
    nlohmann::ordered_json json = {{"preset", preset_},
                                   {"ghosts", name_of(options.method)},
                                   {"pairs", options.set == GhostSet::kAll ? "all" : "same-side"},
                                   {"energy_dropped", options.energy_dropped},
                                   {"strongest", options.strongest},
                                   {"coarse_tolerance", options.coarse_tolerance},
                                   {"tint", options.tint}};
    if (options.method != GhostMethod::kMatrix) {
        json["wavelengths"] = options.wavelengths;
        json["rays"] = options.rays_per_side;
    }
    if (options.method == GhostMethod::kHybrid) json["hybrid_tolerance"] = options.hybrid_tolerance;
    if (!texture_file_.empty()) json["ghost_texture"] = texture_file_;
    if (!settings_file_.empty()) json["ghosts_from"] = settings_file_;
    return json;
}

nlohmann::ordered_json report_of(const lens::FlareReport& report) {
    using Drawn = lens::GhostReport::Drawn;
    const auto count = [&](Drawn drawn) {
        return std::count_if(report.ghosts.begin(), report.ghosts.end(),
                             [&](const lens::GhostReport& ghost) { return ghost.drawn == drawn; });
    };
    return {{"count", report.ghosts.size()},
            {"matrix", count(Drawn::kMatrix)},
            {"traced", count(Drawn::kTraced)},
            {"dropped", count(Drawn::kDropped)},
            {"disabled", count(Drawn::kDisabled)},
            {"blocked", count(Drawn::kBlocked)},
            {"energy_dropped", report.energy_dropped},
            {"coarse_displaced", report.coarse_displaced},
            {"rays", report.rays}};
}

}  // namespace aureole::app
