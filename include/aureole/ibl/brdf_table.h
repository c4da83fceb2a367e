// The second factor of the split sum (Karis 2013, "Real Shading in Unreal Engine 4"): what a
// surface reflects of a constant environment, by the angle of the view and the roughness.
//
// All integrals are over the directions l of light, h is the half vector of l and the view v, a =
// alpha = roughness^2, and X = D V (N.l) dl. Formulas and figures: docs/brdf_tables.md.
#pragma once

#include <array>
#include <string_view>

#include "aureole/image/image.h"

namespace aureole::ibl {

enum class BrdfTableKind {
    // GGX (Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", eq. 33)
    // with height-correlated Smith (Heitz 2014, "Understanding the Masking-Shadowing Function in
    // Microfacet-Based BRDFs", eq. 99) and Schlick's Fresnel term F = F0 + (1 - F0) (1 - v.h)^5.
    //   channel 0, scale: integral of (1 - (1 - v.h)^5) X
    //   channel 1, bias:  integral of (1 - v.h)^5 X
    // The surface reflects F0 scale + bias.
    kGgx,
    // The same integrals in the form that compensates for light that bounces more than once:
    //   channel 0, DFG1: bias of kGgx
    //   channel 1, DFG2: scale + bias, what a white surface (F0 = 1) reflects without compensation
    // The surface reflects (DFG1 + F0 (DFG2 - DFG1)) (1 + F0 (1 / DFG2 - 1)): exactly 1 for F0 = 1
    // (Turquin 2019, "Practical Multiple Scattering Compensation for Microfacet Models"; the
    // environment's part of Kulla & Conty 2017, "Revisiting Physically Based Shading at
    // Imageworks"; Google Filament stores the same).
    kMultiscatter,
    // Sheen: D of Estevez & Kulla 2017, "Production Friendly Microfacet Sheen BRDF",
    // (2 + 1/a) sin(h)^(1/a) / (2 pi), with V = 1 / (4 (N.l + N.v - (N.l)(N.v))) of Neubelt &
    // Pettineo 2013, "Crafting a Next-Gen Material Pipeline for The Order: 1886", as in Google
    // Filament, without Fresnel term.
    //   channel 0: integral of X; more than 1 where both roughness and N.v are small
    kCloth,
};

inline constexpr std::array<std::string_view, 3> kBrdfTableKindNames = {"ggx", "multiscatter",
                                                                        "cloth"};

inline constexpr int kBrdfTableSize = 128;

class BrdfTable {
  public:
    // Computes the table: each value is within 2e-5 of its integral (kCloth: of 1 + it).
    // Throws InvalidArgument unless size is in [1, 1024].
    explicit BrdfTable(BrdfTableKind kind, int size = kBrdfTableSize);

    BrdfTableKind kind() const noexcept { return kind_; }
    int size() const noexcept { return image_.width(); }
    // size x size pixels; 2 channels, 1 of kCloth. Pixel (i, k) is for N.v = (i + .5) / size and
    // perceptual roughness (k + .5) / size, so that a texture with linear filtering takes (N.v,
    // roughness) as coordinates. Row 0, the first in memory, is the smoothest. Between pixels
    // linear filtering of 128 pixels is within 5e-4 where N.v > .05; beyond the last one (roughness
    // 1) it is clamped, which makes a compensated white surface 1.2 % too dark.
    const Image& image() const noexcept { return image_; }

    // As a texture with linear filtering and clamped coordinates. The second value of kCloth is 0.
    std::array<float, 2> lookup(double n_dot_v, double roughness) const noexcept;

  private:
    BrdfTableKind kind_;
    Image image_;
};

}  // namespace aureole::ibl
