#include "lens/matrix_outline.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::lens {
namespace {

// Spots have at least the second moment of a pixel and its interpolation, so that they move
// smoothly from pixel to pixel.
constexpr double kLeastSpotMoment = 0.35;
// Ghosts whose open part is smaller than this, in pixels of their level, are spots.
constexpr double kLeastOutlineRadius = 0.75;

// An aperture's own coordinates: w = (i - center) * scale.
struct Frame {
    double center_x, center_y;
    double scale_x, scale_y;
    double mean_scale() const { return std::sqrt(std::abs(scale_x * scale_y)); }
};

class OutlineBuilder {
  public:
    OutlineBuilder(OutlinePart* parts, OutlineEdge* edges) : parts_(parts), edges_(edges) {}

    void add_disc(const Frame& frame, double radius, double soft_px) {
        OutlinePart& part = begin(false, soft_px, frame.mean_scale() / radius);
        part.stretched = std::abs(frame.scale_x) != std::abs(frame.scale_y);
        add_edge({static_cast<float>(frame.center_x), static_cast<float>(frame.center_y),
                  static_cast<float>(frame.scale_x / radius),
                  static_cast<float>(frame.scale_y / radius)});
        end(part);
    }

    void add_iris(const Frame& frame, const Iris& iris, double soft_px) {
        if (iris.shape().blades == 0) return add_disc(frame, 1, soft_px);
        const bool straight = iris.blade_radius() == 0;
        OutlinePart& part = begin(straight, soft_px, frame.mean_scale() / iris.apothem());
        part.stretched = std::abs(frame.scale_x) != std::abs(frame.scale_y);
        part.smoothing = static_cast<float>(iris.shape().smoothing / frame.mean_scale());
        const double back = iris.blade_radius() - iris.apothem();
        for (int b = 0; b < iris.shape().blades; ++b) {
            const double nu = static_cast<double>(iris.blades()[b].normal_u);
            const double nv = static_cast<double>(iris.blades()[b].normal_v);
            if (straight) {
                const double gradient = std::hypot(nu * frame.scale_x, nv * frame.scale_y);
                const double a = nu * frame.scale_x / gradient;
                const double b_y = nv * frame.scale_y / gradient;
                const double per_a = std::abs(a) < 1e-6 ? 0 : 1 / a;
                add_edge({static_cast<float>(a), static_cast<float>(b_y),
                          static_cast<float>(-iris.apothem() / gradient - a * frame.center_x -
                                             b_y * frame.center_y),
                          static_cast<float>(per_a)});
            } else {
                add_edge({static_cast<float>(frame.center_x - back * nu / frame.scale_x),
                          static_cast<float>(frame.center_y - back * nv / frame.scale_y),
                          static_cast<float>(frame.scale_x / iris.blade_radius()),
                          static_cast<float>(frame.scale_y / iris.blade_radius())});
            }
        }
        end(part);
    }

    int part_count() const { return part_count_; }

  private:
    OutlinePart& begin(bool straight, double soft_px, double per_radius) {
        OutlinePart& part = parts_[part_count_++];
        part = {};
        part.first = edge_count_;
        part.straight = straight;
        const double half_width = std::sqrt(0.25 + soft_px * soft_px);
        part.half_width = static_cast<float>(half_width);
        part.shift = static_cast<float>(
            std::min(half_width * half_width * per_radius / 6, 0.5 * half_width));
        return part;
    }
    void add_edge(const OutlineEdge& edge) { edges_[edge_count_++] = edge; }
    void end(OutlinePart& part) const { part.count = edge_count_ - part.first; }

