// Small scenes with one question each: what does glare make of lights of a given size, brightness
// and colour, of a light that is half hidden, of glints on water, of a flame, of the setting sun?
//
// All are drawn for a perspective View in absolute luminance: linear sRGB whose luminance() is
// cd/m2. Edges are antialiased by exact coverage, so that a light has its energy, luminance times
// solid angle, at any size and at any position between the pixels. Nothing depends on the number
// of threads, nor, where there is a time, on the pictures before.
//
// Directions are angles to the right and up from the optical axis; (tan x, tan y) is the place in
// the picture plane.
#pragma once

#include <cstdint>
#include <vector>

#include "aureole/color/rgb.h"
#include "aureole/image/image.h"
#include "aureole/image/view.h"
#include "aureole/scene/scene.h"

namespace aureole::scene {

// A round, uniform light: what a cone of light shows.
struct DiscLight {
    double x_deg = 0;  // -80 to 80
    double y_deg = 0;
    double diameter_deg = 0.53;  // above 0, at most 60
    color::Rgb rgb_cd_m2 = {1, 1, 1};
};

// A light too small to have a shape: it covers a square of one pixel around its exact position.
struct PointLight {
    double x_deg = 0;  // -80 to 80
    double y_deg = 0;
    color::Rgb illuminance_lx = {};  // at the eye, facing the light
};

// Illuminance of a star of visual magnitude m, lx: magnitude 0 is 2.54e-6 lx (Allen's
// Astrophysical Quantities, 3rd edition, section 94).
double star_illuminance_lx(double magnitude);

// A uniform ground with lights before it. Discs hide the ground and must not overlap; points add.
// Throws InvalidArgument for lights outside the ranges above, values below 0 or not finite.
Image lights_on_ground(const View& view, const color::Rgb& ground_cd_m2,
                       const std::vector<DiscLight>& discs,
                       const std::vector<PointLight>& points = {});

// A rectangular plate that stands before a picture, with or without square holes in it.
struct Plate {
    double left_deg = 0;  // edges; -90 and 90 are beyond any picture
    double right_deg = 90;
    double bottom_deg = -90;
    double top_deg = 90;
    double transmission = 0;    // of its material, 0 opaque to 1
    double hole_pitch_deg = 0;  // from hole to hole in the middle of the picture; 0: no holes
    double hole_width_deg = 0;  // at most the pitch
    color::Rgb rgb_cd_m2 = {};  // of its material, added to what it lets through
};

// Multiplies each pixel by the share of light that passes. Edges inside a pixel count by their
// exact share of it, independently of where in the pixel light comes from.
// Throws InvalidArgument for values outside the ranges above or edges out of order.
void put_before(const Plate& plate, const View& view, const ImageView& rgb_cd_m2);

// Sun glints on moving water, the sun itself out of sight.
//
// Waves are sines with the dispersion of deep water, capillary waves included. Those that a pixel
// can show tilt the surface; the others, and ripples of per-axis slope variance 4e-4, spread the
// sun's reflection: Cox & Munk 1954, "Measurement of the roughness of the sea surface from
// photographs of the sun's glitter". Slopes have in all the variance that they measured.
struct Water {
    double time_s = 0;
    double eye_height_m = 1.7;      // above the water, 0.1 to 1000
    double pitch_deg = -14;         // of the view, -80 to 0
    double sun_elevation_deg = 24;  // ahead; 5 to 85
    double wind_m_s = 3;            // 0.5 to 15
    std::uint64_t seed = 1;         // other waves
};
// Sun 1e5 lx, sky 3000 cd/m2 at the horizon to 1500 above, water 100 to 2000, glints to 2e6.
Scene make_water(const View& view, const Water& water);

// A candle before a wall in a dark room. Wax and wall are lit by nothing else than the flame but
// for 0.02 cd/m2.
struct Candle {
    double time_s = 0;        // the flame trembles; at rest it is 28 mm high and 7 mm wide
    double distance_m = 8;    // 0.3 to 100
    double intensity_cd = 1;  // of the flame at every moment, above 0
    std::uint64_t seed = 1;   // trembles otherwise
};
// Flame about 8000 cd/m2 at 1 cd; its illuminance at the eye is intensity over distance squared.
Scene make_candle(const View& view, const Candle& candle);
// What the flame alone makes at the eye: intensity over distance squared, in its colour.
color::Rgb flame_illuminance_lx(const Candle& candle);

// The sun going down behind the sea. `view` looks at its azimuth, 1.5 deg above the horizon.
struct Sunset {
    double sun_elevation_deg = 3;  // of the centre, without refraction; -3 to 15
};
// Sun as setting_sun_cd_m2() over 0.53 deg as far as it is above the horizon; sky 400 cd/m2 with
// the sun on the horizon, a decade more or less for every 5.6 deg, and a glow around the sun. The
// sea has the waves of a wind of 3 m/s, seen from 6 m above it; it mirrors the sky and, in a path
// below it, what is visible of the sun (Cox & Munk 1954, with the shadows of Smith 1967).
Scene make_sunset(const View& view, const Sunset& sunset);

// Luminance of the sun's disc: 1.6e9 cd/m2 outside the air, dimmed by Rayleigh scattering (optical
// depth 0.062, 0.098, 0.20 in R, G, B: 610, 545 and 455 nm, Bucholtz 1995) and haze (0.06, 0.07,
// 0.085) along the air mass of Kasten & Young 1989.
color::Rgb setting_sun_cd_m2(double elevation_deg);

}  // namespace aureole::scene
