#include "lens/matrix_chords.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"
#include "lens/matrix_ghosts.h"

namespace aureole::lens {
namespace {

using Line = IrisChords::Line;

// Chords at the midpoints of equal steps of t, v = sin t: their lengths, which shrink to 0 at the
// ends of discs as square roots do, are then smooth in t. The weights are those that measure a
// rectangle rightly.
ChordNodes chord_nodes() {
    ChordNodes nodes;
    for (int i = 0; i < kChords; ++i) {
        const double t = kPi * ((i + 0.5) / kChords - 0.5);
        nodes.position[i] = static_cast<float>(std::sin(t));
        nodes.weight[i] = static_cast<float>(2 * std::cos(t) * std::sin(0.5 * kPi / kChords));
    }
    return nodes;
}

struct Point {
    double u, v;
};

// Where two lines meet.
Point corner(const Line& a, const Line& b) {
    const double determinant = a.normal_u * b.normal_v - a.normal_v * b.normal_u;
    return {(a.distance * b.normal_v - b.distance * a.normal_v) / determinant,
            (b.distance * a.normal_u - a.distance * b.normal_u) / determinant};
}

double area_of(std::span<const Line> lines) {
    double area = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const Line& before = lines[(i + lines.size() - 1) % lines.size()];
        const Line& after = lines[(i + 1) % lines.size()];
        const Point from = corner(before, lines[i]);
        const Point to = corner(lines[i], after);
        area += 0.5 * (from.u * to.v - from.v * to.u);
    }
    return area;
}

// The edge of an iris in evenly spaced directions from its middle.
std::vector<Point> outline_of(const Iris& iris) {
    constexpr int kPoints = 1024;
    std::vector<Point> points;
    for (int i = 0; i < kPoints; ++i) {
        const double angle = 2 * kPi * i / kPoints;
        const Point towards = {std::cos(angle), std::sin(angle)};
        double low = 0;
        double high = 2 * iris.outer_radius();
        for (int step = 0; step < 40; ++step) {
            const double middle = 0.5 * (low + high);
            const float distance = iris.distance(static_cast<float>(middle * towards.u),
                                                 static_cast<float>(middle * towards.v));
            (distance < 1 ? low : high) = middle;
        }
        points.push_back({low * towards.u, low * towards.v});
    }
    return points;
}

}  // namespace

// Of an outline that is not straight, about.
constexpr int kTangents = 40;

IrisChords::IrisChords(const Iris& iris) : nodes_(chord_nodes()) {
    const int blades = iris.shape().blades;
    const bool sharp = iris.blade_radius() == 0 && iris.shape().smoothing == 0;
    const int per_blade = sharp ? 1 : std::max(1, kTangents / blades);
    const int count = blades * per_blade;
    const std::vector<Point> outline = sharp ? std::vector<Point>() : outline_of(iris);
    const Iris::Blade first = iris.blades()[0];
    const double start = std::atan2(first.normal_v, first.normal_u);
    for (int i = 0; i < count; ++i) {
        const double angle = start + 2 * kPi * i / count;
        Line line = {std::cos(angle), std::sin(angle), iris.apothem()};
        if (!sharp) line.distance = 0;
        for (const Point& point : outline) {
            line.distance =
                std::max(line.distance, line.normal_u * point.u + line.normal_v * point.v);
        }
        lines_.push_back(line);
    }
    const double scale = std::sqrt(kPi / area_of(lines_));
    for (Line& line : lines_) line.distance *= scale;
    edges_.count = count;
    turn_to(1, 0);
}

void IrisChords::turn_to(double along_u, double along_v) noexcept {
    edges_.upper = 0;
    int lower = edges_.count;
    low_ = HUGE_VAL;
    high_ = -HUGE_VAL;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const Line& line = lines_[i];
        const double along = line.normal_u * along_u + line.normal_v * along_v;
        const double across = line.normal_v * along_u - line.normal_u * along_v;
        // Lines across the chords are tilted by a little.
        constexpr double kLeastTilt = 1e-4;
        const double tilt = std::copysign(std::max(std::abs(across), kLeastTilt), across);
        const int at = tilt > 0 ? edges_.upper++ : --lower;
        edges_.slope[at] = static_cast<float>(-along / tilt);
        edges_.offset[at] = static_cast<float>(line.distance / tilt);
        const Point end = corner(line, lines_[(i + 1) % lines_.size()]);
        low_ = std::min(low_, end.u * along_u + end.v * along_v);
        high_ = std::max(high_, end.u * along_u + end.v * along_v);
    }
}

OpenChords IrisChords::open(std::span<const LineClip> clips) const noexcept {
    ChordClip discs[MatrixGhost::kMaxClips];
    ChordClip irises[MatrixGhost::kMaxClips];
    std::size_t disc_count = 0;
    std::size_t iris_count = 0;
    double low = low_;
    double high = high_;
    for (const LineClip& clip : clips) {
        ChordClip to = {0, 0, static_cast<float>(clip.center), static_cast<float>(clip.radius)};
        double from = clip.center - clip.radius;
        double end = clip.center + clip.radius;
        if (clip.iris) {
            from = clip.center + clip.radius * (clip.radius > 0 ? low_ : high_);
            end = clip.center + clip.radius * (clip.radius > 0 ? high_ : low_);
            irises[iris_count++] = to;
        } else {
            to.low = static_cast<float>(from);
            to.high = static_cast<float>(end);
            discs[disc_count++] = to;
        }
        low = std::max(low, from);
        high = std::min(high, end);
    }
    OpenChords open;
    if (!(low < high)) return open;
    ChordRange range = {static_cast<float>(0.5 * (low + high)),
                        static_cast<float>(0.5 * (high - low))};
    const auto look = [&] {
        return sum_chords(edges_, nodes_, range, {discs, disc_count}, {irises, iris_count});
    };
    ChordSums sums = look();
    // Where corners lie outside discs many chords may be empty: a second look at the others.
    constexpr int kLeastOpen = kChords * 3 / 4;
    if (sums.first <= sums.last && sums.last - sums.first + 1 < kLeastOpen) {
        const float from = sums.first > 0 ? nodes_.position[sums.first - 1] : -1;
        const float to = sums.last + 1 < kChords ? nodes_.position[sums.last + 1] : 1;
        range = {range.middle + range.half * 0.5F * (from + to), range.half * 0.5F * (to - from)};
        sums = look();
    }
    open.area = static_cast<double>(sums.area);
    if (open.area > 0) {
        open.middle_along = static_cast<double>(sums.along) / open.area;
        open.middle_across = static_cast<double>(sums.across) / open.area;
    }
    return open;
}

}  // namespace aureole::lens