    OutlinePart* parts_;
    OutlineEdge* edges_;
    int part_count_ = 0;
    int edge_count_ = 0;
};

// Whole rows in [low, high].
void set_rows(MatrixDrawing& drawing, double low, double high) {
    constexpr double kFar = 1e8;
    drawing.row_begin = static_cast<int>(std::clamp(std::ceil(low), -kFar, kFar));
    drawing.row_end = static_cast<int>(std::clamp(std::floor(high) + 1, -kFar, kFar));
}

void make_spot(MatrixDrawing& drawing, const MatrixGhost& ghost, double scale) {
    const double own = static_cast<double>(ghost.open_radius_px * ghost.open_radius_px) / 4;
    const double to_level = 1 / (scale * scale);
    const double xx = std::max((ghost.spot ? static_cast<double>(ghost.spot_xx) : own) * to_level,
                               kLeastSpotMoment);
    const double yy = std::max((ghost.spot ? static_cast<double>(ghost.spot_yy) : own) * to_level,
                               kLeastSpotMoment);
    const double limit = 0.98 * std::sqrt(xx * yy);
    const double xy =
        ghost.spot ? std::clamp(static_cast<double>(ghost.spot_xy) * to_level, -limit, limit) : 0;
    // (1 - q)^2 over q < 1 has an eighth of the squared radius as second moment.
    const double determinant = 8 * (xx * yy - xy * xy);
    drawing.spot_xx = static_cast<float>(yy / determinant);
    drawing.spot_xy = static_cast<float>(-xy / determinant);
    drawing.spot_yy = static_cast<float>(xx / determinant);
    drawing.spot_x = static_cast<float>(static_cast<double>(ghost.open_x) / scale - 0.5);
    drawing.spot_y = static_cast<float>(static_cast<double>(ghost.open_y) / scale - 0.5);
    const double reach = std::sqrt(8 * yy);
    const double y = static_cast<double>(drawing.spot_y);
    set_rows(drawing, y - reach, y + reach);
}

}  // namespace

int max_outline_edges(const Iris& iris) {
    return 3 * std::max(1, iris.shape().blades) + MatrixGhost::kMaxClips;
}

MatrixDrawing outline(const MatrixGhost& ghost, const Pupil& pupil, const Entrance& entrance,
                      int level, OutlinePart* parts, OutlineEdge* edges) noexcept {
    const double scale = 1 << level;
    MatrixDrawing drawing;
    drawing.level = level;
    drawing.ghost = &ghost;
    if (ghost.u_per_px == 0 || ghost.v_per_px == 0) return drawing;
    if (ghost.spot || static_cast<double>(ghost.open_radius_px) < kLeastOutlineRadius * scale) {
        make_spot(drawing, ghost, scale);
        return drawing;
    }
    const Iris& iris = *pupil.iris;
    const Frame frame = {static_cast<double>(ghost.center_x) / scale - 0.5,
                         static_cast<double>(ghost.center_y) / scale - 0.5,
                         static_cast<double>(ghost.u_per_px) * scale,
                         static_cast<double>(ghost.v_per_px) * scale};
    drawing.x0 = static_cast<float>(frame.center_x);
    drawing.y0 = static_cast<float>(frame.center_y);
    drawing.du = static_cast<float>(frame.scale_x);
    drawing.dv = static_cast<float>(frame.scale_y);
    drawing.entrance = entrance;
    if (pupil.has_pictures()) drawing.pupil = &pupil;

    OutlineBuilder builder(parts, edges);
    double low = -1e9;
    double high = 1e9;
    const auto reach_to = [&](const Frame& of, double radius) {
        const double half = radius / std::abs(of.scale_y) +
                            static_cast<double>(parts[builder.part_count() - 1].half_width);
        low = std::max(low, of.center_y - half);
        high = std::min(high, of.center_y + half);
    };
    const double soft_px = static_cast<double>(ghost.edge) / frame.mean_scale();
    const double pixel = frame.mean_scale();  // in iris units
    if (pupil.texture != nullptr || iris.is_image()) {
        // The picture ends by itself; the disc only tells where to stop.
        const double outer = static_cast<double>(pupil.outer_radius(static_cast<float>(pixel)));
        builder.add_disc(frame, outer, 0);
        reach_to(frame, outer);
    } else {
        builder.add_iris(frame, iris, soft_px);
        reach_to(frame, iris.outer_radius());
    }
    for (int k = 0; k < ghost.clip_count; ++k) {
        const MatrixGhost::Clip& clip = ghost.clips[k];
        const Frame own = {frame.center_x + static_cast<double>(clip.u0) / frame.scale_x,
                           frame.center_y + static_cast<double>(clip.v0) / frame.scale_y,
                           frame.scale_x / static_cast<double>(clip.ru),
                           frame.scale_y / static_cast<double>(clip.rv)};
        const double soft = static_cast<double>(clip.edge) / own.mean_scale();
        if (clip.iris && iris.is_image()) {
            const double outer = iris.outer_radius() + 4 * own.mean_scale();
            builder.add_disc(own, outer, 0);
            reach_to(own, outer);
        } else if (clip.iris) {
            builder.add_iris(own, iris, soft);
            reach_to(own, iris.outer_radius());
        } else {
            builder.add_disc(own, 1, soft);
            reach_to(own, 1);
        }
    }
    drawing.parts = parts;
    drawing.part_count = builder.part_count();
    drawing.edges = edges;
    set_rows(drawing, low, high);
    return drawing;
}

