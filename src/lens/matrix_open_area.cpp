#include "lens/matrix_open_area.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "aureole/base/units.h"

namespace aureole::lens {
namespace {

// A disc's half height squared at x is r^2 - (x - c)^2 = -x^2 + f(x), f(x) = 2 c x + r^2 - c^2, so
// the disc that bounds the common area at x is the one with the least f: the lower envelope of
// straight lines, found as convex hulls are.
// Where the lines of two discs meet; centres differ.
double crossing(const LineDisc& a, const LineDisc& b) {
    return ((a.radius * a.radius - a.center * a.center) -
            (b.radius * b.radius - b.center * b.center)) /
           (2 * (b.center - a.center));
}

// Area of a disc between two distances from its centre, and its first moment about that.
struct Slice {
    double area;
    double moment;
};
Slice slice(double radius, double from, double to) {
    const double r2 = radius * radius;
    const double per_radius = 1 / radius;
    const double low = std::clamp(from * per_radius, -1.0, 1.0);
    const double high = std::clamp(to * per_radius, -1.0, 1.0);
    const double low_root = std::sqrt(1 - low * low);
    const double high_root = std::sqrt(1 - high * high);
    const auto angle = [](double sine) {
        return sine <= -1 ? -kPi / 2 : sine >= 1 ? kPi / 2 : std::asin(sine);
    };
    return {r2 * (high * high_root - low * low_root + angle(high) - angle(low)),
            2.0 / 3.0 * r2 * radius *
                (low_root * low_root * low_root - high_root * high_root * high_root)};
}

}  // namespace

BoundingDiscs bounding_discs(std::span<const LineDisc> discs,
                             std::span<LineDisc> scratch) noexcept {
    double low = -HUGE_VAL;
    double high = HUGE_VAL;
    for (const LineDisc& disc : discs) {
        low = std::max(low, disc.center - disc.radius);
        high = std::min(high, disc.center + disc.radius);
    }
    if (!(low < high)) return {};
    // From left to right the centres of the bounding discs fall.
    std::size_t size = 0;
    for (std::size_t i = discs.size(); i-- > 0;) {
        LineDisc disc = discs[i];
        bool needed = true;
        for (; size > 0; --size) {
            const LineDisc& last = scratch[size - 1];
            if (last.center == disc.center) {
                needed = disc.radius < last.radius;
                if (!needed) break;
            } else {
                disc.from = crossing(last, disc);
                needed = disc.from < high;
                if (!needed || disc.from > last.from) break;
            }
        }
        if (size == 0) disc.from = low;
        if (needed) scratch[size++] = disc;
    }
    return {scratch.first(size), high};
}

CommonArea common_area(const BoundingDiscs& bounds) noexcept {
    CommonArea common;
    double moment = 0;
    for (std::size_t i = 0; i < bounds.discs.size(); ++i) {
        const LineDisc& disc = bounds.discs[i];
        const double to = i + 1 < bounds.discs.size() ? bounds.discs[i + 1].from : bounds.high;
        const Slice piece = slice(disc.radius, disc.from - disc.center, to - disc.center);
        common.area += piece.area;
        moment += piece.moment + disc.center * piece.area;
    }
    common.area = std::max(common.area, 0.0);
    if (common.area > 0) {
        common.middle = std::clamp(moment / common.area, bounds.discs.front().from, bounds.high);
    }
    return common;
}

namespace {

constexpr int kLines = 48;    // where only edges matter
constexpr int kSamples = 28;  // per side, where pictures do

struct Interval {
    double low = -1e300;
    double high = 1e300;
    void cut(double from, double to) {
        low = std::max(low, from);
        high = std::min(high, to);
    }
    void clear() { high = low; }
};

// The chord of a line of constant v in an ellipse.
void cut_by_ellipse(Interval& chord, double u0, double v0, double ru, double rv, double v) {
    const double t = (v - v0) / rv;
    const double half = t * t < 1 ? std::abs(ru) * std::sqrt(1 - t * t) : -1;
    half < 0 ? chord.clear() : chord.cut(u0 - half, u0 + half);
}

// Smooth corners and pictures have no simple chords.
bool is_sampled(const Iris& iris) {
    return iris.is_image() || (iris.shape().blades > 0 && iris.shape().smoothing > 0);
}

// The same in the iris, placed like a clip, with sharp corners.
void cut_by_iris(Interval& chord, const Iris& iris, double u0, double v0, double ru, double rv,
                 double v) {
    if (iris.shape().blades == 0 || is_sampled(iris)) {
        // What is sampled fades over the width of a sample.
        const double radius = iris.outer_radius() + (is_sampled(iris) ? 0.1 : 0);
        cut_by_ellipse(chord, u0, v0, radius * ru, radius * rv, v);
        return;
    }
    const double own_v = (v - v0) / rv;
    Interval own;
    const double back = iris.blade_radius() - iris.apothem();
    for (int b = 0; b < iris.shape().blades; ++b) {
        const double nu = static_cast<double>(iris.blades()[b].normal_u);
        const double nv = static_cast<double>(iris.blades()[b].normal_v);
        if (iris.blade_radius() > 0) {
            cut_by_ellipse(own, -back * nu, -back * nv, iris.blade_radius(), iris.blade_radius(),
                           own_v);
            continue;
        }
        const double room = iris.apothem() - nv * own_v;
        if (std::abs(nu) < 1e-9) {
            if (room < 0) own.clear();
        } else {
            nu > 0 ? own.cut(-1e300, room / nu) : own.cut(room / nu, 1e300);
        }
    }
    if (own.low >= own.high) return chord.clear();
    const double a = u0 + ru * own.low;
    const double b = u0 + ru * own.high;
    chord.cut(std::min(a, b), std::max(a, b));
}

// Along u and v; interpolation reaches half a pixel beyond the border.
double reach_of_texture(const Image& texture) {
    return 1 + 1.0 / std::min(texture.width(), texture.height());
}

// Everything that clips, as chords.
struct Region {
    const Pupil& pupil;
    std::span<const MatrixGhost::Clip> clips;
    bool smooth;   // corners of blades, which are sampled
    bool sampled;  // these or pictures
    double reach;  // of the drawn iris

