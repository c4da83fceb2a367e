#include "light_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

constexpr const char* kForm =
    "must be X,Y,RADIANCE or X,Y,RADIANCE,DIAMETER_DEG; X,Y in pixels from the top left corner "
    "(1200,-40) or to the right and up from the axis (12deg,-3deg); RADIANCE one number or R:G:B, "
    "at least 0; DIAMETER_DEG from 0 to below 90";

std::vector<std::string> parts_of(const std::string& text) {
    std::vector<std::string> parts;
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t end = std::min(text.find(',', start), text.size());
        parts.push_back(text.substr(start, end - start));
        start = end + 1;
    }
    return parts;
}

// "12deg" as 12.
std::optional<double> given_angle(const std::string& text) {
    if (!text.ends_with("deg")) return std::nullopt;
    return given_number(text.substr(0, text.size() - 3));
}

// The picture's colour times the matte.
Image under_matte(const ConstImageView& color, const float* matte) {
    Image result = copy(color);
    for (int c = 0; c < result.channels(); ++c) {
        float* plane = result.plane(c);
        for (std::size_t i = 0; i < result.pixels(); ++i) plane[i] *= matte[i];
    }
    return result;
}

}  // namespace

void LightOptions::add_options(CLI::App& command) {
    group_ = command.add_option_group("Lights");
    group_
        ->add_option(
            "--light", given_,
            "A light at X,Y,RADIANCE[,DIAMETER_DEG], in place of those of the picture; may "
            "be repeated. X,Y: pixels from the top left corner of the display window, also "
            "outside of it; or degrees to the right and up from the axis, as in "
            "12deg,-3deg. RADIANCE: in the picture's units, one number or R:G:B. "
            "DIAMETER_DEG: 0.53 for the sun; without it a point as bright as one pixel")
        ->type_name("LIGHT")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    group_->add_flag("--found-lights", found_too_,
                     "With --light: also the lights found in the picture");
    search_options_ = {
        number_or_auto(group_->add_option("--light-threshold", threshold_,
                                          "Luminance in the picture's units above which pixels "
                                          "are lights, fully from twice that on; auto: 16 times "
                                          "the mean of the picture"))
            ->type_name("auto|V")
            ->capture_default_str(),
        whole_number(group_->add_option("--max-lights", max_lights_,
                                        "The strongest so many of those found; the others make no "
                                        "ghosts"),
                     1, 100000)
            ->type_name("N")
            ->capture_default_str()};
}

std::string LightOptions::first_given() const { return app::first_given(*group_); }

LightOptions::Given LightOptions::parse(const std::string& text) {
    const auto wrong = [&] { return InvalidArgument("--light", text, kForm); };
    const std::vector<std::string> parts = parts_of(text);
    if (parts.size() < 3 || parts.size() > 4) throw wrong();
    Given given;
    std::optional<double> x = given_angle(parts[0]);
    std::optional<double> y = given_angle(parts[1]);
    given.angles = x && y;
    if (!given.angles) {
        x = given_number(parts[0]);
        y = given_number(parts[1]);
    }
    const std::optional<std::vector<double>> radiance = given_numbers(parts[2], ':');
    const std::optional<double> diameter = parts.size() == 4 ? given_number(parts[3]) : 0.0;
    if (!x || !y || !radiance || !diameter) throw wrong();
    if ((radiance->size() != 1 && radiance->size() != 3) || !(*diameter >= 0 && *diameter < 90)) {
        throw wrong();
    }
    given.x = *x;
    given.y = *y;
    given.diameter_deg = *diameter;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto value =
            static_cast<float>(radiance->size() == 3 ? (*radiance)[c] : (*radiance)[0]);
        if (!(value >= 0) || !std::isfinite(value)) throw wrong();
        given.radiance[c] = value;
    }
    return given;
}

void LightOptions::check() const {
    for (const std::string& text : given_) {
        const Given given = parse(text);
        // Pixels need the picture's view.
        if (given.angles) light(text, View::from_fov(16, 9, 60, Projection::kPerspective));
    }
    if (const auto threshold = given_number(threshold_); threshold && !(*threshold > 0)) {
        throw InvalidArgument("--light-threshold", threshold_, "must be auto or a number above 0");
    }
    for (const CLI::Option* option : search_options_) {
        if (searches() || option->count() == 0) continue;
        throw InvalidArgument("--light", given_.front(),
                              "replaces the lights of the picture: leave out " +
                                  option->get_name() + ", or add --found-lights");
    }
}

sources::Light LightOptions::light(const std::string& text, const View& display) {
    const Given given = parse(text);
    try {
        if (!given.angles) {
            return sources::light_at(display, given.x, given.y, given.radiance, given.diameter_deg);
        }
        const double f = display.focal_length_px();
        return sources::light_in_direction(given.x, given.y, given.radiance, given.diameter_deg,
                                           1 / (f * f));
    } catch (const InvalidArgument& error) {
        throw InvalidArgument("--light", text, error.what());
    }
}

PictureLights LightOptions::lights(const io::Picture& picture, const View& display,
                                   const View& data, const float* matte, Session& session) const {
    PictureLights result;
    for (const std::string& text : given_) {
        result.lights.push_back(light(text, display));
    }
    result.given = result.lights.size();
    if (!searches()) return result;
    sources::FindLightsOptions options;
    options.threshold = static_cast<float>(given_number(threshold_).value_or(0));
    options.max_lights = max_lights_;
    Image masked;
    if (matte != nullptr) masked = under_matte(picture.color(), matte);
    result.searched = true;
    result.search =
        sources::find_lights(matte != nullptr ? masked : picture.color(), data, options);
    const sources::FoundLights& found = result.search;
    result.lights.insert(result.lights.end(), found.lights.begin(), found.lights.end());
    if (found.lights.empty()) {
        session.note(
            fmt::format("no pixel is brighter than {:.4g}: no lights found "
                        "(--light-threshold, --light)",
                        found.threshold));
    } else if (found.energy_dropped > 0) {
        session.note(
            fmt::format("the weakest lights, {:.2g} % of the light found, make no ghosts "
                        "(--max-lights)",
                        100 * found.energy_dropped / (found.energy_kept + found.energy_dropped)));
    }
    return result;
}

nlohmann::ordered_json LightOptions::report() const {
    nlohmann::ordered_json json;
    json["given_lights"] = given_;
    json["found_lights"] = searches();
    if (searches()) json["max_lights"] = max_lights_;
    return json;
}

nlohmann::ordered_json report_of(const PictureLights& lights, const View& display) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < lights.lights.size(); ++i) {
        const sources::Light& light = lights.lights[i];
        const sources::PixelPosition at = sources::position_in(display, light);
        list.push_back({{"x", at.x},
                        {"y", at.y},
                        {"right_deg", deg_from_rad(std::atan(light.tan_x))},
                        {"up_deg", deg_from_rad(std::atan(light.tan_y))},
                        {"radiance", light.radiance},
                        {"solid_angle_sr", light.solid_angle_sr},
                        {"found", i >= lights.given}});
    }
    return list;
}

}  // namespace aureole::app
