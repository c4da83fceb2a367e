// Pupil diameters against values computed independently from the published formulas.
#include "aureole/eye/pupil.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/eye/ranges.h"

namespace aureole::eye {
namespace {

constexpr struct {
    double luminance_cd_m2;
    double moon_spencer;
    double thesis;
    double watson_yellott_25;  // field 60 deg wide, both eyes, 25 years
    double watson_yellott_70;
} kDiameters[] = {
    {0.0001, 7.6655199, 7.4009638, 7.8293161, 5.4996215},
    {0.001, 7.402006, 6.8921103, 7.6650485, 5.4036992},
    {0.01, 6.8940208, 6.0398469, 7.2823784, 5.180243},
    {0.1, 6.0427719, 4.9, 6.5006559, 4.7237643},
    {1, 4.90342, 3.7601531, 5.2596066, 3.9990666},
    {10, 3.7630807, 2.9078897, 3.9056815, 3.2084562},
    {100, 2.9098031, 2.3990362, 2.9187534, 2.6321499},
    {1000, 2.4000803, 2.1349943, 2.3905576, 2.3237155},
    {10000, 2.1355097, 2.0079173, 2.1537518, 2.1854352},
};

TEST(Pupil, MatchesThePublishedFormulas) {
    PupilConditions young;
    young.age_years = 25;
    young.field_area_deg2 = kPi * 30 * 30;
    PupilConditions old = young;
    old.age_years = 70;
    for (const auto& row : kDiameters) {
        const double luminance = row.luminance_cd_m2;
        SCOPED_TRACE(luminance);
        EXPECT_NEAR(pupil_diameter_mm(PupilModel::kMoonSpencer, luminance), row.moon_spencer, 1e-6);
        EXPECT_NEAR(pupil_diameter_mm(PupilModel::kThesis, luminance), row.thesis, 1e-6);
        EXPECT_NEAR(pupil_diameter_mm(PupilModel::kWatsonYellott, luminance, young),
                    row.watson_yellott_25, 1e-6);
        EXPECT_NEAR(pupil_diameter_mm(PupilModel::kWatsonYellott, luminance, old),
                    row.watson_yellott_70, 1e-6);
    }
}

// The paper gives 10^(0.8558 - 0.000401 (log10 B + 8.1)^3) with B in millilamberts
// (1 mL = 10 / pi cd/m2); ours is in cd/m2.
TEST(Pupil, DeGrootAgreesWithItsFormInMillilamberts) {
    for (const double luminance : {1e-4, 1e-2, 1.0, 100.0, 1e4}) {
        const double x = std::log10(luminance * kPi / 10) + 8.1;
        const double original = std::pow(10.0, 0.8558 - 0.000401 * x * x * x);
        EXPECT_NEAR(pupil_diameter_mm(PupilModel::kDeGroot, luminance), original, 0.01);
    }
}

TEST(Pupil, NarrowsWithLightInEveryModel) {
    for (const auto model : {PupilModel::kWatsonYellott, PupilModel::kMoonSpencer,
                             PupilModel::kDeGroot, PupilModel::kThesis}) {
        double wider = 9;
        for (double luminance = 1e-5; luminance < 1e5; luminance *= 3) {
            const double diameter = pupil_diameter_mm(model, luminance);
            EXPECT_LT(diameter, wider) << name_of(model) << " at " << luminance;
            EXPECT_GT(diameter, 1.2) << name_of(model) << " at " << luminance;
            wider = diameter;
        }
    }
}

TEST(Pupil, StaysOpenInAnyLight) {
    for (const auto model : {PupilModel::kWatsonYellott, PupilModel::kMoonSpencer,
                             PupilModel::kDeGroot, PupilModel::kThesis}) {
        for (const double luminance : {1e5, 1e7, 1.6e9}) {
            EXPECT_GE(pupil_diameter_mm(model, luminance), 1.2) << name_of(model);
        }
    }
}

TEST(Pupil, IsWiderForOneEyeASmallerFieldAndAYoungerPerson) {
    const double base = pupil_diameter_mm(PupilModel::kWatsonYellott, 10);
    PupilConditions one_eye;
    one_eye.both_eyes = false;
    PupilConditions small_field;
    small_field.field_area_deg2 = 10;
    PupilConditions child;
    child.age_years = 10;
    PupilConditions twenty;
    twenty.age_years = 20;
    EXPECT_GT(pupil_diameter_mm(PupilModel::kWatsonYellott, 10, one_eye), base + 0.3);
    EXPECT_GT(pupil_diameter_mm(PupilModel::kWatsonYellott, 10, small_field), base + 0.3);
    EXPECT_GT(pupil_diameter_mm(PupilModel::kWatsonYellott, 10, twenty), base);
    EXPECT_EQ(pupil_diameter_mm(PupilModel::kWatsonYellott, 10, twenty),
              pupil_diameter_mm(PupilModel::kWatsonYellott, 10, child));
}

TEST(Pupil, IsFiniteInDarkness) {
    for (const auto model : {PupilModel::kWatsonYellott, PupilModel::kMoonSpencer,
                             PupilModel::kDeGroot, PupilModel::kThesis}) {
        const double diameter = pupil_diameter_mm(model, 0);
        EXPECT_GT(diameter, 7) << name_of(model);
        EXPECT_LT(diameter, 8.4) << name_of(model);
    }
}

TEST(Pupil, RefusesAbsurdInput) {
    const auto model = PupilModel::kWatsonYellott;
    EXPECT_THROW(pupil_diameter_mm(model, -1), InvalidArgument);
    EXPECT_NO_THROW(pupil_diameter_mm(model, kBrightestCdM2));
    EXPECT_THROW(pupil_diameter_mm(model, 2 * kBrightestCdM2), InvalidArgument);
    EXPECT_THROW(pupil_diameter_mm(model, std::numeric_limits<double>::quiet_NaN()),
                 InvalidArgument);
    EXPECT_THROW(pupil_diameter_mm(model, std::numeric_limits<double>::infinity()),
                 InvalidArgument);
    PupilConditions conditions;
    conditions.age_years = 400;
    EXPECT_THROW(pupil_diameter_mm(model, 1, conditions), InvalidArgument);
    conditions.age_years = 30;
    conditions.field_area_deg2 = 0;
    EXPECT_THROW(pupil_diameter_mm(model, 1, conditions), InvalidArgument);
}

TEST(Pupil, ModelsAreFoundByName) {
    for (const char* name : {"watson-yellott", "moon-spencer", "de-groot", "thesis"}) {
        EXPECT_EQ(name_of(pupil_model_from_name(name)), name);
    }
    EXPECT_THROW(pupil_model_from_name("best"), InvalidArgument);
}

}  // namespace
}  // namespace aureole::eye
