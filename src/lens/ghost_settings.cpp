#include "aureole/lens/ghost_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "aureole/base/error.h"
#include "lens/toml_text.h"

namespace aureole::lens {
namespace {

// Surfaces are counted from 1; the one nearer to the scene comes first.
std::string name_of(const Bounces& bounces) {
    return fmt::format("[{}, {}]", bounces.near + 1, bounces.far + 1);
}

const char* name_of(GhostReport::Drawn drawn) {
    switch (drawn) {
        case GhostReport::Drawn::kMatrix:
            return "drawn by matrix";
        case GhostReport::Drawn::kTraced:
            return "drawn by rays";
        case GhostReport::Drawn::kDropped:
            return "dropped as too weak";
        case GhostReport::Drawn::kDisabled:
            return "disabled";
        case GhostReport::Drawn::kBlocked:
            return "no light passes";
    }
    return "";
}

// TOML wants a point in a float; {} prints the shortest text that reads back as the same float.
std::string text_of(float value) {
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
}

std::string quoted(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            result += fmt::format("\\u{:04x}", static_cast<int>(c));
        } else {
            result += c;
        }
    }
    return result + "\"";
}

std::string comment_of(const GhostReport& ghost, double total_energy) {
    if (!(ghost.energy > 0)) return fmt::format("# {}\n", name_of(ghost.drawn));
    return fmt::format("# {:.3g} % of the energy, at ({:.1f}, {:.1f}) px, radius {:.1f} px, {}\n",
                       100 * ghost.energy / total_energy, ghost.center_x, ghost.center_y,
                       ghost.radius_px, name_of(ghost.drawn));
}

// Reads the values of one [[ghost]], and says where a wrong one is.
class Entry {
  public:
    Entry(const std::string& file, std::size_t number, const toml::table& table)
        : file_(file), number_(number), table_(table) {}

    [[noreturn]] void fail(const toml::node& node, const std::string& what) const {
        throw FileError(
            file_, fmt::format("line {}: ghost {}: {}", node.source().begin.line, number_, what));
    }

    [[noreturn]] void fail(const char* key, const toml::node& node,
                           const std::string& allowed) const {
        // TOML's own text of the value; a table or an array may span lines.
        std::ostringstream text;
        node.visit([&](const auto& value) { text << value; });
        fail(node, fmt::format("{} = {}: {}", key, text.str(), allowed));
    }

    void check_keys() const {
        for (const auto& [key, node] : table_) {
            const std::string_view name = key.str();
            if (name != "surfaces" && name != "enabled" && name != "gain" && name != "tint") {
                fail(node,
                     fmt::format("unknown key {}: must be surfaces, enabled, gain or tint", name));
            }
        }
    }

    Bounces surfaces() const {
        constexpr const char* kAllowed = "must be two different surface numbers, as in [3, 6]";
        const toml::node* node = table_.get("surfaces");
        if (node == nullptr) fail(table_, "has no surfaces, as in surfaces = [3, 6]");
        const toml::array* pair = node->as_array();
        if (pair == nullptr || pair->size() != 2) fail("surfaces", *node, kAllowed);
        const auto a = (*pair)[0].value_exact<std::int64_t>();
        const auto b = (*pair)[1].value_exact<std::int64_t>();
        constexpr std::int64_t kMost = kMaxSurfaces;
        if (!a || !b || *a == *b || std::min(*a, *b) < 1 || std::max(*a, *b) > kMost) {
            fail("surfaces", *node, kAllowed);
        }
        return {static_cast<int>(std::max(*a, *b)) - 1, static_cast<int>(std::min(*a, *b)) - 1};
    }

    bool enabled() const {
        const toml::node* node = table_.get("enabled");
        if (node == nullptr) return true;
        if (!node->is_boolean()) fail("enabled", *node, "must be true or false");
        return *node->value_exact<bool>();
    }

    float gain() const {
        const toml::node* node = table_.get("gain");
        if (node == nullptr) return 1;
        const auto value = weight(*node);
        if (!value) fail("gain", *node, "must be a number, at least 0");
        return *value;
    }

