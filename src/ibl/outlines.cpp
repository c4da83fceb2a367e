#include "ibl/outlines.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::ibl {
namespace {

// What cubic interpolation is right for to some 1e-5 of a texel: the length of a border, its turn
// of longitude, and its length over the distance from a pole.
constexpr double kShort = 0.07;
constexpr double kSmallTurn_rad = 0.03;
constexpr double kNear = 0.2;
// Closer to the axis than this there is no longitude.
constexpr double kPole = 1e-24;
// Half the columns between two points of a piece below which one in the middle does.
constexpr double kUpright = 0.1;
// Nodes of the rule of Gauss and Legendre for two points on [0, 1].
constexpr double kGauss = 0.21132486540518712;

// The cubic polynomial with given values and slopes at 0 and 1.
struct Cubic {
    Cubic(double from, double to, double slope_from, double slope_to)
        : start(from), step(to - from), bend_a(slope_from - step), bend_b(step - slope_to) {}
    double value(double t) const {
        const double u = 1 - t;
        return start + t * (step + u * (u * bend_a + t * bend_b));
    }
    double slope(double t) const {
        const double u = 1 - t;
        return step + u * (u - 2 * t) * bend_a + t * (2 * u - t) * bend_b;
    }
    double start;
    double step;
    double bend_a;
    double bend_b;
};

// Where a monotonic cubic takes a value that it takes between t0 and 1; how exactly, decides only
// about the column of a piece.
double solve(const Cubic& cubic, double value, double t0) {
    const double bend = 0.5 * (cubic.bend_a + cubic.bend_b);
    double t = (value - cubic.start) / cubic.step;
    if (std::abs(bend) > 0.05 * std::abs(cubic.step)) {
        // By the parabola start + t (step + bend) - t^2 bend first: slopes may vanish at an end.
        const double b = cubic.step + bend;
        const double root = std::sqrt(std::max(0.0, b * b - 4 * bend * (value - cubic.start)));
        const double sum = b + std::copysign(root, b);
        const double near = sum != 0 ? 2 * (value - cubic.start) / sum : 0;
        const double far = sum / (2 * bend);
        t = near >= t0 && near <= 1 ? near : far;
        t = std::clamp(t, t0, 1.0);
    }
    for (int i = 0; i < 2; ++i) {
        const double slope = cubic.slope(t);
        if (std::abs(slope) < 1e-3 * std::abs(cubic.step)) break;
        t -= (cubic.value(t) - value) / slope;
    }
    return std::clamp(t, t0, 1.0);
}

double angle_rad(const Direction& a, const Direction& b) {
    return std::acos(std::clamp(dot(a, b), -1.0, 1.0));
}

// `value` plus the multiple of `period` that brings it closest to `target`.
double nearest_turn(double value, double target, double period) {
    return value + period * std::round((target - value) / period);
}

}  // namespace

bool BlockBounds::polar() const {
    const double from_pole_rad = std::acos(std::clamp(std::abs(centre.y), 0.0, 1.0));
    return from_pole_rad < radius_rad + 1e-6;
}

BlockBounds bounds_of(const Tile& block, int size, const LatLongGrid& grid,
                      const Rotation& rotation) {
    const auto place = [&](double x, double y) {
        return rotation.undo(direction_of({block.face, 2 * x / size - 1, 2 * y / size - 1}));
    };
    BlockBounds bounds;
    bounds.centre = place(block.x + 0.5 * block.width, block.y + 0.5 * block.height);
    for (int corner = 0; corner < 4; ++corner) {
        const Direction d =
            place(block.x + (corner % 2) * block.width, block.y + (corner / 2) * block.height);
        bounds.radius_rad = std::max(bounds.radius_rad, angle_rad(bounds.centre, d));
    }
    const double latitude = std::asin(std::clamp(bounds.centre.y, -1.0, 1.0));
    const auto strip_at = [&](double angle) {
        return grid.strip(std::sin(std::clamp(angle, -kPi / 2, kPi / 2)));
    };
    bounds.first_strip = strip_at(latitude + bounds.radius_rad);
    bounds.end_strip = strip_at(latitude - bounds.radius_rad) + 1;
    return bounds;
}

void Outlines::trace(const Tile& block, int size, int first_strip, int end_strip) {
    first_strip_ = first_strip;
    end_strip_ = end_strip;
    points_.clear();
    runs_.clear();
    vertices_.clear();
    for (int y = block.y; y <= block.y + block.height; ++y) {
        for (int x = block.x; x <= block.x + block.width; ++x) {
            vertices_.push_back(vertex(rotation_.undo(
                direction_of({block.face, 2.0 * x / size - 1, 2.0 * y / size - 1}))));
        }
    }
    const BlockBounds bounds = bounds_of(block, size, grid_, rotation_);
    if (bounds.polar()) {
        trace_cells(block, 2.0 / size);
        return;
    }
    // Without a pole inside, a block spans less than half a turn: one branch of the longitude.
    const double middle = grid_.column(bounds.centre.x, bounds.centre.z);
    for (Vertex& v : vertices_) v.column = nearest_turn(v.column, middle, grid_.width);
    trace_borders(block, 2.0 / size);
}

