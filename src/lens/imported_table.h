// What the files of design programs have in common: they say where the stop is by marking a
// surface, name glasses, state an entrance pupil, and often leave clear apertures to the program.
#pragma once

#include <string>
#include <string_view>

#include "aureole/lens/glass.h"
#include "aureole/lens/prescription.h"
#include "lens/format_text.h"

namespace aureole::lens {

// A table as such a file gives it. A semi-aperture of 0 is one that the file does not give.
struct ImportedTable {
    Prescription lens;
    double entrance_pupil_mm = 0;  // diameter; 0: not given
    double half_field_deg = 0;     // 0: not given
};

// A glass by the name that a program uses: "N-BK7", "bk7", "NBK7_SCHOTT"; nullptr if the catalogue
// lacks it.
const Glass* find_program_glass(std::string_view name);

// Sets glass, index and Abbe number from such a name. Throws FileError for a glass that is
// not in the catalogue.
void set_glass(Surface& surface, std::string_view name, const Place& place);

// From the file's unit of length to mm.
void scale(Surface& surface, double mm_per_unit);

// Makes the stop a flat row of its own where the file marks a face of glass (on the air side, at
// no distance), takes the f-number from the entrance pupil, and estimates the semi-apertures that
// are missing: |marginal| + |principal ray| of the paraxial beam and 5 %, clipped to the radius.
// All this is told in the warnings. Throws FileError: what validate() refuses; a stop inside
// cemented glass; missing semi-apertures without a pupil or f-number to estimate them from.
Prescription finished(ImportedTable table, const std::string& file);

}  // namespace aureole::lens
