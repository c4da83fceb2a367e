// Drawing the eyelashes, from a random stream of their own.
#include <algorithm>
#include <cmath>
#include <vector>

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

// Of a lash's bending, the share that the pupil sees.
constexpr double kSidewaysShare = 0.15;
constexpr double kGentleShare = 0.1;     // a straight strut would buckle at once
constexpr double kShortestArcMm = 0.05;  // between lids that all but touch

// Lengths of curled lashes, +- 20 and 15 %: 8 to 12 mm above, 6 to 8 below (docs/streaks.md).
constexpr double kUpperLengthMm = 10;
constexpr double kUpperLengthSpread = 0.2;
constexpr double kLowerLengthMm = 7;
constexpr double kLowerLengthSpread = 0.15;
constexpr double kUsualLashes = 7;  // Eye::eyelashes for which Lashes::curled_per_mm is meant

// Tufts: distance of their middles; lids between which they form; how far a lash may lean to its
// neighbours, as a share of its length.
constexpr double kTuftPitchMm = 1.5;
constexpr double kTuftsFromClosure = 0.2;
constexpr double kMostLean = 0.7;

// Ends a lash at the edge of its lid, `span_mm` from the tip.
void cut_at_root(wave::Lash& lash, double span_mm) {
    lash.length_mm = span_mm / std::sin(rad_from_deg(lash.direction_deg));
    lash.taper_mm = std::min(lash.taper_mm, lash.length_mm);
}

// A lash that hangs `span_mm` below the upper lid's edge, of which the lower lid has left `gap_mm`:
// its tip stands on the lower lid, and it has become an arc. Most of the bend points away from the
// eye, as the lash itself does; the pupil sees the sideways share of it, which grows gently at
// first since no lash is straight. x / sin(x) = 1 / (1 - e) gives half of the arc's angle: x^2 = 6
// e (1 + .3 e) to 1 % up to a half circle. Root and direction of the chord stay.
void bend(wave::Lash& lash, double span_mm, double gap_mm) {
    const double missing = std::clamp(1 - gap_mm / span_mm, 0.0, 1.0);
    if (missing == 0) return;
    const double direction = rad_from_deg(lash.direction_deg);
    const double length_mm = span_mm / std::sin(direction);
    const double sideways = kSidewaysShare * missing * missing / (missing + kGentleShare);
    const double half_angle = std::sqrt(6 * sideways * (1 + 0.3 * sideways));
    const double arc_mm =
        std::max((1 - missing) * length_mm, kShortestArcMm) * half_angle / std::sin(half_angle);
    const double side = std::copysign(1.0, lash.curvature_per_mm);
    lash.tip.x_mm += missing * length_mm * std::cos(direction);
    lash.tip.y_mm += missing * span_mm;
    lash.direction_deg -= side * deg_from_rad(half_angle);
    lash.curvature_per_mm += side * 2 * half_angle / arc_mm;
    lash.length_mm = arc_mm;
    lash.taper_mm = std::min(lash.taper_mm, lash.length_mm);
}

// Neighbours touch as lids close, and cling together: tips are drawn to the nearest middle of a
// tuft. A smooth map, so that no lash ever jumps from one tuft to the next.
class Tufts {
  public:
    Tufts(const Eye& eye, double closure)
        : phase_(Random(eye.seed, kTuftStream).uniform(0, 2 * kPi)),
          strength_(std::max(0.0, (closure - kTuftsFromClosure) / (1 - kTuftsFromClosure))) {}

    // The root, `span_mm` above the tip, stays where it is.
    void gather(wave::Lash& lash, double span_mm) const {
        if (strength_ == 0 || span_mm <= 0) return;
        constexpr double kPerMm = 2 * kPi / kTuftPitchMm;
        const double wish_mm = -strength_ / kPerMm * std::sin(kPerMm * lash.tip.x_mm + phase_);
        const double shift_mm = std::clamp(wish_mm, -kMostLean * span_mm, kMostLean * span_mm);
        const double root_mm = span_mm / std::tan(rad_from_deg(lash.direction_deg)) - shift_mm;
        lash.tip.x_mm += shift_mm;
        lash.direction_deg = deg_from_rad(std::atan2(span_mm, root_mm));
    }

  private:
    double phase_;
    double strength_;
};

// What all lashes of a drawing share.
struct Row {
    Row(const Eye& eye, const PupilOutline& pupil)
        : closure(std::max(eye.eyelid, eye.pose.lash_closure)),
          lids(eye, pupil, closure),
          tufts(eye, closure) {}

    double closure;
    Lids lids;
    Tufts tufts;
};

