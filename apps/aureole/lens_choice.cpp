#include "lens_choice.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "aureole/io/text_file.h"
#include "aureole/lens/formats.h"
#include "aureole/lens/library.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

constexpr const char* kLensText =
    "A lens that comes with Aureole (aureole lens list) or a file (.toml, .zmx, .dat, .seq); "
    "of a zoom, :POSITION behind it";
constexpr const char* kLensType = "NAME|FILE[:POSITION]";

struct Named {
    std::string lens;
    std::string position;
    bool file = false;
};

bool is_lens_file(const std::string& name) {
    std::string extension = std::filesystem::path(name).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::array kExtensions = {".toml", ".zmx", ".dat", ".seq"};
    return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

// Ids of shipped lenses have neither dots nor slashes; whatever has is meant as a file.
bool is_path(const std::string& name) { return name.find_first_of("./") != std::string::npos; }

Named parse(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos || is_lens_file(text)) return {text, "", is_path(text)};
    const std::string lens = text.substr(0, colon);
    return {lens, text.substr(colon + 1), is_path(lens)};
}

}  // namespace

void LensOptions::add_options(CLI::App& command, const std::string& fallback) {
    name_ = fallback;
    CLI::Option* const option =
        command.add_option("--lens", name_, kLensText)->type_name(kLensType);
    if (fallback.empty()) {
        option->required();
    } else {
        option->capture_default_str();
    }
    add_settings(command);
}

void LensOptions::add_argument(CLI::App& command) {
    add_lens_argument(command);
    add_settings(command);
}

void LensOptions::add_lens_argument(CLI::App& command) {
    command.add_option("LENS", name_, kLensText)->required()->type_name(kLensType);
}

void LensOptions::add_settings(CLI::App& command) {
    positive_number(command.add_option("--f-number", settings_.f_number,
                                       "Of the iris (default: as stated, or what the printed "
                                       "stop gives)"))
        ->type_name("N");
    positive_number(command.add_option("--focus", settings_.focus_distance_m,
                                       "Distance from the sensor to what is in focus, in m "
                                       "(default: infinity)"))
        ->type_name("M");
    command
        .add_option("--coating", settings_.coating,
                    "Of faces between air and glass: none, mgf2[:NM], broadband[:NM], or "
                    "INDEX/NM,... from the air side")
        ->type_name("NAME")
        ->capture_default_str();
}

lens::Prescription LensOptions::prescription(Session& session) const {
    const Named named = parse(name_);
    if (!named.file) return lens::shipped_lens(named.lens);
    lens::Prescription table = lens::parse_prescription(io::read_text_file(named.lens), named.lens);
    for (const std::string& warning : table.warnings) session.note(named.lens + ": " + warning);
    return table;
}

std::string LensOptions::position() const { return parse(name_).position; }

lens::Lens LensOptions::lens(Session& session) const {
    const Named named = parse(name_);
    lens::LensSettings settings = settings_;
    settings.position = named.position;
    lens::Lens lens(prescription(session), settings);
    for (const std::string& warning : lens.warnings()) session.note(named.lens + ": " + warning);
    return lens;
}

nlohmann::ordered_json LensOptions::report(const lens::Lens& lens) const {
    const Named named = parse(name_);
    nlohmann::ordered_json json;
    json["lens"] = named.lens;
    json["position"] = named.position;
    json["f_number"] = lens.f_number();
    json["focus_distance_m"] = nullptr;
    if (settings_.focus_distance_m > 0) json["focus_distance_m"] = settings_.focus_distance_m;
    json["coating"] = settings_.coating;
    return json;
}

}  // namespace aureole::app
