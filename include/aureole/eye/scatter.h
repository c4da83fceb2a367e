// How much light an eye scatters, and how far: total glare functions measured on people.
//
// Every function takes the angle from the source in degrees and returns sr^-1: the luminance that
// is seen there (cd/m2) per illuminance of the source at the eye (lx). A complete description of
// the eye would integrate to 1 over the hemisphere,
//     integral of f(theta) 2 pi sin(theta) d theta, theta from 0 to 90 deg,
// but the published fits miss that by some percent; ScatterPsf divides by the integral.
//
// Sources: CIE 135/1-1999, "Disability glare" (Vos & van den Berg); CIE 146:2002, "CIE equations
// for disability glare"; IJspeert, van den Berg & Spekreijse 1993, "An improved mathematical
// description of the foveal visual point spread function with parameters for age, pupil size and
// pigmentation", Vision Research 33; Spencer, Shirley, Zimmerman & Greenberg 1995, "Physically-
// based glare effects for digital images".
#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <vector>

namespace aureole::eye {

// Colour of the iris: a lighter eye lets more stray light through its wall.
enum class Pigmentation { kBrown, kBlue, kDarkBrown, kMean };

// The names used on the command line: brown, blue, dark-brown, mean.
// Throws InvalidArgument for any other.
Pigmentation pigmentation_from_name(std::string_view name);
std::string_view name_of(Pigmentation pigmentation);

// p of the CIE formulas: brown .5, blue 1.2, dark-brown 0, mean .97 (a Caucasian population).
double cie_pigmentation(Pigmentation pigmentation);
// m of IJspeert et al.: brown .106, blue .16, dark-brown .056, mean .142.
double ijspeert_pigmentation(Pigmentation pigmentation);

// CIE 135/1-1999 total glare, 0 to 90 deg, from the core to the veil.
double cie_total_glare(double angle_deg, double age_years, double p);
// CIE 146:2002 general disability glare, 0.1 to 100 deg. Diverges at 0.
double cie_general_glare(double angle_deg, double age_years, double p);
// CIE 146:2002 age-adjusted Stiles-Holladay, 1 to 30 deg. Diverges at 0.
double age_adjusted_stiles_holladay(double angle_deg, double age_years);

// IJspeert et al. 1993, 0 to 90 deg; pupil 2 to 8 mm. Integrates to 1 exactly.
double ijspeert_psf(double angle_deg, double age_years, double pupil_diameter_mm, double m);
// Its modulation transfer function at a spatial frequency in cycles per degree.
double ijspeert_mtf(double cycles_per_deg, double age_years, double pupil_diameter_mm, double m);

// Components f0 to f3 of Spencer et al. 1995, each of unit energy: core, inner and outer veil,
// lenticular halo (the only one that depends on wavelength).
double spencer_component(int component, double angle_deg, double wavelength_nm = 568);
enum class LightLevel { kPhotopic, kMesopic, kScotopic };
// Shares of energy of f0 to f3; they sum to 1.
std::array<double, 4> spencer_weights(LightLevel level);
double spencer_psf(double angle_deg, LightLevel level, double wavelength_nm = 568);

// integral of per_sr(theta) 2 pi sin(theta) d theta between two angles (deg, 0 <= from <= to):
// Gauss-Legendre over 64 intervals per decade, from 1e-6 deg on equal in log theta. Accurate to
// 1e-6 for everything in this header.
double integrate_over_angle(const std::function<double(double angle_deg)>& per_sr,
                            double from_deg = 0, double to_deg = 90);

enum class ScatterModel {
    kCie,       // CIE 135/1-1999 total glare: knows age and pigmentation
    kIjspeert,  // IJspeert et al. 1993: knows the pupil as well; its far tail is up to three times
                // that of the CIE
    kNone,      // nothing scatters: the eye is limited by diffraction at its pupil
};

// The names used on the command line: cie, ijspeert, none. Throws InvalidArgument for any other.
ScatterModel scatter_model_from_name(std::string_view name);
std::string_view name_of(ScatterModel model);

// One scatter model with its parameters, of unit energy over the hemisphere.
class ScatterPsf {
  public:
    // age_years 1 to 120; pupil_diameter_mm 1 to 9. Throws InvalidArgument outside, and for kNone.
    ScatterPsf(ScatterModel model, double age_years, Pigmentation pigmentation,
               double pupil_diameter_mm);

    // sr^-1; 0 beyond 90 deg.
    double per_sr(double angle_deg) const;
    // Share of the energy farther than angle_deg from the source.
    double energy_beyond(double angle_deg) const;
    // What the published formula integrates to over the hemisphere; per_sr() is divided by it.
    double published_integral() const { return integral_; }

  private:
    double published(double angle_deg) const;

    ScatterModel model_;
    double age_years_;
    double pigmentation_;
    double pupil_diameter_mm_;
    double integral_ = 1;
    std::vector<double>
        beyond_;  // of the published formula, from node i of the log scale to 90 deg
};

}  // namespace aureole::eye
