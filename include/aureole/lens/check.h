// What is doubtful about a lens table.
#pragma once

#include <string>
#include <vector>

#include "aureole/lens/prescription.h"

namespace aureole::lens {

struct Finding {
    enum class Kind {
        kFocalLength,   // computed and stated focal length differ by more than 2 %
        kFNumber,       // the printed stop gives another f-number than the stated one, by 5 %
        kSemiAperture,  // a semi-aperture above the radius of curvature
        kCrossing,      // neighbouring surfaces meet inside their clear apertures
        kNoDispersion,  // glass without Abbe number or catalogue name
        kDiameters,     // the column of semi-apertures looks like one of diameters
        kBackFocus,     // the printed last gap is off the computed one by more than 2 % of EFL
        kTooDark,       // another aperture limits the beam on the axis, by more than 1 % of it
        kParser,        // what the parser mended or ignored
    };
    Kind kind;
    int surface = 0;   // number of the row, from 1; 0: the whole lens
    std::string text;  // one sentence with the values, for people
};

// kebab-case names of the kinds, for reports: "focal-length", "f-number", ...
const char* name_of(Finding::Kind kind);

// Of one position of a zoom (prescription.h, at_position), or a prime. Throws what validate()
// throws, and InvalidArgument for a table without focal length (afocal).
std::vector<Finding> check(const Prescription& prescription);

}  // namespace aureole::lens
