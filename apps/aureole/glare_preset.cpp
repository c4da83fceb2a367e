#include "glare_preset.h"

namespace aureole::app {
namespace {

struct PresetValue {
    const char* option;
    const char* value;
};

// Sikachev, Tisevich & Ignatenko 2008: sections 4 (clusters), 3.2 (order, antialiasing), 3.3 (tone
// curve).
constexpr PresetValue kSikachev[] = {
    {"--passes", "both"}, {"--method", "sprites"}, {"--cluster-error", "0.001"},  // arms end unseen
    {"--threshold", "1"}, {"--tone-map", "xyz"},   {"--antialias", "edges"}};
constexpr PresetValue kSikachevBloom = {"--resolution", "half"};
// Its camera has a diaphragm and no ghosts.
constexpr PresetValue kSikachevCamera[] = {{"--blades", "6"}, {"--ghosts", "none"}};

}  // namespace

void apply_preset(const std::string& preset, const std::string& observer, CLI::App& command) {
    if (preset != "sikachev") return;
    const auto apply = [&](const PresetValue& setting) {
        CLI::Option* const option = command.get_option(setting.option);
        if (option->count() == 0) option->default_val(setting.value);
    };
    for (const PresetValue& setting : kSikachev) apply(setting);
    const auto passes = command.get_option("--passes")->as<std::string>();
    if (passes == "both" || passes == "bloom") apply(kSikachevBloom);
    if (observer != "camera") return;
    for (const PresetValue& setting : kSikachevCamera) apply(setting);
}

}  // namespace aureole::app
