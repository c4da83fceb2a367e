// Lens files of CODE V (formats.h): a sequence of commands. SO, S ..., SI start the object, each
// surface and the image with radius or curvature, thickness and glass; what follows is about the
// surface before it, or about the one it names ("THI S3 2.5").
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "aureole/lens/formats.h"
#include "lens/format_encoding.h"
#include "lens/format_text.h"
#include "lens/imported_table.h"

namespace aureole::lens {
namespace {

using Words = std::vector<std::string_view>;

template <std::size_t N>
bool is_one_of(std::string_view word, const std::array<std::string_view, N>& list) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

// Commands that change the geometry in ways a table of rows cannot hold.
constexpr std::array<std::string_view, 27> kRefused = {
    "AAS", "ADE", "BDE", "BEN", "CDE", "CUX", "CYL", "DAR", "DEL",
    "DIF", "GRT", "HOE", "INS", "NSS", "RDX", "RET", "REV", "SCA",
    "SPL", "SPS", "TOR", "UMD", "XDE", "XTO", "YDE", "YTO", "ZDE"};
// Commands about wavelengths, fields, variables and names, which say nothing about the glass.
constexpr std::array<std::string_view, 39> kSilent = {
    "ASP", "CCY", "CMP", "CON", "CUF", "DER", "DOR", "END", "FLC", "GLC", "GO",  "INI", "KC",
    "LEN", "NAM", "PIM", "REF", "SLB", "SPH", "TEM", "THC", "UID", "VLX", "VLY", "VUX", "VUY",
    "WL",  "WTF", "WTW", "XAN", "XIM", "XOB", "XRI", "YIM", "YOB", "YRI", "AC",  "BC",  "PRE"};
constexpr std::size_t kMaxIgnored = 20;
constexpr std::string_view kAsphereLetters = "ABCDEFG";  // r^4 ... r^16
constexpr std::array<std::string_view, 2> kHigherTerms = {"H", "J"};

struct Command {
    Words words;
    std::size_t line = 0;
};

// The text without comments, cut at ends of lines and at semicolons, lines that end in & joined.
std::vector<Command> commands_in(std::string_view text) {
    std::vector<Command> commands;
    Command command{{}, 1};
    const auto finish = [&](std::size_t next_line) {
        if (!command.words.empty()) commands.push_back(std::move(command));
        command = {{}, next_line};
    };
    for (std::size_t line_number = 1; !text.empty(); ++line_number) {
        const std::string_view line = take_line(text);
        if (command.words.empty()) command.line = line_number;
        bool continued = false;
        std::size_t start = 0;
        const auto take = [&](std::size_t end) {
            const Words words = words_in(line.substr(start, end - start));
            command.words.insert(command.words.end(), words.begin(), words.end());
            start = end + 1;
        };
        char quote = 0;
        for (std::size_t i = 0; i <= line.size(); ++i) {
            const char c = i < line.size() ? line[i] : '!';
            if (quote != 0 && i < line.size()) {
                if (c == quote) quote = 0;
            } else if (c == '"' || c == '\'') {
                quote = c;
            } else if (c == ';') {
                take(i);
                finish(line_number);
            } else if (c == '&') {
                take(i);
                continued = true;
            } else if (c == '!') {
                if (start < i) take(i);
                break;
            }
        }
        if (!continued) finish(line_number + 1);
    }
    finish(0);
    return commands;
}

class CodeVReader {
  public:
    explicit CodeVReader(const std::string& file) : place_{file} {}

    void read(std::string_view text) {
        bool private_glasses = false;
        for (const Command& command : commands_in(text)) {
            place_.line = command.line;
            const std::string key = upper_case(command.words[0]);
            if (key == "PRV") private_glasses = true;
            if (!private_glasses) read_command(key, command.words);
            if (key == "END") private_glasses = false;
        }
    }

    Prescription result() && {
        if (!ignored_.empty()) warn(fmt::format("ignored: {}", fmt::join(ignored_, ", ")));
        if (table_.half_field_deg > 0) table_.lens.field_deg = 2 * table_.half_field_deg;
        table_.entrance_pupil_mm *= mm_per_unit_;
        for (Surface& surface : table_.lens.surfaces) scale(surface, mm_per_unit_);
        return finished(std::move(table_), place_.file);
    }

