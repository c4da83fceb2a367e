// A lens as its table: radii, gaps, glasses, clear apertures, as patents print them.
//
// Rows run from the scene to the sensor; the optical axis is z, light travels towards +z.
// radius_mm > 0: the centre of curvature lies towards the sensor. Everything is in millimetres.
// Parsing and writing: formats.h; what is doubtful about a table: check.h; made ready for light:
// lens.h; the lenses that come with Aureole: library.h.
#pragma once

#include <string>
#include <vector>

namespace aureole::lens {

// In which directions a surface is curved.
enum class Profile {
    kRotational,  // sphere, plane, conic, even asphere
    kCylinderX,   // curved in the x-z plane only: power across the width (anamorphic lenses)
    kCylinderY,   // curved in the y-z plane only
};

// One row. The sag of a rotational surface is (r^2 = x^2 + y^2, c = 1 / radius)
//     z(r) = c r^2 / (1 + sqrt(1 - (1 + conic) c^2 r^2)) + sum over i of asphere[i] r^(2 i + 4),
// the even asphere of all design programs; for cylinders r is the curved coordinate.
struct Surface {
    double radius_mm = 0;     // 0: flat
    double thickness_mm = 0;  // to the next row; of the last row: to the printed sensor, or 0
    double index = 1;         // n_d of the medium behind the row; 1: air
    double abbe = 0;          // V_d of that medium; 0: unknown, taken as without dispersion
    std::string glass;        // catalogue name (glass.h); its Sellmeier curve then replaces abbe
    double semi_aperture_mm = 0;  // clear semi-diameter, > 0
    bool stop = false;            // the aperture stop: flat, the same medium on both sides
    Profile profile = Profile::kRotational;
    double conic = 0;             // 0 sphere, -1 paraboloid
    std::vector<double> asphere;  // coefficients of r^4, r^6, ... r^16 in mm^-3, mm^-5, ...
    std::string coating;          // by name (coating.h); empty: what the user asks for

    bool operator==(const Surface&) const = default;
};

// One setting of a zoom: what differs from the rows as printed.
struct Position {
    struct Gap {
        int surface = 0;  // number of the row, from 1
        double thickness_mm = 0;

        bool operator==(const Gap&) const = default;
    };
    std::string name;  // "wide", "mid", "tele"
    double focal_length_mm = 0;
    double f_number = 0;   // 0: unknown
    double field_deg = 0;  // 0: unknown
    std::vector<Gap> gaps;

    bool operator==(const Position&) const = default;
};

struct Prescription {
    std::string name;
    std::string patent;          // or book
    std::string source;          // where the numbers were taken from
    std::string missing;         // what the source does not give, and what was assumed
    double focal_length_mm = 0;  // as stated; 0: not stated
    double f_number = 0;         // as stated; 0: not stated
    double field_deg = 0;        // full field as stated; 0: not stated
    std::vector<Surface> surfaces;
    std::vector<Position> positions;    // empty: a prime
    std::vector<std::string> warnings;  // what a parser mended or ignored, with surface numbers

    bool operator==(const Prescription&) const = default;
};

inline constexpr int kMaxSurfaces = 1000;

// Throws InvalidArgument, with the number of the surface, the value and what is allowed, unless:
// there are 2 to kMaxSurfaces rows, exactly one stop, and neither first nor last medium glass;
// indices are in [1, 5], Abbe numbers 0 or in [5, 150], gaps finite and >= 0 (the last may be
// anything finite), radii finite, semi-apertures finite and > 0, at most 7 asphere coefficients,
// glasses in the catalogue and within 0.002 of the index; the stop is flat between equal media;
// positions name existing rows, positive focal lengths, and each its own name. A semi-aperture
// above |radius| is no error: Lens clips it and warns.
void validate(const Prescription& prescription);

// The rows with the gaps of a position put in, and its focal length, f-number and field; without
// positions left. An empty name is the first position, or the prescription itself for a prime.
// Throws InvalidArgument for an unknown name, listing those there are.
Prescription at_position(const Prescription& prescription, const std::string& name);

}  // namespace aureole::lens
