// How much light a coated face reflects.
//
// Exact for any stack of homogeneous lossless layers: the characteristic matrix of Abeles 1950
// (Born & Wolf, "Principles of Optics", 7th ed., 1.6.4), with complex cosines, so that total
// internal reflection gives 1 and never NaN. For one layer it equals the Airy form that the
// blog prints. Transmission is 1 - reflectance: nothing is absorbed.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace aureole::lens {

struct Layer {
    double index = 1;
    double thickness_nm = 0;  // physical, not optical
};

// Layers in order from the front medium to the back one.
using Coating = std::vector<Layer>;

struct Reflectance {
    double s = 0;                                  // electric field across the plane of incidence
    double p = 0;                                  // in it
    double mean() const { return 0.5 * (s + p); }  // of unpolarised light
};

// `cos_incidence` in [0, 1] in the front medium. No layers: Fresnel's equations.
Reflectance reflectance(double index_front, double index_back, std::span<const Layer> layers,
                        double wavelength_nm, double cos_incidence);

// A quarter wave at normal incidence: thickness lambda / (4 n), n = max(sqrt(n1 n2), 1.38), 1.38
// being magnesium fluoride (the blog).
Coating quarter_wave(double index_front, double index_back, double design_nm);

// What a name means on a face between air and glass:
//   none             bare
//   mgf2[:NM]        quarter_wave(), designed for NM, default 550
//   broadband[:NM]   three layers, quarter-half-quarter wave of MgF2 1.38, ZrO2 2.1, CeF3 1.63 from
//                    the air side (Macleod, "Thin-Film Optical Filters", ch. 4)
//   N/NM,N/NM,...    index and physical thickness in nm of each layer, from the air side
// Cemented faces, between two glasses, are never coated: the result is empty. Throws
// InvalidArgument for other names, indices outside [1, 5], thicknesses outside (0, 10000] nm.
Coating coating_from_name(const std::string& name, double index_front, double index_back);

}  // namespace aureole::lens
