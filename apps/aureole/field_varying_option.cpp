#include "field_varying_option.h"

#include <charconv>

#include "aureole/base/error.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

constexpr const char* kAllowed = "must be off, on, rank=1 to rank=4096, or 0.5 to 30 (deg)";
constexpr std::string_view kRank = "rank=";
constexpr int kMostRank = 4096;

}  // namespace

void FieldVaryingOption::add_to(CLI::Option_group& group) {
    group
        .add_option("--field-varying", text_,
                    "on: glare changes with the position of each light: an eye's streaks turn, as "
                    "lashes 12 mm before the pupil do, a camera's stars take the shape that its "
                    "mounts leave of the pupil; DEG: on, computed every so many degrees (0.5 to "
                    "30; on: 1.1, camera 4); rank=K: on, with K principal components in place of "
                    "all kernels: less memory, larger errors; off: that of the axis everywhere")
        ->type_name("off|on|rank=K|DEG")
        ->capture_default_str();
    group.add_flag("--needles-by-position", needles_,
                   "Eye: stars in different places show different needles, those of 8 deg wide "
                   "regions, as light from there meets the particles in the eye");
}

std::string FieldVaryingOption::first_given() const {
    if (on_) return "--field-varying";
    return needles_ ? "--needles-by-position" : "";
}

void FieldVaryingOption::report(nlohmann::ordered_json& parameters) const {
    parameters["field_varying"] = text_;
    parameters["needles_by_position"] = needles_;
}

nlohmann::ordered_json FieldVaryingOption::nodes(double spacing_deg, int rank,
                                                 const wave::VaryingPsf& psf,
                                                 const wave::FieldError& error) {
    std::size_t kernels = 0;
    for (const auto& part : psf.parts) kernels += part.halves.size();
    return {{"spacing_deg", spacing_deg},
            {"rank", rank},
            {"kernels", kernels},
            {"bytes", fourier::bytes(psf.parts)},
            {"held_out_positions", error.positions},
            {"error", error.l1},
            {"error_mean_of_ratios", error.mean},
            {"error_worst", error.worst}};
}

void FieldVaryingOption::check() {
    on_ = text_ != "off";
    if (!on_ || text_ == "on") return;
    if (text_.starts_with(kRank)) {
        const char* end = text_.data() + text_.size();
        const auto [stopped, error] = std::from_chars(text_.data() + kRank.size(), end, rank_);
        if (error == std::errc() && stopped == end && rank_ >= 1 && rank_ <= kMostRank) return;
    } else {
        spacing_deg_ = given_number(text_).value_or(0);
        if (spacing_deg_ >= 0.5 && spacing_deg_ <= 30) return;
    }
    throw InvalidArgument("--field-varying", text_, kAllowed);
}

}  // namespace aureole::app
