// aureole lens: the commands on lens tables.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "lens_commands.h"
#include "option_checks.h"

namespace aureole::app {

CLI::Option* add_angles(CLI::App& command, std::vector<double>& angles_deg, double least_deg,
                        const std::string& description) {
    constexpr double kMostDeg = 89;
    CLI::Option* const option = command.add_option("--angles", angles_deg, description);
    return number(option, least_deg, kMostDeg)
        ->type_name("DEG,...")
        ->delimiter(',')
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

double half_field_deg(const lens::Lens& lens) {
    constexpr double kHalfDiagonalMm = 21.633;
    constexpr double kMostDeg = 85;
    const double stated = lens.prescription().field_deg / 2;
    const double half =
        stated > 0 ? stated : deg_from_rad(std::atan(kHalfDiagonalMm / lens.efl_mm()));
    return std::min(half, kMostDeg);
}

std::string position_in_force(const lens::Prescription& table, const std::string& asked) {
    return asked.empty() && !table.positions.empty() ? table.positions.front().name : asked;
}

std::string title_of(const lens::Prescription& table, const std::string& position) {
    const std::string in_force = position_in_force(table, position);
    return in_force.empty() ? table.name : table.name + ", " + in_force;
}

Run add_lens_command(CLI::App& app) {
    CLI::App& command =
        *app.add_subcommand("lens", "Lens tables: list, show, draw, check, convert");
    command.set_version_flag("--version", "aureole " AUREOLE_VERSION);
    command.require_subcommand(0, 1);
    const std::vector<Run> runs = {add_lens_list_command(command), add_lens_show_command(command),
                                   add_lens_draw_command(command), add_lens_check_command(command),
                                   add_lens_convert_command(command)};
    return [&command, runs] {
        const auto all = command.get_subcommands({});
        for (std::size_t i = 0; i < runs.size(); ++i) {
            if (all[i]->parsed()) return runs[i]();
        }
        std::string names;
        for (const CLI::App* one : all) names += (names.empty() ? "" : ", ") + one->get_name();
        throw InvalidArgument("no command given after lens: must be one of " + names);
    };
}

}  // namespace aureole::app
