// Lenses for tests, built in code.
#pragma once

#include <string>
#include <vector>

#include "aureole/lens/prescription.h"

namespace aureole::lens {

// A row with a default for every member, so that a test names what it is about.
struct TestRow {
    double radius_mm = 0;
    double thickness_mm = 0;
    double index = 1;
    double abbe = 0;
    double semi_aperture_mm = 10;
    bool stop = false;
    Profile profile = Profile::kRotational;
    double conic = 0;
    std::vector<double> asphere = {};
    std::string coating = {};
};

inline Prescription lens_of(const std::vector<TestRow>& rows, double f_number = 0) {
    Prescription lens;
    lens.name = "test";
    lens.f_number = f_number;
    for (const TestRow& row : rows) {
        Surface surface;
        surface.radius_mm = row.radius_mm;
        surface.thickness_mm = row.thickness_mm;
        surface.index = row.index;
        surface.abbe = row.abbe;
        surface.semi_aperture_mm = row.semi_aperture_mm;
        surface.stop = row.stop;
        surface.profile = row.profile;
        surface.conic = row.conic;
        surface.asphere = row.asphere;
        surface.coating = row.coating;
        lens.surfaces.push_back(surface);
    }
    return lens;
}

}  // namespace aureole::lens