Outlines::Vertex Outlines::vertex(const Direction& unit) const {
    const double radius2 = unit.x * unit.x + unit.z * unit.z;
    return {unit, radius2 > kPole ? 1 / radius2 : 0, grid_.column(unit.x, unit.z),
            grid_.strip(unit.y)};
}

// Every border once, for the cells on both its sides.
void Outlines::trace_borders(const Tile& block, double edge) {
    const int stride = block.width + 1;
    const auto cell = [&](int x, int y) {
        return x >= 0 && y >= 0 && x < block.width && y < block.height ? y * block.width + x : -1;
    };
    for (int y = 0; y <= block.height; ++y) {
        for (int x = 0; x <= block.width; ++x) {
            const Vertex* v = &vertices_[static_cast<std::size_t>(y * stride + x)];
            if (x < block.width) add_border(v[0], v[1], edge, cell(x, y), cell(x, y - 1));
            if (y < block.height) add_border(v[0], v[stride], edge, cell(x - 1, y), cell(x, y));
        }
    }
}

void Outlines::add_border(const Vertex& a, const Vertex& b, double edge, int plus, int minus) {
    const int first = static_cast<int>(points_.size());
    divide(a, b, edge);
    for (std::size_t i = 1; i < divided_.size(); ++i) add_arc(divided_[i - 1], divided_[i], 1);
    const int end = static_cast<int>(points_.size());
    if (end > first) runs_.push_back({first, end, plus, minus});
}

// A border in parts that are short and turn little, with columns that go on from a's.
void Outlines::divide(const Vertex& a, const Vertex& b, double edge) {
    divided_.clear();
    // Longitude turns fast near a pole, and jumps at it.
    const double change = std::abs(nearest_turn(a.column - b.column, 0, grid_.width));
    const double turn_rad = change * (2 * kPi / grid_.width);
    const double reach2 = edge * edge * std::max(a.per_radius2, b.per_radius2);
    const bool at_pole = a.per_radius2 == 0 || b.per_radius2 == 0;
    if (edge <= kShort && turn_rad <= kSmallTurn_rad && reach2 <= kNear * kNear && !at_pole) {
        divided_.push_back(a);
        divided_.push_back(b);
        divided_[1].column = nearest_turn(b.column, a.column, grid_.width);
        return;
    }
    const double count =
        std::ceil(std::max({1.0, edge / 0.05, turn_rad / kSmallTurn_rad, 100 * turn_rad * turn_rad,
                            std::min(100.0, 2 * std::sqrt(reach2) / kNear)}));
    for (double i = 0; i <= count; ++i) {
        const double u = (count - i) / count;
        const double t = i / count;
        const Direction& p = a.direction;
        const Direction& q = b.direction;
        divided_.push_back(
            vertex(normalized({u * p.x + t * q.x, u * p.y + t * q.y, u * p.z + t * q.z})));
    }
    const auto last = divided_.size() - 1;
    // A border that ends at a pole is part of a meridian.
    if (divided_[0].per_radius2 == 0) divided_[0].column = divided_[1].column;
    if (divided_[last].per_radius2 == 0) divided_[last].column = divided_[last - 1].column;
    divided_[0].column = nearest_turn(divided_[0].column, a.column, grid_.width);
    for (std::size_t i = 1; i <= last; ++i) {
        divided_[i].column = nearest_turn(divided_[i].column, divided_[i - 1].column, grid_.width);
    }
}

// A short part of a great circle. mu has at most one extremum on it.
void Outlines::add_arc(const Vertex& a, const Vertex& b, double sign) {
    const Direction& p = a.direction;
    const Direction& q = b.direction;
    const Direction along = {q.x - p.x, q.y - p.y, q.z - p.z};
    const double at_a = along.y - p.y * dot(p, along);
    const double at_b = along.y - q.y * dot(q, along);
    if (at_a * at_b >= 0) {
        add_monotonic(a, b, along, sign);
        return;
    }
    // With p + t along, d(mu)/dt is proportional to at_a + t bend: the squares of t cancel.
    const double bend = along.y * dot(p, along) - p.y * dot(along, along);
    const double t = std::clamp(-at_a / bend, 0.0, 1.0);
    Vertex top = vertex(normalized({p.x + t * along.x, p.y + t * along.y, p.z + t * along.z}));
    top.column = nearest_turn(top.column, a.column, grid_.width);
    const Direction& m = top.direction;
    add_monotonic(a, top, {m.x - p.x, m.y - p.y, m.z - p.z}, sign);
    add_monotonic(top, b, {q.x - m.x, q.y - m.y, q.z - m.z}, sign);
}

