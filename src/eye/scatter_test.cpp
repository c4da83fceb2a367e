// The scatter models against tabulated values, their stated integrals and their transforms.
#include "aureole/eye/scatter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/units.h"

namespace aureole::eye {
namespace {

#include "eye/glare_reference.inc"

TEST(CieGlare, MatchesTheReferenceTable) {
    for (const auto& row : kGlareValues) {
        SCOPED_TRACE(testing::Message() << row.age_years << " years, " << row.angle_deg << " deg");
        EXPECT_NEAR(cie_total_glare(row.angle_deg, row.age_years, 0.5) / row.total, 1, 1e-5);
        EXPECT_NEAR(cie_general_glare(row.angle_deg, row.age_years, 0.5) / row.general, 1, 1e-5);
        EXPECT_NEAR(
            age_adjusted_stiles_holladay(row.angle_deg, row.age_years) / row.stiles_holladay, 1,
            1e-5);
    }
}

TEST(CieGlare, IntegratesToTheReferenceValues) {
    for (const auto& row : kGlareIntegrals) {
        SCOPED_TRACE(testing::Message() << row.age_years << " years, p " << row.p);
        const auto glare = [&](double angle_deg) {
            return cie_total_glare(angle_deg, row.age_years, row.p);
        };
        EXPECT_NEAR(integrate_over_angle(glare), row.to_90_deg, 1e-5);
        EXPECT_NEAR(integrate_over_angle(glare, 0, 10), row.to_10_deg, 1e-5);
    }
}

TEST(Ijspeert, HasUnitEnergyForEveryPupil) {
    for (const double pupil_mm : {2.0, 3.0, 5.0, 6.5, 8.0}) {
        for (const double age : {20.0, 50.0, 80.0}) {
            const auto psf = [&](double angle_deg) {
                return ijspeert_psf(angle_deg, age, pupil_mm, 0.142);
            };
            EXPECT_NEAR(integrate_over_angle(psf), 1, 1e-5) << pupil_mm << " mm, " << age;
        }
    }
}

// In the tangent plane rho = tan(phi) each term is exactly b / (2 pi (rho^2 + b^2)^1.5), whose
// two-dimensional transform is exp(-2 pi b f); f = 180 q / pi cycles per unit of rho.
TEST(Ijspeert, MtfIsTheHankelTransformOfThePsf) {
    const double age = 40;
    const double pupil_mm = 4;
    const double m = 0.106;
    for (const double q : {0.3, 1.0, 4.0, 12.0}) {
        const double frequency = 360 * q;  // 2 pi f
        const double step = std::min(0.1 / frequency, 2e-6 * std::sqrt(1 / q));
        double sum = 0;
        double rho = 0;
        // Simpson's rule over intervals that grow with rho, never longer than a tenth of a period.
        const auto integrand = [&](double r) {
            const double phi = std::atan(r);
            return ijspeert_psf(deg_from_rad(phi), age, pupil_mm, m) * std::pow(std::cos(phi), 3) *
                   std::cyl_bessel_j(0.0, frequency * r) * 2 * kPi * r;
        };
        while (rho < 60 / std::sqrt(frequency)) {
            const double width = std::min(0.3 / frequency, step + 0.02 * rho);
            sum += width / 6 *
                   (integrand(rho) + 4 * integrand(rho + width / 2) + integrand(rho + width));
            rho += width;
        }
        EXPECT_NEAR(sum, ijspeert_mtf(q, age, pupil_mm, m), 2e-4) << q << " cycles per degree";
    }
}

TEST(Spencer, ComponentsHaveUnitEnergy) {
    for (const int component : {0, 1}) {
        const auto psf = [&](double angle_deg) { return spencer_component(component, angle_deg); };
        EXPECT_NEAR(integrate_over_angle(psf), 1, 0.005) << "f" << component;
    }
    // f2 ~ theta^-2 owes its integral to where it ends: 90 deg on the sphere.
    const auto veil = [](double angle_deg) { return spencer_component(2, angle_deg); };
    EXPECT_NEAR(integrate_over_angle(veil), 1, 0.02);
    for (const double wavelength_nm : {450.0, 568.0, 650.0}) {
        const auto halo = [&](double angle_deg) {
            return spencer_component(3, angle_deg, wavelength_nm);
        };
        EXPECT_NEAR(integrate_over_angle(halo), 1, 0.01) << wavelength_nm << " nm";
    }
}

TEST(Spencer, WeightsSumToOne) {
    for (const auto level : {LightLevel::kPhotopic, LightLevel::kMesopic, LightLevel::kScotopic}) {
        const auto w = spencer_weights(level);
        EXPECT_NEAR(w[0] + w[1] + w[2] + w[3], 1, 1e-12);
    }
}

TEST(Spencer, HaloIsAt3DegFor568NmAndGrowsWithWavelength) {
    EXPECT_GT(spencer_component(3, 3.0, 568), spencer_component(3, 2.9, 568));
    EXPECT_GT(spencer_component(3, 3.0, 568), spencer_component(3, 3.1, 568));
    EXPECT_GT(spencer_component(3, 3.7, 700), spencer_component(3, 3.0, 700));
}

TEST(ScatterPsf, HasUnitEnergyAndReportsTheFormulasOwn) {
    for (const auto& row : kGlareIntegrals) {
        if (row.p != 0.5) continue;
        const ScatterPsf psf(ScatterModel::kCie, row.age_years, Pigmentation::kBrown, 5);
        EXPECT_NEAR(psf.published_integral(), row.to_90_deg, 1e-5);
        EXPECT_NEAR(psf.energy_beyond(0), 1, 1e-9);
        EXPECT_NEAR(psf.energy_beyond(10), 1 - row.to_10_deg / row.to_90_deg, 1e-5);
        EXPECT_EQ(psf.energy_beyond(90), 0);
        EXPECT_EQ(psf.per_sr(91), 0);
    }
}

TEST(ScatterPsf, EnergyBeyondAnAngleIsTheIntegralOfTheDensity) {
    const ScatterPsf psf(ScatterModel::kIjspeert, 55, Pigmentation::kBlue, 4.2);
    const auto density = [&](double angle_deg) { return psf.per_sr(angle_deg); };
    for (const double angle_deg : {1e-7, 3e-3, 0.0345, 1.0, 17.3, 89.9}) {
        EXPECT_NEAR(psf.energy_beyond(angle_deg), integrate_over_angle(density, angle_deg, 90),
                    1e-7)
            << angle_deg;
    }
}

// CIE 135: stray light grows with age and is stronger in blue eyes, at angles above a degree.
TEST(ScatterPsf, VeilGrowsWithAgeAndWithLighterEyes) {
    for (const auto model : {ScatterModel::kCie, ScatterModel::kIjspeert}) {
        const ScatterPsf young(model, 25, Pigmentation::kBrown, 4);
        const ScatterPsf old(model, 70, Pigmentation::kBrown, 4);
        const ScatterPsf blue(model, 25, Pigmentation::kBlue, 4);
        EXPECT_GT(old.per_sr(5), 1.5 * young.per_sr(5));
        EXPECT_GT(blue.per_sr(10), 1.05 * young.per_sr(10));
        EXPECT_LT(old.per_sr(0), young.per_sr(0));
    }
}

// IJspeert et al.: a wider pupil has a sharper diffraction core but more aberration.
TEST(ScatterPsf, OnlyIjspeertKnowsThePupil) {
    const auto at = [](ScatterModel model, double pupil_mm, double angle_deg) {
        return ScatterPsf(model, 30, Pigmentation::kBrown, pupil_mm).per_sr(angle_deg);
    };
    EXPECT_EQ(at(ScatterModel::kCie, 2, 0.1), at(ScatterModel::kCie, 7, 0.1));
    EXPECT_GT(at(ScatterModel::kIjspeert, 7, 0.1), 1.5 * at(ScatterModel::kIjspeert, 2, 0.1));
}

TEST(ScatterPsf, RefusesAbsurdInput) {
    const auto make = [](ScatterModel model, double age, double pupil_mm) {
        return ScatterPsf(model, age, Pigmentation::kBrown, pupil_mm);
    };
    EXPECT_THROW(make(ScatterModel::kNone, 30, 4), InvalidArgument);
    EXPECT_THROW(make(ScatterModel::kCie, 0, 4), InvalidArgument);
    EXPECT_THROW(make(ScatterModel::kCie, 500, 4), InvalidArgument);
    EXPECT_THROW(make(ScatterModel::kIjspeert, 30, 0.5), InvalidArgument);
    EXPECT_THROW(make(ScatterModel::kIjspeert, 30, 12), InvalidArgument);
}

TEST(Pigmentation, NamesAndFactors) {
    EXPECT_EQ(cie_pigmentation(pigmentation_from_name("brown")), 0.5);
    EXPECT_EQ(ijspeert_pigmentation(pigmentation_from_name("brown")), 0.106);
    EXPECT_EQ(cie_pigmentation(pigmentation_from_name("blue")), 1.2);
    EXPECT_EQ(ijspeert_pigmentation(pigmentation_from_name("blue")), 0.16);
    EXPECT_EQ(cie_pigmentation(pigmentation_from_name("dark-brown")), 0);
    EXPECT_EQ(ijspeert_pigmentation(pigmentation_from_name("dark-brown")), 0.056);
    EXPECT_EQ(cie_pigmentation(pigmentation_from_name("mean")), 0.97);
    EXPECT_EQ(ijspeert_pigmentation(pigmentation_from_name("mean")), 0.142);
    EXPECT_EQ(name_of(Pigmentation::kDarkBrown), "dark-brown");
    EXPECT_EQ(name_of(scatter_model_from_name("ijspeert")), "ijspeert");
    EXPECT_THROW(pigmentation_from_name("green"), InvalidArgument);
    EXPECT_THROW(scatter_model_from_name("best"), InvalidArgument);
}

}  // namespace
}  // namespace aureole::eye
