// Names of channels: internal to the module.
#pragma once

#include <string>
#include <vector>

namespace aureole::io {

// "glare.R" -> "R".
std::string base_of(const std::string& name);

// Whether find_color_channels() recognises colour by its name, instead of falling back on some
// other channel.
bool has_named_color(const std::vector<std::string>& names);

}  // namespace aureole::io