namespace {

// Positions x of a row in [low, high], as floats until the end.
struct Chord {
    float low;
    float high;
    void cut(float from, float to) {
        low = std::max(low, from);
        high = std::min(high, to);
    }
    void clear() { high = low - 1; }
    // Pixels whose centres lie inside.
    RowSpan pixels(int begin, int end) const {
        const float from = std::max(std::ceil(low), static_cast<float>(begin));
        const float to = std::min(std::floor(high) + 1, static_cast<float>(end));
        return from < to ? RowSpan{static_cast<int>(from), static_cast<int>(to)} : RowSpan{};
    }
};

// Where a straight edge's distance is at most `outside`, and at most `inside`.
void cut_straight(Chord& any, Chord& whole, const OutlineEdge& edge, float y, float outside,
                  float inside) {
    const float room = outside - edge.c - edge.b * y;
    const float margin = outside - inside;
    if (edge.d == 0) {
        if (room < 0) any.clear();
        if (room < margin) whole.clear();
    } else if (edge.d > 0) {
        any.high = std::min(any.high, room * edge.d);
        whole.high = std::min(whole.high, (room - margin) * edge.d);
    } else {
        any.low = std::max(any.low, room * edge.d);
        whole.low = std::max(whole.low, (room - margin) * edge.d);
    }
}

// Where a round edge's distance is at most this; of a stretched one, inside of it or outside
// (`distance` below or above 0) by more than asked, since the gradient is taken at its largest.
void cut_round(Chord& chord, const OutlineEdge& edge, float y, float distance) {
    const float q = 1 + distance * std::max(std::abs(edge.c), std::abs(edge.d));
    const float across = (y - edge.b) * edge.d;
    const float room = q * q - across * across;
    if (q <= 0 || room <= 0) return chord.clear();
    const float half = std::sqrt(room) / std::abs(edge.c);
    chord.cut(edge.a - half, edge.a + half);
}

RowChords spot_chords(const MatrixDrawing& drawing, float y, int begin, int end) {
    const float dy = y - drawing.spot_y;
    const float middle = -drawing.spot_xy * dy / drawing.spot_xx;
    const float room = (1 - drawing.spot_yy * dy * dy) / drawing.spot_xx + middle * middle;
    if (room <= 0) return {};
    const float half = std::sqrt(room);
    const Chord chord = {drawing.spot_x + middle - half, drawing.spot_x + middle + half};
    return {chord.pixels(begin, end), {}};
}

}  // namespace

RowChords row_chords(const MatrixDrawing& drawing, int y, int begin, int end) noexcept {
    const auto row = static_cast<float>(y);
    if (drawing.part_count == 0) return spot_chords(drawing, row, begin, end);
    // Rounding of positions up to 4096.
    constexpr float kSlack = 0.01F;
    Chord any = {static_cast<float>(begin) - 1, static_cast<float>(end) + 1};
    Chord whole = any;
    for (int p = 0; p < drawing.part_count; ++p) {
        const OutlinePart& part = drawing.parts[p];
        const float outside = part.half_width - part.shift + kSlack;
        // The smooth maximum adds up to k / 4.
        const float inside = -part.half_width - part.shift - 0.25F * part.smoothing - kSlack;
        for (int e = part.first; e < part.first + part.count; ++e) {
            const OutlineEdge& edge = drawing.edges[e];
            if (part.straight) {
                cut_straight(any, whole, edge, row, outside, inside);
            } else {
                cut_round(any, edge, row, outside);
                cut_round(whole, edge, row, inside);
            }
        }
        if (any.low > any.high) return {};
    }
    return {any.pixels(begin, end), whole.pixels(begin, end)};
}

}  // namespace aureole::lens
