// The plane in which light is cut and delayed: a pupil, an iris, and what floats in them.
//
// Convention of the centre, everywhere: sample (i, j) of an N x N raster is the square of side
// dx = extent / N around the point
//     x = (i - N/2) dx,   y = (j - N/2) dx        (mm; x to the right, y up, j = 0 at the bottom)
// so that the optical axis is the *centre of sample (N/2, N/2)*, the zero of a discrete Fourier
// transform. A raster centred between samples is wrong by half a texel (thesis figs. 3.10-3.11):
// its mask is not symmetric under (i, j) -> (N - i, N - j), and a phase that depends on position
// (defocus, Fresnel) then shifts the pattern.
#pragma once

#include "aureole/base/buffer.h"

namespace aureole::wave {

struct ApertureGrid {
    int samples = 4096;     // per side; 7-smooth and even
    double extent_mm = 10;  // side of the square; |FFT|^2 needs at least twice the opening

    double spacing_mm() const { return extent_mm / samples; }
    std::size_t size() const {
        return static_cast<std::size_t>(samples) * static_cast<std::size_t>(samples);
    }
    double x_mm(int i) const { return (i - samples / 2) * spacing_mm(); }
    double y_mm(int j) const { return (j - samples / 2) * spacing_mm(); }
    bool operator==(const ApertureGrid&) const = default;
};

// Throws InvalidArgument unless samples is even, 7-smooth and at least 2, and the extent is
// positive and finite. Masks and fields check their grid by it.
void check(const ApertureGrid& grid);

// A real plane over an aperture: coverage or transmission (0 to 1), or a count of layers.
// Row-major, index j * samples + i.
struct Mask {
    explicit Mask(const ApertureGrid& grid, float value = 0);
    ApertureGrid grid;
    Buffer values;
    float* row(int j) { return values.data() + static_cast<std::size_t>(j) * grid.samples; }
    const float* row(int j) const {
        return values.data() + static_cast<std::size_t>(j) * grid.samples;
    }
};

// A complex plane over an aperture: amplitude and phase of the light behind it.
struct Field {
    explicit Field(const ApertureGrid& grid);  // zero
    ApertureGrid grid;
    Buffer re;
    Buffer im;
    // Whether a sample is the mean of the light over its square, as masks are drawn: the transform
    // is then dimmed towards the ends of its band by a known factor, which its readers divide out.
    // A strong quadratic phase is multiplied in sample by sample and has no such factor.
    bool box_filtered = true;
};

// Light of amplitude `mask` and phase 0.
Field field_from(const Mask& mask);
// field *= mask. Throws InvalidArgument unless both have the same grid.
void multiply(Field& field, const Mask& mask);
// Area of the mask in mm^2: the sum of its values times the area of a sample.
double area_mm2(const Mask& mask);

}  // namespace aureole::wave
