// The linear optics of rays near the axis.
//
// A ray is (height in mm, slope); slopes are dy/dz along the way that light travels, so that after
// a reflection the system is unfolded and T(d) keeps a positive d ("convention A"; the second seed
// document):
//     T(d) = [1 d; 0 1],  R = [1 0; (n1 - n2) / (r n2)  n1 / n2],  L = [1 0; 2 / r  1],
// and going backwards r -> -r and the indices change places. It is *not* the matrix inverse, which
// belongs to a convention with a fixed axis; mixing the two is wrong although det stays the same.
#pragma once

#include <vector>

#include "aureole/lens/ghosts.h"
#include "aureole/lens/lens.h"

namespace aureole::lens {

// [a b; c d] times (height, slope).
struct Matrix {
    double a = 1, b = 0, c = 0, d = 1;
    double determinant() const { return a * d - b * c; }
};
Matrix operator*(const Matrix& left, const Matrix& right);  // right acts first

Matrix translation(double distance_mm);
Matrix refraction(double curvature_per_mm, double index_before, double index_after);
Matrix reflection(double curvature_per_mm);

// The same in both meridians; they differ only behind cylinders.
struct Meridians {
    Matrix x, y;
};

// From the plane of the first vertex to one crossing: after translation to the face, before it
// acts.
struct CrossingMatrix {
    int face = 0;
    Meridians matrix;
};

struct GhostMatrices {
    Meridians to_sensor;                    // height 0 in, slope: B; height: A = dX/dp
    std::vector<CrossingMatrix> crossings;  // every face met, in order, the stop included
    // Indices into `crossings` at which the stop is met: one, or three.
    std::vector<int> stop_crossings;
};

// For the direct image (Bounces{}) too.
GhostMatrices ghost_matrices(const Lens& lens, const Bounces& bounces, double wavelength_nm);

// Distances in mm along z from the first vertex unless said otherwise; x meridian for cylinders.
struct CardinalPoints {
    double efl_mm = 0;
    double bfd_mm = 0;  // last vertex to the rear focus
    double front_principal_z_mm = 0;
    double rear_principal_z_mm = 0;
    double entrance_pupil_z_mm = 0;  // images of the stop
    double entrance_pupil_diameter_mm = 0;
    double exit_pupil_z_mm = 0;
    double exit_pupil_diameter_mm = 0;
    double f_number = 0;  // efl / entrance pupil diameter, paraxial
};
// Throws InvalidArgument for an afocal system.
CardinalPoints cardinal_points(const Lens& lens, double wavelength_nm);

}  // namespace aureole::lens
