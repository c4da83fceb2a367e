#include "lens/matrix_kernels.h"

#include <algorithm>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/matrix_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
// At most 16 lanes, which CanvasLevel::kPadding makes room for.
using D = hn::CappedTag<float, 16>;
using Vec = hn::Vec<D>;

Vec clamp_to_unit(Vec v) {
    const D d;
    return hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, 1));
}

Vec straight_distance(const OutlineEdge& edge, Vec x, float y) {
    const D d;
    return hn::MulAdd(hn::Set(d, edge.a), x, hn::Set(d, edge.b * y + edge.c));
}

Vec round_distance(const OutlineEdge& edge, bool stretched, Vec x, float y) {
    const D d;
    const Vec across = hn::Mul(hn::Sub(x, hn::Set(d, edge.a)), hn::Set(d, edge.c));
    const float down = (y - edge.b) * edge.d;
    const Vec q2 = hn::MulAdd(across, across, hn::Set(d, down * down));
    const Vec beyond = hn::Sub(hn::Sqrt(q2), hn::Set(d, 1));
    if (!stretched) return hn::Mul(beyond, hn::Set(d, 1 / std::abs(edge.c)));
    // |gradient|^2 = (across^2 c^2 + down^2 d^2) / q^2; c^2 in the centre.
    const Vec c2 = hn::Set(d, edge.c * edge.c);
    const Vec tiny = hn::Set(d, 1e-12F);
    const Vec slope2 =
        hn::MulAdd(hn::MulAdd(across, across, tiny), c2, hn::Set(d, down * down * edge.d * edge.d));
    return hn::Mul(beyond, hn::Sqrt(hn::Div(hn::Add(q2, tiny), slope2)));
}

// The polynomial smooth maximum of a >= b (Iris::distance).
Vec smooth_maximum(Vec a, Vec b, float k) {
    const D d;
    const Vec apart = hn::Sub(a, b);
    const Vec half = hn::Set(d, 0.5F);
    const Vec h = hn::Min(hn::MulAdd(apart, hn::Set(d, 0.5F / k), half), hn::Set(d, 1));
    return hn::MulAdd(h, hn::MulAdd(hn::Set(d, k), hn::Sub(hn::Set(d, 1), h), apart), b);
}

Vec coverage_of(const MatrixDrawing& drawing, const OutlinePart& part, Vec x, float y) {
    const D d;
    Vec first = hn::Set(d, -1e30F);
    Vec second = first;
    for (int e = part.first; e < part.first + part.count; ++e) {
        const OutlineEdge& edge = drawing.edges[e];
        const Vec distance = part.straight ? straight_distance(edge, x, y)
                                           : round_distance(edge, part.stretched, x, y);
        second = hn::Max(second, hn::Min(first, distance));
        first = hn::Max(first, distance);
    }
    if (part.smoothing > 0) first = smooth_maximum(first, second, part.smoothing);
    const float slope = -0.5F / part.half_width;
    return clamp_to_unit(
        hn::MulAdd(first, hn::Set(d, slope), hn::Set(d, 0.5F + slope * part.shift)));
}

Vec spot_coverage(const MatrixDrawing& drawing, Vec x, float y) {
    const D d;
    const Vec dx = hn::Sub(x, hn::Set(d, drawing.spot_x));
    const float dy = y - drawing.spot_y;
    const Vec q = hn::MulAdd(
        hn::MulAdd(hn::Set(d, drawing.spot_xx), dx, hn::Set(d, 2 * drawing.spot_xy * dy)), dx,
        hn::Set(d, drawing.spot_yy * dy * dy));
    const Vec inside = clamp_to_unit(hn::Sub(hn::Set(d, 1), q));
    return hn::Mul(inside, inside);
}