    Region(const Pupil& its_pupil, std::span<const MatrixGhost::Clip> its_clips)
        : pupil(its_pupil),
          clips(its_clips),
          smooth(is_sampled(*pupil.iris) && !pupil.iris->is_image()),
          sampled(smooth || pupil.has_pictures()),
          reach(pupil.texture != nullptr ? reach_of_texture(pupil.texture->front())
                                         : pupil.iris->outer_radius() + (smooth ? 0.1 : 0)) {}

    Interval chord(double v) const {
        Interval chord;
        if (pupil.texture != nullptr) {
            chord.cut(-reach, reach);
        } else {
            cut_by_iris(chord, *pupil.iris, 0, 0, 1, 1, v);
        }
        for (const MatrixGhost::Clip& clip : clips) {
            const double u0 = static_cast<double>(clip.u0);
            const double v0 = static_cast<double>(clip.v0);
            const double ru = static_cast<double>(clip.ru);
            const double rv = static_cast<double>(clip.rv);
            clip.iris ? cut_by_iris(chord, *pupil.iris, u0, v0, ru, rv, v)
                      : cut_by_ellipse(chord, u0, v0, ru, rv, v);
        }
        return chord;
    }

    // All v of chords that are not empty: one interval, since everything that clips is convex.
    Interval rows() const {
        Interval range = {-reach, reach};
        for (const MatrixGhost::Clip& clip : clips) {
            const double radius = clip.iris ? pupil.iris->outer_radius() + (smooth ? 0.1 : 0) : 1.0;
            const double half = static_cast<double>(std::abs(clip.rv)) * radius;
            range.cut(static_cast<double>(clip.v0) - half, static_cast<double>(clip.v0) + half);
        }
        const auto open = [&](double v) {
            const Interval at = chord(v);
            return at.low < at.high;
        };
        // The widest of some chords is inside, if any is; the ends are found from there.
        double inside = 0;
        double widest = 0;
        constexpr int kLooks = 16;
        for (int i = 0; i < kLooks; ++i) {
            const double v = range.low + (i + 0.5) / kLooks * (range.high - range.low);
            const Interval at = chord(v);
            if (at.high - at.low > widest) {
                widest = at.high - at.low;
                inside = v;
            }
        }
        if (!(widest > 0) || !(range.low < range.high)) return {0, 0};
        const auto end_from = [&](double good, double bad) {
            if (open(bad)) return bad;
            for (int i = 0; i < 24; ++i) {
                const double middle = 0.5 * (good + bad);
                (open(middle) ? good : bad) = middle;
            }
            return good;
        };
        return {end_from(inside, range.low), end_from(inside, range.high)};
    }

