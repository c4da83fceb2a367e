// Our own format, both ways (formats.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "aureole/lens/formats.h"
#include "aureole/lens/glass.h"
#include "lens/format_text.h"
#include "lens/toml_text.h"

namespace aureole::lens {
namespace {

// One table of the file, read key by key.
class TableReader {
  public:
    TableReader(const toml::table& table, const std::string& file, std::string where)
        : table_(table), file_(file), where_(std::move(where)) {}

    // Throws for any other key: a misspelt one would otherwise be a default, silently.
    void allow_only(std::initializer_list<std::string_view> keys) const {
        for (const auto& [key, node] : table_) {
            if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
            fail(node, fmt::format("unknown key \"{}\": must be one of {}", excerpt(key.str()),
                                   fmt::join(keys, ", ")));
        }
    }

    bool has(std::string_view key) const { return table_.contains(key); }

    double number(std::string_view key, double otherwise) const {
        const toml::node* node = table_.get(key);
        return node ? number(*node, key) : otherwise;
    }
    double required_number(std::string_view key) const {
        if (!has(key)) fail(table_, fmt::format("{} is missing: must be a number", key));
        return number(key, 0);
    }
    double number(const toml::node& node, std::string_view key) const {
        if (!node.is_number()) {
            fail(node, fmt::format("{} is {}: must be a number", key, type_of(node)));
        }
        const double value = *node.value<double>();
        if (!std::isfinite(value)) {
            fail(node, fmt::format("{} = {}: must be a finite number", key, value));
        }
        return value;
    }
    std::string text(std::string_view key) const {
        const toml::node* node = table_.get(key);
        if (!node) return "";
        if (!node->is_string()) {
            fail(*node, fmt::format("{} is {}: must be a string", key, type_of(*node)));
        }
        return node->ref<std::string>();
    }
    bool flag(std::string_view key) const {
        const toml::node* node = table_.get(key);
        if (!node) return false;
        if (!node->is_boolean()) {
            fail(*node, fmt::format("{} is {}: must be true or false", key, type_of(*node)));
        }
        return node->ref<bool>();
    }
    std::vector<double> numbers(std::string_view key) const {
        std::vector<double> values;
        const toml::node* node = table_.get(key);
        if (!node) return values;
        const toml::array* array = node->as_array();
        if (!array) {
            fail(*node, fmt::format("{} is {}: must be a list of numbers", key, type_of(*node)));
        }
        for (const toml::node& item : *array) values.push_back(number(item, key));
        return values;
    }
    // The tables of a list of them, which may be absent.
    template <class Function>
    void each(std::string_view key, const Function& use) const {
        const toml::node* node = table_.get(key);
        if (!node) return;
        const toml::array* array = node->as_array();
        const auto is_table = [](const toml::node& item) { return item.is_table(); };
        if (!array || !std::all_of(array->begin(), array->end(), is_table)) {
            fail(*node, fmt::format("{} is {}: must be a list of tables", key, type_of(*node)));
        }
        for (std::size_t i = 0; i < array->size(); ++i) {
            use(TableReader(*(*array)[i].as_table(), file_,
                            fmt::format("{}{} {}: ", where_, key, i + 1)));
        }
    }
    [[noreturn]] void fail(const toml::node& node, const std::string& reason) const {
        Place{file_, node.source().begin.line}.fail(where_ + reason);
    }
    [[noreturn]] void fail(std::string_view key, const std::string& reason) const {
        fail(*table_.get(key), fmt::format("{} = {}: {}", key, excerpt(text(key)), reason));
    }

  private:
    static const char* type_of(const toml::node& node) {
        switch (node.type()) {
            case toml::node_type::string:
                return "a string";
            case toml::node_type::integer:
            case toml::node_type::floating_point:
                return "a number";
            case toml::node_type::boolean:
                return "true or false";
            case toml::node_type::array:
                return "a list";
            case toml::node_type::table:
                return "a table";
            default:
                return "a date or time";
        }
    }