// mu rises or falls throughout. In each strip, a point or two.
void Outlines::add_monotonic(const Vertex& a, const Vertex& b, const Direction& along,
                             double sign) {
    const double last_mu = b.direction.y;
    if (a.direction.y == last_mu) return;
    const auto mu_slope = [&](const Direction& d) { return along.y - d.y * dot(d, along); };
    const auto column_slope = [&](const Vertex& v) {
        return grid_.width / (2 * kPi) * v.per_radius2 *
               (v.direction.x * along.z - v.direction.z * along.x);
    };
    const Cubic mu(a.direction.y, last_mu, mu_slope(a.direction), mu_slope(b.direction));
    const Cubic column(a.column, b.column, column_slope(a), column_slope(b));
    const double leftmost = std::min(a.column, b.column);
    const double rightmost = std::max(a.column, b.column);
    const bool falls = last_mu < mu.start;
    int r = a.strip;
    double t0 = 0;
    double mu0 = mu.start;
    while (true) {
        const double border = grid_.node_mu[static_cast<std::size_t>(falls ? r + 1 : r)];
        const bool last = falls ? border <= last_mu : border >= last_mu;
        const double mu1 = last ? last_mu : border;
        const double t1 = last ? 1 : solve(mu, mu1, t0);
        if (r >= first_strip_ && r < end_strip_) {
            // The mean of the column over mu.
            const double ta = t0 + kGauss * (t1 - t0);
            const double tb = t1 - kGauss * (t1 - t0);
            const double slope_a = std::abs(mu.slope(ta));
            const double slope_b = std::abs(mu.slope(tb));
            const double slopes = slope_a + slope_b;
            const double column_a = column.value(ta);
            const double column_b = column.value(tb);
            const double mean = slopes > 0 ? (slope_a * column_a + slope_b * column_b) / slopes
                                           : 0.5 * (column_a + column_b);
            const double middle = std::clamp(mean, leftmost, rightmost);
            const double half = 0.5 * (column_b - column_a);
            if (std::abs(half) < kUpright) {
                push(middle, mu0, mu1, 0.5, 1, r, sign);
            } else {
                const double room = std::min(middle - leftmost, rightmost - middle);
                const double aside = std::clamp(half, -room, room);
                push(middle - aside, mu0, mu1, kGauss, 0.5, r, sign);
                push(middle + aside, mu0, mu1, 1 - kGauss, 0.5, r, sign);
            }
        }
        if (last) break;
        t0 = t1;
        mu0 = mu1;
        r += falls ? 1 : -1;
    }
}

// Every cell by itself, so that its outline is continuous even where it goes round a pole.
void Outlines::trace_cells(const Tile& block, double edge) {
    const int stride = block.width + 1;
    for (int y = 0; y < block.height; ++y) {
        for (int x = 0; x < block.width; ++x) {
            const Vertex* v = &vertices_[static_cast<std::size_t>(y * stride + x)];
            // Both cells of a border divide it in the order of the lattice, and so agree.
            const Vertex* sides[4][2] = {
                {v, v + 1}, {v + 1, v + stride + 1}, {v + stride, v + stride + 1}, {v, v + stride}};
            const int first = static_cast<int>(points_.size());
            double first_column = 0;
            double column = 0;
            for (int side = 0; side < 4; ++side) {
                const bool backwards = side >= 2;
                divide(*sides[side][0], *sides[side][1], edge);
                const double start = backwards ? divided_.back().column : divided_.front().column;
                if (side == 0) first_column = column = start;
                const double shift = nearest_turn(start, column, grid_.width) - start;
                for (Vertex& place : divided_) place.column += shift;
                for (std::size_t i = 1; i < divided_.size(); ++i) {
                    add_arc(divided_[i - 1], divided_[i], backwards ? -1 : 1);
                }
                column = backwards ? divided_.front().column : divided_.back().column;
            }
            const double closed = nearest_turn(first_column, column, grid_.width);
            const int turns = static_cast<int>(std::lround((closed - first_column) / grid_.width));
            if (turns != 0) {
                const bool north = v[0].direction.y + v[1].direction.y + v[stride].direction.y +
                                       v[stride + 1].direction.y >
                                   0;
                cut_to_pole(v[0].direction.y, first_column, north, turns);
            }
            const int end = static_cast<int>(points_.size());
            if (end > first) runs_.push_back({first, end, y * block.width + x, -1});
        }
    }
}

// An outline round a pole is cut open at its first vertex, and goes to the pole and back: what
// differs between the two ways is the sum of the whole row. `turns`: of the column, by which the
// outline does not close.
void Outlines::cut_to_pole(double mu, double column, bool north, int turns) {
    for (int r = first_strip_; r < end_strip_; ++r) {
        const double upper = grid_.node_mu[static_cast<std::size_t>(r)];
        const double lower = grid_.node_mu[static_cast<std::size_t>(r) + 1];
        const double low = north ? std::max(mu, lower) : lower;
        const double high = north ? upper : std::min(mu, upper);
        if (low >= high) continue;
        const double from = north ? low : high;
        const double to = north ? high : low;
        push(column + grid_.width, from, to, 0.5, 1, r, turns);
        push(column, from, to, 0.5, 1, r, -turns);
    }
}

void Outlines::push(double column, double mu0, double mu1, double place, double share, int r,
                    double sign) {
    const auto i = static_cast<std::size_t>(r);
    const double mu = mu0 + place * (mu1 - mu0);
    points_.push_back(
        {column, sign * share * (mu1 - mu0), (grid_.node_mu[i] - mu) * grid_.per_strip[i], r});
}

}  // namespace aureole::ibl