    // Transmission at a point between two samples this far apart.
    float share(const Entrance& entrance, float u, float v, float footprint) const {
        const Iris& iris = *pupil.iris;
        float result = pupil.pictures(entrance, u, v, footprint);
        const auto fade = [&](float own_u, float own_v, float scale) {
            const float outside = (iris.distance(own_u, own_v) - 1) * scale / footprint;
            return std::clamp(0.5F - outside, 0.0F, 1.0F);
        };
        if (pupil.texture == nullptr && smooth) result *= fade(u, v, 1);
        for (const MatrixGhost::Clip& clip : clips) {
            if (!clip.iris) continue;
            const float own_u = (u - clip.u0) / clip.ru;
            const float own_v = (v - clip.v0) / clip.rv;
            const float scale = std::abs(clip.ru);
            result *= smooth ? fade(own_u, own_v, scale)
                             : pupil.iris_picture(own_u, own_v, footprint / scale);
        }
        return result;
    }
};

}  // namespace

OpenArea whole_area(const Pupil& pupil) {
    if (pupil.texture == nullptr) {
        OpenArea open = {kPi, 0, 0};  // by definition (iris.h)
        if (pupil.iris->is_image()) {
            const OpenArea sampled = open_area({pupil.iris, nullptr, nullptr}, {}, {});
            open.middle_u = sampled.middle_u;
            open.middle_v = sampled.middle_v;
        }
        return open;
    }
    const Image& texture = pupil.texture->front();
    const double du = 2.0 / texture.width();
    const double dv = 2.0 / texture.height();
    OpenArea open;
    for (int y = 0; y < texture.height(); ++y) {
        for (int x = 0; x < texture.width(); ++x) {
            const double area = du * dv * static_cast<double>(texture.at(x, y));
            open.area += area;
            open.middle_u += area * ((x + 0.5) * du - 1);
            open.middle_v += area * (1 - (y + 0.5) * dv);
        }
    }
    if (open.area > 0) {
        open.middle_u /= open.area;
        open.middle_v /= open.area;
    }
    return open;
}

OpenArea open_area(const Pupil& pupil, const Entrance& entrance,
                   std::span<const MatrixGhost::Clip> clips) noexcept {
    const Region region(pupil, clips);
    const Interval rows = region.rows();
    OpenArea open;
    if (!(rows.low < rows.high)) return open;
    const auto add = [&](double area, double u, double v) {
        open.area += area;
        open.middle_u += area * u;
        open.middle_v += area * v;
    };
    const int lines = region.sampled ? kSamples : kLines;
    const double half_height = 0.5 * (rows.high - rows.low);
    // Lines at the midpoints of equal steps of t, v = sin t: chords that shrink to 0 at the ends as
    // square roots do are then smooth in t. The weights are those that measure a rectangle rightly.
    for (int i = 0; i < lines; ++i) {
        const double t = kPi * ((i + 0.5) / lines - 0.5);
        const double v = rows.low + half_height * (1 + std::sin(t));
        const double weight = 2 * half_height * std::cos(t) * std::sin(0.5 * kPi / lines);
        const Interval chord = region.chord(v);
        const double length = chord.high - chord.low;
        if (!(length > 0)) continue;
        if (!region.sampled) {
            add(weight * length, 0.5 * (chord.low + chord.high), v);
            continue;
        }
        const double step = length / kSamples;
        for (int k = 0; k < kSamples; ++k) {
            const double u = chord.low + (k + 0.5) * step;
            const float share = region.share(entrance, static_cast<float>(u), static_cast<float>(v),
                                             static_cast<float>(std::sqrt(step * weight)));
            add(weight * step * static_cast<double>(share), u, v);
        }
    }
    if (open.area > 0) {
        open.middle_u /= open.area;
        open.middle_v /= open.area;
    }
    return open;
}

}  // namespace aureole::lens