Vec coverage(const MatrixDrawing& drawing, int x, int y) {
    const D d;
    const Vec position = hn::Iota(d, static_cast<float>(x));
    const auto row = static_cast<float>(y);
    if (drawing.part_count == 0) return spot_coverage(drawing, position, row);
    Vec least = coverage_of(drawing, drawing.parts[0], position, row);
    for (int p = 1; p < drawing.part_count; ++p) {
        least = hn::Min(least, coverage_of(drawing, drawing.parts[p], position, row));
    }
    return least;
}

// A row of the level as its three planes.
struct Row {
    float* planes[3];
};

// Adds pixels [begin, end) by their coverage.
void add_edge(const MatrixDrawing& drawing, const Row& row, int y, int begin, int end) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int x = begin; x < end; x += lanes) {
        Vec share = coverage(drawing, x, y);
        if (end - x < lanes) {
            const auto inside = hn::FirstN(d, static_cast<std::size_t>(end - x));
            share = hn::IfThenElseZero(inside, share);
        }
        for (int p = 0; p < 3; ++p) {
            float* to = row.planes[p] + x;
            hn::StoreU(hn::MulAdd(share, hn::Set(d, drawing.rgb[p]), hn::LoadU(d, to)), d, to);
        }
    }
}

// Adds a constant to pixels [begin, end).
void add_whole(const double* sum, const Row& row, int begin, int end) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int p = 0; p < 3; ++p) {
        float* to = row.planes[p];
        const Vec value = hn::Set(d, static_cast<float>(sum[p]));
        int x = begin;
        for (; x + lanes <= end; x += lanes) {
            hn::StoreU(hn::Add(hn::LoadU(d, to + x), value), d, to + x);
        }
        if (x < end) {
            const auto inside = hn::FirstN(d, static_cast<std::size_t>(end - x));
            hn::StoreU(hn::Add(hn::LoadU(d, to + x), hn::IfThenElseZero(inside, value)), d, to + x);
        }
    }
}

// The rim of one row, and notes its inside.
void draw_row(const MatrixDrawing& drawing, const RowChords& chords, const Row& row, int y,
              InsideChanges& changes) {
    const int lanes = static_cast<int>(hn::Lanes(D()));
    const RowSpan any = chords.any;
    // The left rim in whole vectors, which may reach into the inside.
    const int left = any.begin + (chords.whole.begin - any.begin + lanes - 1) / lanes * lanes;
    if (chords.whole.empty() || left >= chords.whole.end) {
        return add_edge(drawing, row, y, any.begin, any.end);
    }
    add_edge(drawing, row, y, any.begin, left);
    changes.add({left, chords.whole.end}, drawing.rgb);
    add_edge(drawing, row, y, chords.whole.end, any.end);
}

void draw_rows(std::span<const MatrixDrawing* const> drawings, const CanvasLevel& level, int begin,
               int end, InsideChanges& changes) {
    for (int y = begin; y < end; ++y) {
        Row row;
        for (int p = 0; p < 3; ++p) row.planes[p] = level.planes[p] + y * level.stride;
        for (const MatrixDrawing* drawing : drawings) {
            if (y < drawing->row_begin || y >= drawing->row_end) continue;
            const RowChords chords =
                row_chords(*drawing, y, -level.margin, level.width + level.margin);
            if (chords.any.empty()) continue;
            level.mark_used(y, chords.any.begin, chords.any.end);
            draw_row(*drawing, chords, row, y, changes);
        }
        changes.take(
            [&](int first, int last, const double* sum) { add_whole(sum, row, first, last); });
    }
}

void coverage_row(const MatrixDrawing& drawing, int y, int x, int count, float* to) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int i = 0; i < count; i += lanes) hn::StoreU(coverage(drawing, x + i, y), d, to + i);
}

}  // namespace

MatrixKernels make_matrix_kernels() { return {&draw_rows, &coverage_row}; }

}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(make_matrix_kernels);
MatrixKernels matrix_kernels() { return HWY_DYNAMIC_DISPATCH(make_matrix_kernels)(); }
}  // namespace aureole::lens
#endif
