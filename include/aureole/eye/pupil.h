// How wide the pupil opens: diameter from the luminance that the eye is adapted to.
#pragma once

#include <string_view>

namespace aureole::eye {

enum class PupilModel {
    // Watson & Yellott 2012, "A unified formula for light-adapted pupil size", Journal of Vision
    // 12(10):12: knows age, size of the adapting field and number of eyes. The default.
    kWatsonYellott,
    // Moon & Spencer 1944: 4.9 - 3 tanh(0.4 log10 L - 0.00114), L in cd/m2.
    kMoonSpencer,
    // De Groot & Gebhard 1952: 7.175 exp(-0.00092 (7.597 + log10 L)^3), at least 1.2 mm, below
    // which the formula falls from 8e4 cd/m2 on.
    kDeGroot,
    // As printed in the thesis (eq. 2.14): 4.9 - 3 tanh(0.4 (log10 L + 1)). This is Moon & Spencer
    // with a slip of units by one decade: pupils are up to 1.1 mm too small. For comparison only.
    kThesis,
};

// The names used on the command line: watson-yellott, moon-spencer, de-groot, thesis.
// Throws InvalidArgument for any other.
PupilModel pupil_model_from_name(std::string_view name);
std::string_view name_of(PupilModel model);

// What else than luminance moves the pupil; only Watson & Yellott know it.
struct PupilConditions {
    double age_years = 30;          // 1 to 120; the model's data span 20 to 83, and ages outside
                                    // are taken as the nearest of these
    double field_area_deg2 = 2827;  // area of the adapting field; the default is a disc 60 deg wide
    bool both_eyes = true;          // one eye alone counts as a tenth of the light
};

// Diameter in mm, 1.2 to 8.3. luminance_cd_m2: 0 to kBrightestCdM2; below kDarknessCdM2 it is taken
// as that (ranges.h).
// Throws InvalidArgument for another luminance, an age outside 1 to 120, an area that is not in
// (0, 41253] deg^2.
double pupil_diameter_mm(PupilModel model, double luminance_cd_m2,
                         const PupilConditions& conditions = {});

}  // namespace aureole::eye
