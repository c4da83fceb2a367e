// The PSF of an eye over the field of view: streaks that turn with the direction of the light.
//
// A lash 12 mm before the pupil moves 2.1 mm across it when the light comes from 10 deg further
// aside. So the lashes before the pupil, their tips, and with them direction, number and energy of
// the streaks are different for every light of a picture. Scatter, corona and halo come from within
// the eye and stay what they are on the axis.
//
// Streaks are computed at nodes of the field and blended between them. Their bright centre changes
// within 2 deg of field and is small; their rays change more slowly and are long: each has nodes of
// its own (docs/field_varying.md derives and measures this).
#pragma once

#include "aureole/base/progress.h"
#include "aureole/eye/anatomy.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/image/view.h"
#include "aureole/wave/varying_psf.h"

namespace aureole::eye {

struct FieldPsfOptions {
    EyePsfOptions psf;
    // Between nodes on the axis: of the centre of streaks, and seven times as much of their rays.
    // 0.5 to 30. The error falls in proportion, the number of kernels rises with its square.
    double spacing_deg = 1.1;
    double centre_deg = 0.5;  // where centre and rays meet; 0.2 to 5
    double reach_deg = 6.5;   // where rays have been faded out. Above centre_deg
    // 0: kernels of all nodes are kept. K > 0: the mean and K principal components of those of the
    // centre, and as many of the rays (fourier::principal_components): less memory, a larger error.
    int rank = 0;
};

// As eye_psf(), and on the axis the same (but for rays beyond reach_deg), for a picture seen as
// `view`, at most 160 deg wide and high. Takes 12 s for 1080p at 60 deg on two cores.
wave::VaryingPsf eye_field_psf(const Eye& eye, const View& view,
                               const FieldPsfOptions& options = {}, Progress* progress = nullptr);

// The streaks of a light at one position: E, w_e of its energy. All 0 where no lash lies before the
// pupil. The truth that eye_field_psf() blends.
Image streaks_at(const Eye& eye, const FieldPosition& field, const wave::KernelGrid& grid,
                 const EyePsfOptions& options = {});

// Where pixel position (x, y) of a picture lies in the field.
FieldPosition field_position(const View& view, double x, double y);

}  // namespace aureole::eye