    const toml::table& table_;
    const std::string& file_;
    std::string where_;
};

Profile profile_of(const TableReader& row) {
    const std::string name = row.text("profile");
    if (!row.has("profile") || name == "rotational") return Profile::kRotational;
    if (name == "cylinder-x") return Profile::kCylinderX;
    if (name == "cylinder-y") return Profile::kCylinderY;
    row.fail("profile", "must be rotational, cylinder-x or cylinder-y");
}

Surface surface_of(const TableReader& row) {
    row.allow_only({"radius_mm", "thickness_mm", "index", "abbe", "glass", "semi_aperture_mm",
                    "stop", "profile", "conic", "asphere", "coating"});
    Surface s;
    s.radius_mm = row.number("radius_mm", 0);
    s.thickness_mm = row.required_number("thickness_mm");
    s.glass = row.text("glass");
    if (const Glass* glass = s.glass.empty() ? nullptr : find_glass(s.glass)) {
        s.index = glass->index_d();
        s.abbe = glass->abbe();
    } else if (!s.glass.empty()) {
        row.fail("glass", "must be a glass of the catalogue, or give index and abbe instead");
    }
    s.index = row.number("index", s.index);
    s.abbe = row.number("abbe", s.abbe);
    s.semi_aperture_mm = row.required_number("semi_aperture_mm");
    s.stop = row.flag("stop");
    s.profile = profile_of(row);
    s.conic = row.number("conic", 0);
    s.asphere = row.numbers("asphere");
    s.coating = row.text("coating");
    return s;
}

Position position_of(const TableReader& table) {
    table.allow_only({"name", "focal_length_mm", "f_number", "field_deg", "gaps"});
    Position position;
    position.name = table.text("name");
    position.focal_length_mm = table.required_number("focal_length_mm");
    position.f_number = table.number("f_number", 0);
    position.field_deg = table.number("field_deg", 0);
    table.each("gaps", [&](const TableReader& gap) {
        gap.allow_only({"surface", "thickness_mm"});
        const double surface = gap.required_number("surface");
        // The range of rows is for validate(); this one keeps the conversion defined.
        const bool whole = surface == std::floor(surface) && std::abs(surface) <= 1e6;
        position.gaps.push_back(
            {whole ? static_cast<int>(surface) : 0, gap.required_number("thickness_mm")});
    });
    return position;
}

std::string quoted(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (code < 0x20 || code == 0x7F) {
            out += fmt::format("\\u{:04X}", static_cast<unsigned>(code));
        } else {
            out += c;
        }
    }
    return out + '"';
}

// The shortest digits that give the same number back, always as a float of TOML.
std::string number_text(double value) {
    std::string text = fmt::format("{}", value);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

void put(std::string& out, const char* key, const std::string& value) {
    if (!value.empty()) out += fmt::format("{} = {}\n", key, quoted(value));
}
void put(std::string& out, const char* key, double value, double otherwise) {
    if (value != otherwise) out += fmt::format("{} = {}\n", key, number_text(value));
}

void put_surface(std::string& out, const Surface& s) {
    const Glass* glass = s.glass.empty() ? nullptr : find_glass(s.glass);
    out += "\n[[surface]]\n";
    put(out, "radius_mm", s.radius_mm, 0);
    out += fmt::format("thickness_mm = {}\n", number_text(s.thickness_mm));
    put(out, "glass", s.glass);
    put(out, "index", s.index, glass ? glass->index_d() : 1);
    put(out, "abbe", s.abbe, glass ? glass->abbe() : 0);
    out += fmt::format("semi_aperture_mm = {}\n", number_text(s.semi_aperture_mm));
    if (s.stop) out += "stop = true\n";
    if (s.profile == Profile::kCylinderX) out += "profile = \"cylinder-x\"\n";
    if (s.profile == Profile::kCylinderY) out += "profile = \"cylinder-y\"\n";
    put(out, "conic", s.conic, 0);
    if (!s.asphere.empty()) {
        out += "asphere = [";
        for (std::size_t i = 0; i < s.asphere.size(); ++i) {
            out += (i > 0 ? ", " : "") + number_text(s.asphere[i]);
        }
        out += "]\n";
    }
    put(out, "coating", s.coating);
}

}  // namespace

Prescription parse_toml(std::string_view text, const std::string& file) {
    require_size(text, file);
    const toml::table root = toml_table(text, file);
    const TableReader table(root, file, "");
    table.allow_only({"name", "patent", "source", "missing", "focal_length_mm", "f_number",
                      "field_deg", "surface", "position"});
    Prescription lens;
    lens.name = table.text("name");
    lens.patent = table.text("patent");
    lens.source = table.text("source");
    lens.missing = table.text("missing");
    lens.focal_length_mm = table.number("focal_length_mm", 0);
    lens.f_number = table.number("f_number", 0);
    lens.field_deg = table.number("field_deg", 0);
    table.each("surface",
               [&](const TableReader& row) { lens.surfaces.push_back(surface_of(row)); });
    table.each("position", [&](const TableReader& position) {
        lens.positions.push_back(position_of(position));
    });
    return checked(std::move(lens), file);
}

std::string to_toml(const Prescription& prescription) {
    std::string out;
    put(out, "name", prescription.name);
    put(out, "patent", prescription.patent);
    put(out, "source", prescription.source);
    put(out, "missing", prescription.missing);
    put(out, "focal_length_mm", prescription.focal_length_mm, 0);
    put(out, "f_number", prescription.f_number, 0);
    put(out, "field_deg", prescription.field_deg, 0);
    for (const Surface& surface : prescription.surfaces) put_surface(out, surface);
    for (const Position& position : prescription.positions) {
        out += "\n[[position]]\n";
        put(out, "name", position.name);
        out += fmt::format("focal_length_mm = {}\n", number_text(position.focal_length_mm));
        put(out, "f_number", position.f_number, 0);
        put(out, "field_deg", position.field_deg, 0);
        out += "gaps = [\n";
        for (const Position::Gap& gap : position.gaps) {
            out += fmt::format("    {{ surface = {}, thickness_mm = {} }},\n", gap.surface,
                               number_text(gap.thickness_mm));
        }
        out += "]\n";
    }
    return out;
}

}  // namespace aureole::lens
