// aureole lens check: what is doubtful about a lens table.
#include <fmt/core.h>

#include <memory>

#include "aureole/base/error.h"
#include "aureole/lens/check.h"
#include "lens_choice.h"
#include "lens_commands.h"
#include "session.h"

namespace aureole::app {
namespace {

struct LensCheck {
    void run();
    // The positions to look at: the one that was named, or all; a prime has one without a name.
    static std::vector<std::string> positions(const lens::Prescription& table,
                                              const std::string& asked);

    Session session;
    LensOptions lens;
    bool strict = false;
};

std::vector<std::string> LensCheck::positions(const lens::Prescription& table,
                                              const std::string& asked) {
    if (!asked.empty() || table.positions.empty()) return {asked};
    std::vector<std::string> names;
    for (const lens::Position& position : table.positions) names.push_back(position.name);
    return names;
}

void LensCheck::run() {
    session.start();
    const lens::Prescription table = lens.prescription(session);
    auto& json = session.json();
    json["lens"] = lens.name();
    json["name"] = table.name;
    json["findings"] = nlohmann::ordered_json::array();
    std::string text;
    std::size_t count = 0;
    for (const std::string& position : positions(table, lens.position())) {
        for (const lens::Finding& finding : lens::check(at_position(table, position))) {
            ++count;
            nlohmann::ordered_json one = {{"kind", lens::name_of(finding.kind)},
                                          {"surface", nullptr},
                                          {"text", finding.text}};
            if (finding.surface > 0) one["surface"] = finding.surface;
            if (!position.empty()) one["position"] = position;
            json["findings"].push_back(std::move(one));
            text += position.empty() ? "" : position + ": ";
            if (finding.surface > 0) text += fmt::format("surface {}: ", finding.surface);
            text += fmt::format("{} [{}]\n", finding.text, lens::name_of(finding.kind));
        }
    }
    session.finish(count == 0 ? table.name + ": nothing doubtful\n" : text);
    if (strict && count > 0) {
        throw Error(fmt::format("{}: {} doubtful (--strict)", lens.name(), count));
    }
}

}  // namespace

Run add_lens_check_command(CLI::App& lens) {
    CLI::App& command = *lens.add_subcommand(
        "check", "What is doubtful about a lens table; of a zoom at all its positions");
    const auto state = std::make_shared<LensCheck>();
    state->lens.add_lens_argument(command);
    command.add_flag("--strict", state->strict, "Exit code 1 if anything is");
    state->session.add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