  private:
    std::vector<Surface>& rows() { return table_.lens.surfaces; }
    void warn(std::string text) { table_.lens.warnings.push_back(std::move(text)); }

    double number(const Words& words, std::size_t at) const {
        if (at >= words.size()) place_.fail(fmt::format("{}: a value is missing", words[0]));
        return finite_number(words[at], words[0], place_);
    }

    void read_command(const std::string& key, const Words& words) {
        place_.surface = 0;
        if (key == "SO") {
            in_object_ = true;
            read_object(words);
        } else if (key == "S") {
            in_object_ = false;
            read_row(words);
        } else if (key == "SI") {
            in_image_ = true;
        } else if (!read_header(key, words)) {
            read_surface(key, words);
        }
    }

    void read_object(const Words& words) {
        // Files write infinity as 1e10 to 1e14.
        const double distance = words.size() > 2 ? number(words, 2) : HUGE_VAL;
        if (distance < 1e9) {
            warn(fmt::format("the object is at a distance of {:g}: focused at infinity instead",
                             distance));
        }
    }

    void read_row(const Words& words) {
        if (in_image_) place_.fail("a surface follows the image, SI");
        rows().emplace_back();
        place_.surface = rows().size();
        Surface& row = rows().back();
        set_radius(row, number(words, 1), radii_);
        row.thickness_mm = number(words, 2);
        if (words.size() > 3) read_glass(row, words, 3);
    }

    static void set_radius(Surface& row, double value, bool is_radius) {
        row.radius_mm = is_radius || value == 0 ? value : 1 / value;
    }

    bool read_header(const std::string& key, const Words& words) {
        if (key == "RDM") {
            const std::string mode = words.size() > 1 ? upper_case(words[1]) : "Y";
            if (mode[0] != 'Y' && mode[0] != 'N') place_.fail("RDM", mode, "must be Y or N");
            radii_ = mode[0] == 'Y';
        } else if (key == "TIT" || key == "TITLE") {
            if (words.size() > 1) table_.lens.name = words[1];
        } else if (key == "DIM") {
            const std::string unit = words.size() > 1 ? upper_case(words[1]) : "";
            if (unit != "M" && unit != "C" && unit != "I") {
                place_.fail("DIM", unit, "must be M (mm), C (cm) or I (inches)");
            }
            mm_per_unit_ = unit == "M" ? 1 : unit == "C" ? 10 : 25.4;
        } else if (key == "EPD" || key == "FNO") {
            const double value = number(words, 1);
            if (!(value > 0)) place_.fail(key, words[1], "must be positive");
            (key == "EPD" ? table_.entrance_pupil_mm : table_.lens.f_number) = value;
        } else if (key == "YAN" || key == "XAN") {
            for (std::size_t i = 1; i < words.size(); ++i) {
                table_.half_field_deg = std::max(table_.half_field_deg, std::abs(number(words, i)));
            }
        } else {
            return is_one_of(key, kSilent);
        }
        return true;
    }

    // What is about one surface: the one that is named, else the last one.
    void read_surface(const std::string& key, const Words& words) {
        std::size_t at = 1;
        Surface* row = rows().empty() || in_image_ || in_object_ ? nullptr : &rows().back();
        place_.surface = row ? rows().size() : 0;
        if (words.size() > 1 && words[1].size() > 1 && upper_case(words[1])[0] == 'S') {
            const std::string name = upper_case(words[1].substr(1));
            const double n = name == "O" || name == "I" ? 0 : finite_number(name, key, place_);
            if (!(n >= 0 && n <= static_cast<double>(rows().size())) || n != std::floor(n)) {
                place_.fail(fmt::format("{} of surface", key), words[1],
                            fmt::format("must be SO, S1 to S{} or SI", rows().size()));
            }
            place_.surface = static_cast<std::size_t>(n);
            row = n == 0 ? nullptr : &rows()[place_.surface - 1];
            at = 2;
        }
        if (is_one_of(key, kRefused)) {
            const std::optional<double> value =
                at < words.size() ? number_in(words[at]) : std::nullopt;
            if (value && *value == 0) return;  // a decentre or tilt by nothing
            place_.fail("command", key,
                        "not supported: surfaces must be centred, rotational and sequential");
        }
        if (!row || !read_value(*row, key, words, at)) ignore(key, row);
    }

