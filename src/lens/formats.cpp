#include "aureole/lens/formats.h"

#include "lens/format_text.h"

namespace aureole::lens {

Prescription parse_prescription(std::string_view bytes, const std::string& file) {
    const std::size_t dot = file.find_last_of("./\\");
    const std::string extension =
        dot != std::string::npos && file[dot] == '.' ? upper_case(file.substr(dot)) : "";
    if (extension == ".TOML") return parse_toml(bytes, file);
    if (extension == ".ZMX") return parse_zmx(bytes, file);
    if (extension == ".DAT") return parse_pbrt(bytes, file);
    if (extension == ".SEQ") return parse_code_v(bytes, file);
    Place{file}.fail("extension", extension.empty() ? "none" : file.substr(dot),
                     "must be .toml (our own), .zmx (Zemax), .dat (pbrt) or .seq (CODE V)");
}

}  // namespace aureole::lens
