// Drawing the eyelashes, from a random stream of their own.
#include <algorithm>
#include <cmath>

#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/eye/anatomy.h"
#include "aureole/wave/mask_shapes.h"
#include "eye/before_pupil.h"
#include "eye/pupil_outline.h"

namespace aureole::eye {
namespace {

// The eyelid's half length: where the row of lashes ends.
constexpr double kRowEndMm = 15;
// Draws of a lash beside the pupil until it hangs clear of it; a lash that does not is left out.
constexpr int kTries = 16;

// A lash of the length `span_mm` below the upper lid's edge, which the lower lid has left `gap_mm`
// of height, as an arc of that length; its tip stands on the lower lid. Root and direction of the
// chord stay. x = sin(x) / (1 - e) gives half of the arc's angle: x^2 = 6 e (1 + .3 e) to 1 % up to
// a half circle.
void bend(wave::Lash& lash, double span_mm, double gap_mm) {
    const double direction = rad_from_deg(lash.direction_deg);
    const double length_mm = span_mm / std::sin(direction);
    const double missing = std::clamp(1 - gap_mm / span_mm, 0.0, 1.0);
    if (missing == 0) return;
    const double half_angle = std::min(std::sqrt(6 * missing * (1 + 0.3 * missing)), kPi / 2);
    const double side = std::copysign(1.0, lash.curvature_per_mm);
    lash.tip.x_mm += missing * length_mm * std::cos(direction);
    lash.tip.y_mm += missing * span_mm;
    lash.direction_deg -= side * deg_from_rad(half_angle);
    lash.curvature_per_mm += side * 2 * half_angle / length_mm;
    // Longer ones would come back as a ring.
    lash.length_mm = std::max(lash.taper_mm, std::min(lash.length_mm, 2 * length_mm));
}

// `place`: across the row, in radii of the disc that has the pupil's area, so that a narrow pupil
// sees fewer lashes. How far they hang down is a share of the pupil's own height.
wave::Lash random_lash(const Eye& eye, const Lids& lids, double place, Random& random) {
    const Lashes& lashes = eye.anatomy.lashes;
    const double across = place + 0.12 * random.normal();
    const double reach = std::clamp(lashes.reach + lashes.reach_sd * random.normal(), 0.05, 1.2);
    wave::Lash lash;
    lash.tip = {across * eye.pupil_diameter_mm / 2, lids.upper_mm - reach * lids.height_mm};
    lash.direction_deg = 90 - lashes.angle_sd_deg * random.normal();
    lash.width_mm = mm_from_um(lashes.width_um) * random.uniform(0.75, 1.25);
    lash.curvature_per_mm = lashes.curvature_per_mm * random.normal();
    if (eye.pose.lashes_bend) {
        // What reaches beyond the lower lid of an open eye hangs in front of it.
        const double beyond_mm = std::max(reach - 1, 0.0) * lids.height_mm;
        bend(lash, reach * lids.height_mm, lids.upper_mm - lids.lower_mm + beyond_mm);
    }
    return lash;
}

// Whether all of an outline stays further than the radius from the axis.
bool clear_of(double radius_mm, const wave::Shape& shape) {
    for (const auto& outline : shape.outlines) {
        wave::Point from = outline.back();
        for (const wave::Point& to : outline) {
            const double dx = to.x_mm - from.x_mm;
            const double dy = to.y_mm - from.y_mm;
            const double square = dx * dx + dy * dy;
            const double along =
                square > 0 ? std::clamp(-(from.x_mm * dx + from.y_mm * dy) / square, 0.0, 1.0) : 0;
            if (std::hypot(from.x_mm + along * dx, from.y_mm + along * dy) <= radius_mm) {
                return false;
            }
            from = to;
        }
    }
    return true;
}

}  // namespace

wave::Mask draw_lashes(const Eye& eye, const wave::ApertureGrid& grid, const FieldPosition& field) {
    check(eye);
    const Oblique view = oblique(eye, field);
    const PupilOutline pupil(eye);
    const Lids lids(eye, pupil, std::max(eye.eyelid, eye.pose.lash_closure));
    const double radius_mm = eye.pupil_diameter_mm / 2;
    Random random(eye.seed, kLashStream);
    wave::Mask blocked(grid);
    const auto draw = [&](const wave::Shape& shape) {
        wave::draw(blocked, seen(shape, Layer::kBeforePupil, view), wave::Blend::kMax);
    };
    // Evenly spaced across 85 % of the pupil, then displaced; places in radii of the pupil.
    const double spacing = 2 * 0.85 / std::max(eye.eyelashes, 1);
    for (int i = 0; i < eye.eyelashes; ++i) {
        draw(wave::lash(random_lash(eye, lids, -0.85 + (i + 0.5) * spacing, random)));
    }
    if (eye.eyelashes == 0) return blocked;
    // The rest of the row, outwards, one to the right and one to the left: first what hangs before
    // a pupil wider than high, then what only sources off the axis see.
    const double clear_mm =
        pupil.longest_radius_mm() * (1 + eye.anatomy.pupil_irregularity * kLastEdgeHarmonic);
    for (double place = 0.85 + spacing / 2; place * radius_mm < kRowEndMm; place += spacing) {
        const bool before = place * radius_mm < 0.85 * pupil.half_width_mm();
        if (!before && view.shortening == 0) break;
        for (const double side : {1.0, -1.0}) {
            for (int attempt = 0; attempt < kTries; ++attempt) {
                const wave::Shape shape = wave::lash(random_lash(eye, lids, side * place, random));
                if (!before && !clear_of(clear_mm, shape)) continue;
                draw(shape);
                break;
            }
        }
    }
    return blocked;
}

}  // namespace aureole::eye
