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

// Unknown keys are errors.
Prescription parse_toml(std::string_view text, const std::string& file);
// Zemax .zmx, ASCII, UTF-8 or UTF-16 (by its byte order mark): SURF with TYPE STANDARD or EVENASPH,
// CURV, CONI, PARM 1 to 8 (a term of r^2 only where CURV is 0), DISZ, GLAS (catalogue name, or
// model glass with its index and Abbe number), DIAM and CLAP (semi-diameters), STOP; UNIT, NAME,
// ENPD, FNUM, field angles. Distances are scaled to mm. Object and image rows are dropped.
Prescription parse_zmx(std::string_view bytes, const std::string& file);
// pbrt-v3 and -v4 realistic camera .dat: rows of radius, thickness, index, aperture *diameter*, in
// mm; radius 0 with index 0 or 1 in air is the stop; the first comment is the name.
Prescription parse_pbrt(std::string_view bytes, const std::string& file);
// CODE V .seq: S rows (radius or curvature by RDM, thickness, glass name or six-digit code), RDY,
// CUY, THI, GLA, STO, CIR, K and A to G (of r^4 to r^16), of the last surface or of the one named;
// TITLE, DIM, EPD, FNO, field angles. Centred rotational surfaces only.
Prescription parse_code_v(std::string_view text, const std::string& file);
// For .zmx and .seq: a stop marked on a face of glass becomes a flat row of its own beside it; the
// f-number of an entrance pupil is taken as stated; semi-apertures that the file leaves to the
// program are estimated from the paraxial beam, as the warnings say, or refused without a pupil.

// By the file's extension: .toml, .zmx, .dat, .seq; throws FileError for any other.
Prescription parse_prescription(std::string_view bytes, const std::string& file);

// parse_toml(to_toml(p)) == p, with every number at full precision; warnings are left out.
std::string to_toml(const Prescription& prescription);

}  // namespace aureole::lens
