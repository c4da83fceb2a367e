// Lens tables from text: our own TOML, and the files of other programs.
//
// Our format (UTF-8):
//     name = "Heliar"              patent, source, missing: strings, optional
//     focal_length_mm = 100.0      f_number, field_deg: optional
//     [[surface]]                  from the scene to the sensor
//     radius_mm = 30.81            0 or absent: flat
//     thickness_mm = 7.7           to the next row
//     index = 1.652                behind the surface; absent: 1, air
//     abbe = 58.57                 or glass = "N-BK7"; absent: no dispersion
//     semi_aperture_mm = 14.5
//     stop = true                  on exactly one row
//     profile = "cylinder-x"       or "cylinder-y"; absent: rotational
//     conic = -1.0                 asphere = [r^4, r^6, ...]; coating = "mgf2"
//     [[position]]                 of a zoom
//     name = "tele"                focal_length_mm, f_number, field_deg as above
//     gaps = [{ surface = 6, thickness_mm = 32.85 }]
#pragma once

#include <string>
#include <string_view>

#include "aureole/lens/prescription.h"

namespace aureole::lens {

// All parsers take the bytes of a file, and its name for messages only. They throw FileError with
// the file, the line or surface number, the value and what is allowed; results pass validate().
// What a parser ignores or mends is told in Prescription::warnings.

Prescription parse_toml(std::string_view text, const std::string& file);
// Zemax .zmx, ASCII or UTF-16 (either byte order mark): SURF TYPE STANDARD, EVENASPH, CURV, CONI,
// PARM, DISZ, GLAS (catalogue name, or model glass with its index and Abbe number), DIAM, STOP,
// UNIT. Distances are scaled to mm. Object and image rows are dropped.
Prescription parse_zmx(std::string_view bytes, const std::string& file);
// pbrt-v3 and -v4 realistic camera .dat: rows of radius, thickness, index, aperture *diameter*, in
// mm; radius 0 with index 0 or 1 is the stop.
Prescription parse_pbrt(std::string_view text, const std::string& file);
// CODE V .seq: RDY/RDM lens tables with S lines (radius or curvature, thickness, glass name or
// six-digit code), STO, CIR, K, ASP with A..G, DIM; sequential surfaces only.
Prescription parse_code_v(std::string_view text, const std::string& file);

// By the file's extension: .toml, .zmx, .dat, .seq; throws FileError for any other.
Prescription parse_prescription(std::string_view bytes, const std::string& file);

// parse_toml(to_toml(p)) == p, with every number at full precision; warnings are left out.
std::string to_toml(const Prescription& prescription);

}  // namespace aureole::lens
