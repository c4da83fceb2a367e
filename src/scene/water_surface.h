// The surface of water, and the sun in it.
//
// It is a sum of sines with slopes s(x, z, t). What a pixel cannot show of them becomes slope
// variance v per axis, isotropic and normally distributed.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/vec.h"

namespace aureole::scene {

struct WaveField {
    double wind_m_s = 3;
    double longest_m = 5;
    int waves = 26;
    double heading_deg = 20;  // of the wind, from across the view towards it
    double time_s = 0;
    std::uint64_t seed = 1;
};

class WaterSurface {
  public:
    explicit WaterSurface(const WaveField& field);

    struct Slopes {
        float x = 0;  // of what is shown
        float z = 0;
        float variance = 0;  // of the rest, per axis
    };
    // At a point of the water, for a sample of this size on it: across the view and along it.
    Slopes at(Vec3 point, float across_m, float along_m) const;

  private:
    struct Wave {
        float kx = 0;  // rad per m
        float kz = 0;
        float length_m = 0;
        float slope = 0;  // amplitude
        float phase = 0;  // at the moment
    };
    std::vector<Wave> waves_;
};

// Unpolarised reflectance of water (index 1.333) by Fresnel's law.
float fresnel_of_water(float cosine);

// What an eye sees of facets that it looks at with mean cosine `facing`, of slope deviation sigma
// (Smith 1967, "Geometrical shadowing of a random rough surface"): with t = facing / sigma,
//     area = sigma (t Phi(t) + phi(t)),   lean = sigma^2 Phi(t) / area,
// Phi and phi the normal distribution and its density. `area` is what they cover of the view per
// area of the ground: the cosine, and more at grazing angles, where those are seen that lean
// towards the eye, on average by the slope `lean`.
struct VisibleFacets {
    float area = 0;
    float lean = 0;
};
VisibleFacets visible_facets(float facing, float sigma);

// Radiance of a sun of 1 lx (facing it) in facets around the slopes (Cox & Munk 1954):
//     F p(h - s) G / (4 area h_y^4),   p(d) = exp(-d^2 / 2v) / (2 pi v),
// h the slope that mirrors the sun into the eye, F the reflectance of that facet, G the share of
// facets that a low sun reaches. Both directions point away from the water.
float glitter(const WaterSurface::Slopes& slopes, Vec3 to_sun, Vec3 to_eye);

}  // namespace aureole::scene