    bool read_value(Surface& row, const std::string& key, const Words& words, std::size_t at) {
        if (key == "STO") {
            row.stop = true;
        } else if (key == "RDY" || key == "CUY") {
            set_radius(row, number(words, at), key == "RDY");
        } else if (key == "THI") {
            // A solve ("THI S3 OAL ...") leaves the value that the row has.
            if (at < words.size() && !number_in(words[at])) return false;
            row.thickness_mm = number(words, at);
        } else if (key == "GLA" || key == "GL1") {
            if (at >= words.size()) place_.fail("GLA: a glass is missing");
            read_glass(row, words, at);
        } else if (key == "K") {
            row.conic = number(words, at);
        } else if (key.size() == 1 && kAsphereLetters.find(key) != std::string_view::npos) {
            const std::size_t term = kAsphereLetters.find(key);
            const double value = number(words, at);
            if (value == 0) return true;
            row.asphere.resize(std::max(row.asphere.size(), term + 1));
            row.asphere[term] = value;
        } else if (is_one_of(key, kHigherTerms)) {
            if (number(words, at) != 0) {
                place_.fail(key, words[at], "must be 0: terms end at G, of r^16");
            }
        } else if (key == "CIR") {
            return read_aperture(row, words, at);
        } else {
            return false;
        }
        return true;
    }

    // CIR [EDG] radius. The clear aperture counts before the edge of the glass.
    bool read_aperture(Surface& row, const Words& words, std::size_t at) {
        std::string kind;
        if (at < words.size() && !number_in(words[at])) kind = upper_case(words[at++]);
        if (kind != "" && kind != "CLR" && kind != "EDG") return false;
        const double radius = number(words, at);
        if (!(radius > 0)) place_.fail("CIR", words[at], "must be positive, a radius");
        if (kind != "EDG" || row.semi_aperture_mm == 0) row.semi_aperture_mm = radius;
        return true;
    }

    void read_glass(Surface& row, const Words& words, std::size_t at) {
        const std::string name = upper_case(words[at]);
        row.glass.clear();
        row.index = 1;
        row.abbe = 0;
        if (name == "AIR") return;
        if (name == "REFL" || name == "REFR") {
            if (name == "REFR") return;
            place_.fail("glass", name, "must be glass: mirrors are not supported");
        }
        const std::optional<double> code = number_in(name);
        const std::size_t dot = name.find('.');
        if (!code) {
            set_glass(row, words[at], place_);
        } else if (dot != std::string::npos && dot >= 3 && name.size() - dot > 2) {
            // "516.642" or "516800.641700": the decimals of n_d, and V_d with two digits before
            // its decimals.
            row.index = 1 + finite_number("0." + name.substr(0, dot), "glass", place_);
            row.abbe = finite_number(name.substr(dot + 1, 2) + "." + name.substr(dot + 3) + "0",
                                     "glass", place_);
        } else {
            row.index = *code;
            if (at + 1 < words.size()) row.abbe = number(words, at + 1);
        }
    }

    // Each command once, with the first place.
    void ignore(const std::string& key, const Surface* row) {
        if (is_one_of(key, kSilent) || !ignored_keys_.insert(key).second) return;
        if (ignored_.size() == kMaxIgnored) ignored_.push_back("more");
        if (ignored_.size() > kMaxIgnored) return;
        ignored_.push_back(fmt::format("{} ({}line {})", excerpt(key),
                                       row ? fmt::format("surface {}, ", place_.surface) : "",
                                       place_.line));
    }

    Place place_;
    ImportedTable table_;
    bool radii_ = false;  // of S rows; curvatures unless RDM says otherwise
    bool in_object_ = false;
    bool in_image_ = false;
    double mm_per_unit_ = 1;
    std::set<std::string> ignored_keys_;
    std::vector<std::string> ignored_;  // as told, at most kMaxIgnored and a "more"
};

}  // namespace

Prescription parse_code_v(std::string_view text, const std::string& file) {
    require_size(text, file);
    const std::string utf8 = utf8_text(text, file);
    CodeVReader reader(file);
    reader.read(utf8);
    return std::move(reader).result();
}

}  // namespace aureole::lens
