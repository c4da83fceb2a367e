// Presets of `aureole glare` that are nothing but values of its options.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace aureole::app {

// After parsing: gives the options of `command` that were not given the values that the preset has
// for this observer (docs/streak_pipeline.md). They do not count as given. Other presets than
// sikachev have none.
void apply_preset(const std::string& preset, const std::string& observer, CLI::App& command);

}  // namespace aureole::app
