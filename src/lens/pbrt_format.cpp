// Lens files of pbrt's realistic camera (formats.h).
#include <utility>

#include "aureole/lens/formats.h"
#include "lens/format_encoding.h"
#include "lens/format_text.h"

namespace aureole::lens {

Prescription parse_pbrt(std::string_view bytes, const std::string& file) {
    require_size(bytes, file);
    const std::string utf8 = utf8_text(bytes, file);
    std::string_view text = utf8;
    Prescription lens;
    Place place{file};
    while (!text.empty()) {
        std::string_view line = take_line(text);
        ++place.line;
        const std::size_t hash = line.find('#');
        if (hash != std::string_view::npos) {
            const std::string_view comment = trimmed(line.substr(hash + 1));
            // The first comment is the title by custom.
            if (lens.name.empty() && lens.surfaces.empty()) lens.name = comment;
            line = line.substr(0, hash);
        }
        const auto words = words_in(line);
        if (words.empty()) continue;
        place.surface = lens.surfaces.size() + 1;
        if (words.size() == 1 && lens.surfaces.empty() && lens.focal_length_mm == 0) {
            lens.focal_length_mm = finite_number(words[0], "focal length", place);
            continue;
        }
        if (words.size() != 4) {
            place.fail("row", line, "must be radius, thickness, index, aperture diameter");
        }
        Surface s;
        s.radius_mm = finite_number(words[0], "radius", place);
        s.thickness_mm = finite_number(words[1], "thickness", place);
        s.index = finite_number(words[2], "index", place);
        s.semi_aperture_mm = finite_number(words[3], "aperture diameter", place) / 2;
        const bool air_before = lens.surfaces.empty() || lens.surfaces.back().index == 1;
        if (s.radius_mm == 0 && air_before && (s.index == 0 || s.index == 1)) {
            s.stop = true;
            s.index = 1;
        }
        lens.surfaces.push_back(std::move(s));
    }
    return checked(std::move(lens), file);
}

}  // namespace aureole::lens
