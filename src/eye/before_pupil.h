// What lies before the pupil: how a source off the axis sees it, and where the lids stand.
#pragma once

#include "aureole/eye/anatomy.h"
#include "aureole/wave/mask_shapes.h"
#include "eye/pupil_outline.h"

namespace aureole::eye {

// Random streams of the layers, one each.
enum Stream : std::uint64_t {
    kPupilStream = 1,
    kLensSmallStream,
    kLensLargeStream,
    kVitreousStream,
    kCorneaStream,
    kGratingStream,
    kLashStream,
    kUpperCurledStream,
    kLowerCurledStream,
    kTuftStream,
};

// Highest harmonic of the pupil's edge.
inline constexpr int kLastEdgeHarmonic = 8;

// Where a source off the axis sees the points of a layer.
struct Oblique {
    double shift_x_mm = 0;  // of what lies before the pupil
    double shift_y_mm = 0;
    double along_x = 0;  // unit vector from the axis to the source
    double along_y = 0;
    double shortening = 0;  // 1 - cosine of the angle
};
Oblique oblique(const Eye& eye, const FieldPosition& field);

wave::Point foreshortened(wave::Point point, const Oblique& view);

enum class Layer { kPupil, kBeforePupil };
wave::Shape seen(wave::Shape shape, Layer layer, const Oblique& view);

// Heights of the lids' edges over the axis. Open ones touch the pupil from above and below; closing
// takes them over the height of the pupil.
struct Lids {
    Lids(const Eye& eye, const PupilOutline& pupil, double closure)
        : height_mm(2 * pupil.half_height_mm()),
          upper_mm(height_mm / 2 - (1 - eye.anatomy.lower_lid_share) * closure * height_mm),
          lower_mm(eye.anatomy.lower_lid_share * closure * height_mm - height_mm / 2) {}

    double gap_mm() const { return upper_mm - lower_mm; }

    double height_mm;  // of the pupil
    double upper_mm;
    double lower_mm;
};

}  // namespace aureole::eye
