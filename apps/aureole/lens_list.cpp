// aureole lens list: the lenses that come with Aureole.
#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "aureole/lens/formats.h"
#include "aureole/lens/library.h"
#include "lens_commands.h"
#include "session.h"

namespace aureole::app {
namespace {

// "28" or "72.1-194" from the stated values of a prime, or of the positions of a zoom; "-": none.
std::string range(const lens::Prescription& table, double prime, double lens::Position::*value) {
    double low = prime;
    double high = prime;
    for (const lens::Position& position : table.positions) {
        const bool first = &position == table.positions.data();
        low = first ? position.*value : std::min(low, position.*value);
        high = first ? position.*value : std::max(high, position.*value);
    }
    if (high == 0) return "-";
    return low == high ? fmt::format("{:g}", low) : fmt::format("{:g}-{:g}", low, high);
}

nlohmann::ordered_json json_of(const std::string& id, const lens::Prescription& table) {
    nlohmann::ordered_json json = {{"id", id},
                                   {"name", table.name},
                                   {"focal_length_mm", table.focal_length_mm},
                                   {"f_number", nullptr},
                                   {"surfaces", table.surfaces.size()},
                                   {"patent", table.patent},
                                   {"positions", nlohmann::ordered_json::array()}};
    if (table.f_number > 0) json["f_number"] = table.f_number;
    for (const lens::Position& position : table.positions) {
        nlohmann::ordered_json one = {{"name", position.name},
                                      {"focal_length_mm", position.focal_length_mm},
                                      {"f_number", nullptr}};
        if (position.f_number > 0) one["f_number"] = position.f_number;
        json["positions"].push_back(std::move(one));
    }
    return json;
}

void run(Session& session) {
    session.start();
    auto& json = session.json();
    json["lenses"] = nlohmann::ordered_json::array();
    std::string text = fmt::format("{:<24}{:<44}{:<13}{:<9}{:>8}  {}\n", "id", "name", "focal, mm",
                                   "f/", "surfaces", "patent");
    for (const lens::ShippedLens& shipped : lens::shipped_lenses()) {
        const lens::Prescription table = lens::shipped_lens(shipped.id);
        text += fmt::format("{:<24}{:<44}{:<13}{:<9}{:>8}  {}\n", shipped.id, table.name,
                            range(table, table.focal_length_mm, &lens::Position::focal_length_mm),
                            range(table, table.f_number, &lens::Position::f_number),
                            table.surfaces.size(), table.patent);
        json["lenses"].push_back(json_of(std::string(shipped.id), table));
    }
    session.finish(text);
}

}  // namespace

Run add_lens_list_command(CLI::App& lens) {
    CLI::App& command = *lens.add_subcommand("list", "The lenses that come with Aureole");
    const auto session = std::make_shared<Session>();
    session->add_options(command);
    return [session] { run(*session); };
}

}  // namespace aureole::app
