// Lens files of Zemax OpticStudio (formats.h): header lines, then one block per surface, "SURF n"
// and lines beneath it. Surface 0 is the object, the last one the image.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "aureole/lens/formats.h"
#include "lens/format_encoding.h"
#include "lens/format_text.h"
#include "lens/imported_table.h"

namespace aureole::lens {
namespace {

constexpr int kMaxParameter = 255;
// What Zemax writes into the fields of the model glass when a catalogue glass is meant.
constexpr double kPlaceholderIndex = 1.5;
constexpr double kPlaceholderAbbe = 40;

using Words = std::vector<std::string_view>;

// One block as the file has it, in its units.
struct Block {
    Surface surface;
    std::optional<double> curvature;
    std::optional<double> gap;  // infinite: HUGE_VAL
    bool even_asphere = false;
    std::vector<double> even_terms;  // of r^2, r^4, ...: PARM 1, 2, ...
    double clear_semi_aperture = 0;  // CLAP, which overrides DIAM; 0: none
    std::size_t line = 0;            // of its SURF
};

class ZmxReader {
  public:
    explicit ZmxReader(const std::string& file) : place_{file} {}

    void read(std::string_view text) {
        while (!text.empty()) {
            const std::string_view line = take_line(text);
            ++place_.line;
            const Words words = words_in(line);
            if (!words.empty()) read_line(words, line);
        }
    }

    Prescription result() && {
        place_.line = 0;
        place_.surface = 0;
        if (blocks_.size() < 3) {
            place_.fail("number of SURF blocks", fmt::format("{}", blocks_.size()),
                        "must be at least 3: object, lens, image");
        }
        const Block& object = blocks_.front();
        if (object.surface.index != 1) {
            Place{place_.file, object.line}.fail("the object lies in glass: it must be in air");
        }
        if (object.gap && std::isfinite(*object.gap)) {
            warn(fmt::format("the object is at a distance of {:g}: focused at infinity instead",
                             *object.gap));
        }
        if (configurations_ > 1) {
            warn(fmt::format("{} configurations: the one on top is read", configurations_));
        }
        for (std::size_t i = 1; i + 1 < blocks_.size(); ++i) {
            table_.lens.surfaces.push_back(scaled(blocks_[i], i));
        }
        if (field_is_angle_) {
            table_.half_field_deg = largest_field_;
            table_.lens.field_deg = 2 * largest_field_;
        }
        table_.entrance_pupil_mm *= mm_per_unit_;
        return finished(std::move(table_), place_.file);
    }

  private:
    void warn(std::string text) { table_.lens.warnings.push_back(std::move(text)); }

    // The number in a place of the line, which must be there.
    double number(const Words& words, std::size_t at) const {
        if (at >= words.size()) {
            place_.fail(fmt::format("{}: value {} is missing", words[0], at));
        }
        return finite_number(words[at], words[0], place_);
    }

    void read_line(const Words& words, std::string_view line) {
        const std::string key = upper_case(words[0]);
        if (key == "SURF") {
            const double n = number(words, 1);
            place_.surface = 0;
            if (n != static_cast<double>(blocks_.size())) {
                place_.fail("SURF", words[1],
                            fmt::format("must be {}, one after the other", blocks_.size()));
            }
            place_.surface = blocks_.size();
            blocks_.emplace_back().line = place_.line;
        } else if (blocks_.empty()) {
            read_header(key, words, line);
        } else if (key == "MNUM") {
            configurations_ = number(words, 1);
        } else {
            read_surface(key, words, blocks_.back());
        }
    }

    void read_header(const std::string& key, const Words& words, std::string_view line) {
        if (key == "MODE" && words.size() > 1 && upper_case(words[1]) != "SEQ") {
            place_.fail("MODE", words[1], "must be SEQ, sequential");
        } else if (key == "NAME") {
            table_.lens.name = trimmed(line.substr(line.find(words[0]) + 4));
        } else if (key == "UNIT") {
            read_unit(words);
        } else if (key == "ENPD") {
            table_.entrance_pupil_mm = number(words, 1);
            require_positive(table_.entrance_pupil_mm, words);
        } else if (key == "FNUM") {
            table_.lens.f_number = number(words, 1);
            require_positive(table_.lens.f_number, words);
        } else if (key == "FTYP") {
            field_is_angle_ = number(words, 1) == 0;
        } else if (key == "XFLN" || key == "YFLN") {
            for (std::size_t i = 1; i < words.size(); ++i) {
                largest_field_ = std::max(largest_field_, std::abs(number(words, i)));
            }
        }
    }

    void require_positive(double value, const Words& words) const {
        if (!(value > 0)) place_.fail(words[0], words[1], "must be positive");
    }

    void read_unit(const Words& words) {
        const std::string unit = words.size() > 1 ? upper_case(words[1]) : "";
        constexpr std::pair<const char*, double> kUnits[] = {
            {"MM", 1}, {"CM", 10}, {"IN", 25.4}, {"METER", 1000}};
        const auto known = std::find_if(std::begin(kUnits), std::end(kUnits),
                                        [&](const auto& u) { return unit == u.first; });
        if (known == std::end(kUnits)) place_.fail("UNIT", unit, "must be MM, CM, IN or METER");
        mm_per_unit_ = known->second;
    }