    std::array<float, 3> tint() const {
        constexpr const char* kAllowed = "must be three numbers, each at least 0";
        const toml::node* node = table_.get("tint");
        if (node == nullptr) return {1, 1, 1};
        const toml::array* rgb = node->as_array();
        if (rgb == nullptr || rgb->size() != 3) fail("tint", *node, kAllowed);
        std::array<float, 3> tint = {};
        for (std::size_t c = 0; c < 3; ++c) {
            const auto value = weight((*rgb)[c]);
            if (!value) fail("tint", *node, kAllowed);
            tint[c] = *value;
        }
        return tint;
    }

  private:
    static std::optional<float> weight(const toml::node& node) {
        if (!node.is_number()) return std::nullopt;
        const auto value = static_cast<float>(*node.value<double>());
        return value >= 0 && std::isfinite(value) ? std::optional(value) : std::nullopt;
    }

    const std::string& file_;
    std::size_t number_;  // of the ghost in the file, from 1
    const toml::table& table_;
};

}  // namespace

std::string ghosts_to_toml(std::string_view lens, std::span<const Bounces> all,
                           std::span<const GhostSetting> settings, const FlareReport* report) {
    const auto report_of = [&](const Bounces& bounces) -> const GhostReport* {
        if (report == nullptr) return nullptr;
        const auto found =
            std::find_if(report->ghosts.begin(), report->ghosts.end(),
                         [&](const GhostReport& ghost) { return ghost.bounces == bounces; });
        return found == report->ghosts.end() ? nullptr : &*found;
    };
    const auto energy_of = [&](const Bounces& bounces) {
        const GhostReport* ghost = report_of(bounces);
        return ghost == nullptr ? 0.0 : ghost->energy;
    };
    std::vector<Bounces> order(all.begin(), all.end());
    std::stable_sort(order.begin(), order.end(), [&](const Bounces& a, const Bounces& b) {
        return energy_of(a) > energy_of(b);
    });
    double total_energy = 0;
    for (const Bounces& bounces : order) total_energy += energy_of(bounces);

    std::string text = fmt::format("lens = {}\n", quoted(lens));
    for (const Bounces& bounces : order) {
        const auto found =
            std::find_if(settings.begin(), settings.end(),
                         [&](const GhostSetting& s) { return s.bounces == bounces; });
        const GhostSetting setting = found == settings.end() ? GhostSetting{bounces} : *found;
        text += "\n[[ghost]]\n";
        if (const GhostReport* ghost = report_of(bounces)) text += comment_of(*ghost, total_energy);
        text += fmt::format("surfaces = {}\nenabled = {}\ngain = {}\ntint = [{}, {}, {}]\n",
                            name_of(bounces), setting.enabled, text_of(setting.gain),
                            text_of(setting.tint[0]), text_of(setting.tint[1]),
                            text_of(setting.tint[2]));
    }
    return text;
}

std::vector<GhostSetting> ghosts_from_toml(std::string_view text, const std::string& file,
                                           std::span<const Bounces> all) {
    const toml::table root = toml_table(text, file);
    for (const auto& [key, node] : root) {
        if (key.str() != "lens" && key.str() != "ghost") {
            throw FileError(file, fmt::format("line {}: unknown key {}: must be lens or [[ghost]]",
                                              node.source().begin.line, key.str()));
        }
    }
    const toml::node* list = root.get("ghost");
    if (list == nullptr) return {};
    if (!list->is_array_of_tables() && !(list->is_array() && list->as_array()->empty())) {
        throw FileError(file, fmt::format("line {}: ghosts must be tables headed [[ghost]]",
                                          list->source().begin.line));
    }
    std::vector<GhostSetting> settings;
    for (const toml::node& node : *list->as_array()) {
        const Entry entry(file, settings.size() + 1, *node.as_table());
        entry.check_keys();
        const GhostSetting setting = {entry.surfaces(), entry.enabled(), entry.gain(),
                                      entry.tint()};
        const Bounces& bounces = setting.bounces;
        if (std::find(all.begin(), all.end(), bounces) == all.end()) {
            entry.fail(node, fmt::format("surfaces = {}: the lens has no such ghost among the {} "
                                         "in force",
                                         name_of(bounces), all.size()));
        }
        for (const GhostSetting& earlier : settings) {
            if (earlier.bounces == bounces) {
                entry.fail(node, fmt::format("surfaces = {}: is there twice", name_of(bounces)));
            }
        }
        settings.push_back(setting);
    }
    return settings;
}

}  // namespace aureole::lens
