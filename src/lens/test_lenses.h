// Lenses for tests, built in code.
#pragma once

#include <initializer_list>

#include "aureole/lens/prescription.h"

namespace aureole::lens {

// Rows in order; semi-apertures of 10 mm where none is given.
inline Prescription lens_of(std::initializer_list<Surface> rows) {
    Prescription lens;
    lens.name = "test";
    lens.surfaces = rows;
    for (Surface& row : lens.surfaces) {
        if (row.semi_aperture_mm == 0) row.semi_aperture_mm = 10;
    }
    return lens;
}

}  // namespace aureole::lens