    void read_surface(const std::string& key, const Words& words, Block& block) {
        if (key == "TYPE") {
            const std::string type = words.size() > 1 ? upper_case(words[1]) : "";
            block.even_asphere = type == "EVENASPH";
            if (type != "STANDARD" && !block.even_asphere) {
                place_.fail("TYPE", type, "must be STANDARD or EVENASPH");
            }
        } else if (key == "CURV") {
            block.curvature = number(words, 1);
        } else if (key == "CONI") {
            block.surface.conic = number(words, 1);
        } else if (key == "PARM") {
            read_parameter(words, block);
        } else if (key == "DISZ") {
            const bool infinite = words.size() > 1 && upper_case(words[1]) == "INFINITY";
            block.gap = infinite ? HUGE_VAL : number(words, 1);
        } else if (key == "GLAS") {
            read_glass(words, block.surface);
        } else if (key == "DIAM") {
            block.surface.semi_aperture_mm = number(words, 1);
        } else if (key == "CLAP") {
            block.clear_semi_aperture = number(words, 2);
        } else if (key == "STOP") {
            block.surface.stop = true;
        }
    }

    void read_parameter(const Words& words, Block& block) const {
        const double which = number(words, 1);
        const double value = number(words, 2);
        if (value == 0) return;
        if (!(which >= 1 && which <= kMaxParameter) || which != std::floor(which)) {
            place_.fail("PARM", words[1], fmt::format("must be 1 to {}", kMaxParameter));
        }
        const auto term = static_cast<std::size_t>(which) - 1;
        block.even_terms.resize(std::max(block.even_terms.size(), term + 1));
        block.even_terms[term] = value;
    }

    void read_glass(const Words& words, Surface& surface) {
        const std::string_view name = words.size() > 1 ? words[1] : "";
        if (upper_case(name) == "MIRROR") {
            place_.fail("GLAS", name, "must be glass: mirrors are not supported");
        }
        // GLAS name mode pickup index abbe ...: mode 1 is a model glass by index and Abbe number.
        const double mode = words.size() > 2 ? number(words, 2) : 0;
        const bool stated = words.size() > 4;
        const double index = stated ? number(words, 4) : 0;
        const double abbe = stated && words.size() > 5 ? number(words, 5) : 0;
        if (mode == 1) {
            if (!stated) place_.fail("GLAS", name, "must have an index, being a model glass");
            surface.index = index;
            surface.abbe = abbe;
            return;
        }
        const bool placeholder =
            index < 1 || (index == kPlaceholderIndex && abbe == kPlaceholderAbbe);
        if (!find_program_glass(name) && !placeholder) {
            surface.index = index;
            surface.abbe = abbe;
            warn(
                fmt::format("surface {}: glass {} is not in the catalogue: index {} and Abbe "
                            "number {} of the file are used",
                            place_.surface, excerpt(name), index, abbe));
            return;
        }
        set_glass(surface, name, place_);
    }

    Surface scaled(const Block& block, std::size_t number_in_file) const {
        const Place place{place_.file, block.line, number_in_file};
        if (!block.gap) place.fail("DISZ is missing: must be the distance to the next surface");
        if (!std::isfinite(*block.gap)) {
            place.fail("DISZ", "INFINITY", "must be finite behind the object");
        }
        if (!block.curvature) place.fail("CURV is missing: must be the curvature");
        double curvature = *block.curvature;
        Surface s = block.surface;
        if (block.even_asphere && !block.even_terms.empty()) {
            s.asphere.assign(block.even_terms.begin() + 1, block.even_terms.end());
            // a r^2 is the paraboloid of curvature 2 a; on top of another curvature it is neither
            // that nor any conic.
            const double square = block.even_terms.front();
            if (square != 0 && curvature != 0) {
                place.fail("PARM 1", fmt::format("{:g}", square),
                           "must be 0 where CURV is not: a term of r^2 beside a curvature is not "
                           "supported");
            }
            if (square != 0) {
                curvature = 2 * square;
                s.conic = -1;
            }
        }
        s.radius_mm = curvature == 0 ? 0 : 1 / curvature;
        s.thickness_mm = *block.gap;
        if (block.clear_semi_aperture > 0) s.semi_aperture_mm = block.clear_semi_aperture;
        scale(s, mm_per_unit_);
        return s;
    }

    Place place_;
    ImportedTable table_;
    std::vector<Block> blocks_;
    double mm_per_unit_ = 1;
    double configurations_ = 1;
    bool field_is_angle_ = true;
    double largest_field_ = 0;
};

}  // namespace

Prescription parse_zmx(std::string_view bytes, const std::string& file) {
    require_size(bytes, file);
    ZmxReader reader(file);
    reader.read(utf8_text(bytes, file));
    return std::move(reader).result();
}

}  // namespace aureole::lens
