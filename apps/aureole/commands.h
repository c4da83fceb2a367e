// The commands of the program. Each adds itself to the command line and returns what to run when
// it was chosen; errors are exceptions.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace aureole::app {

using Run = std::function<void()>;

Run add_glare_command(CLI::App& app);
Run add_flare_command(CLI::App& app);
Run add_lens_command(CLI::App& app);
Run add_ibl_command(CLI::App& app);
Run add_meter_command(CLI::App& app);
Run add_psf_command(CLI::App& app);
Run add_scene_command(CLI::App& app);
Run add_gallery_command(CLI::App& app);
Run add_bake_command(CLI::App& app);

}  // namespace aureole::app