// `place`: across the row, in radii of the disc that has the pupil's area, so that a narrow pupil
// sees fewer lashes. How far they hang down is a share of the pupil's own height.
wave::Lash hanging_lash(const Eye& eye, const Row& row, double place, Random& random) {
    const Lashes& lashes = eye.anatomy.lashes;
    const double across = place + 0.12 * random.normal();
    const double reach = std::clamp(lashes.reach + lashes.reach_sd * random.normal(), 0.05, 1.2);
    const double span_mm = reach * row.lids.height_mm;
    wave::Lash lash;
    lash.tip = {across * eye.pupil_diameter_mm / 2, row.lids.upper_mm - span_mm};
    lash.direction_deg = 90 - lashes.angle_sd_deg * random.normal();
    lash.width_mm = mm_from_um(lashes.width_um) * random.uniform(0.75, 1.25);
    lash.curvature_per_mm = lashes.curvature_per_mm * random.normal();
    row.tufts.gather(lash, span_mm);
    // Those of an open eye go on above the pupil, where light from above meets them.
    if (row.closure > 0) cut_at_root(lash, span_mm);
    // What reaches beyond the lower lid of an open eye hangs in front of it.
    const double beyond_mm = std::max(reach - 1, 0.0) * row.lids.height_mm;
    bend(lash, span_mm, row.lids.gap_mm() + beyond_mm);
    return lash;
}

enum class Lid { kUpper, kLower };

// The lashes that curl away from the open eye, as far as a lid that closes has turned them in: the
// height that a lash covers is the sine of the rest. The upper lid turns by its closure; the lower
// one, pressed against it at last, by the square. They stand forward of the other lid, so that they
// pass before it and do not bend.
std::vector<wave::Lash> curled_lashes(const Eye& eye, const Row& row, Lid lid) {
    std::vector<wave::Lash> drawn;
    const Lashes& lashes = eye.anatomy.lashes;
    const bool upper = lid == Lid::kUpper;
    const double turn_deg = lashes.curl_deg * (upper ? row.closure : row.closure * row.closure);
    const double length_mm = upper ? kUpperLengthMm : kLowerLengthMm;
    const double spread = upper ? kUpperLengthSpread : kLowerLengthSpread;
    const double edge_mm = upper ? row.lids.upper_mm : -row.lids.lower_mm;
    Random random(eye.seed, upper ? kUpperCurledStream : kLowerCurledStream);
    const double per_mm = lashes.curled_per_mm * eye.eyelashes / kUsualLashes;
    const auto count = static_cast<int>(std::lround(2 * kRowEndMm * per_mm));
    for (int i = 0; i < count; ++i) {
        const double x_mm = kRowEndMm * (2 * (i + random.uniform()) / count - 1);  // of the tip
        const double curl_deg = random.uniform(0, lashes.curl_deg);
        const double own_mm = length_mm * random.uniform(1 - spread, 1 + spread);
        wave::Lash lash;
        lash.direction_deg = 90 - lashes.angle_sd_deg * random.normal();
        lash.width_mm = mm_from_um(lashes.width_um) * random.uniform(0.75, 1.25);
        lash.curvature_per_mm = lashes.curvature_per_mm * random.normal();
        const double span_mm = own_mm * std::sin(rad_from_deg(turn_deg - curl_deg));
        if (span_mm <= 0) continue;
        lash.tip = {x_mm, edge_mm - span_mm};
        row.tufts.gather(lash, span_mm);
        cut_at_root(lash, span_mm);
        if (!upper) {
            lash.tip.y_mm = -lash.tip.y_mm;
            lash.direction_deg = -lash.direction_deg;
            lash.curvature_per_mm = -lash.curvature_per_mm;
        }
        drawn.push_back(lash);
    }
    return drawn;
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
    const Row row(eye, pupil);
    const double radius_mm = eye.pupil_diameter_mm / 2;
    Random random(eye.seed, kLashStream);
    wave::Mask blocked(grid);
    const auto draw = [&](const wave::Shape& shape) {
        wave::draw(blocked, seen(shape, Layer::kBeforePupil, view), wave::Blend::kMax);
    };
    // Evenly spaced across 85 % of the pupil, then displaced; places in radii of the pupil.
    const double spacing = 2 * 0.85 / std::max(eye.eyelashes, 1);
    for (int i = 0; i < eye.eyelashes; ++i) {
        draw(wave::lash(hanging_lash(eye, row, -0.85 + (i + 0.5) * spacing, random)));
    }
    for (const Lid lid : {Lid::kUpper, Lid::kLower}) {
        for (const wave::Lash& lash : curled_lashes(eye, row, lid)) draw(wave::lash(lash));
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
                const wave::Shape shape = wave::lash(hanging_lash(eye, row, side * place, random));
                if (!before && !clear_of(clear_mm, shape)) continue;
                draw(shape);
                break;
            }
        }
    }
    return blocked;
}

}  // namespace aureole::eye
