// The commands below `aureole lens`, and what they share.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "aureole/lens/lens.h"
#include "commands.h"

namespace aureole::app {

Run add_lens_list_command(CLI::App& lens);
Run add_lens_show_command(CLI::App& lens);
Run add_lens_draw_command(CLI::App& lens);
Run add_lens_check_command(CLI::App& lens);
Run add_lens_convert_command(CLI::App& lens);

// --angles 0,10,20: degrees from the axis.
CLI::Option* add_angles(CLI::App& command, std::vector<double>& angles_deg, double least_deg,
                        const std::string& description);

// Half of the stated field; if none is stated, of what a picture of 36 mm x 24 mm takes of the
// image, corner to corner. At most 85.
double half_field_deg(const lens::Lens& lens);

// Name of the lens, and of its position if it is a zoom, for people.
std::string title_of(const lens::Prescription& table, const std::string& position);
// Name of the position in force: as asked for, else the first; empty for a prime.
std::string position_in_force(const lens::Prescription& table, const std::string& asked);

}  // namespace aureole::app
