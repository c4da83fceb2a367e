// The edges of one ghost in pixels of one level of the canvas, ready for drawing.
//
// A part is an aperture: the iris at one crossing, or a housing. Its signed distance from the edge,
// in pixels and positive outside, is the maximum (the smooth one of the two largest) over its
// edges, and its coverage falls from 1 to 0 over [-half_width, half_width] of that: half a pixel to
// either side antialiases, more where a light of finite size blurs. The ghost is the least of its
// parts: where two edges run beside each other that is right, and where they cross too much by a
// twelfth of a pixel or less.
#pragma once

#include <cmath>
#include <span>

#include "lens/canvas.h"
#include "lens/matrix_ghosts.h"
#include "lens/matrix_pupil.h"

namespace aureole::lens {

// Positions are those of pixel centres: whole numbers.
struct OutlineEdge {
    // Straight: distance = a x + b y + c; d = 1 / a, or 0 if the edge runs along the rows.
    // Round: q = |((x - a) c, (y - b) d)|, distance = (q - 1) over the length of q's gradient.
    float a = 0, b = 0, c = 0, d = 0;
};

struct OutlinePart {
    int first = 0;  // edge
    int count = 0;
    bool straight = false;
    bool stretched = false;  // round edges with |c| != |d|
    float smoothing = 0;     // k of the smooth maximum, px
    float half_width = 0.5F;
    // Added to distances. A blurred disc covers more than a sharp one, by pi half_width^2 / 3, and
    // any convex shape by about as much over its perimeter; this takes it off.
    float shift = 0;
};

// Pixels of a row that are covered at all, and those among them that are covered whole.
struct RowChords {
    RowSpan any;
    RowSpan whole;
};

struct MatrixDrawing {
    int level = 0;
    float rgb[3] = {};
    int row_begin = 0, row_end = 0;
    const OutlinePart* parts = nullptr;  // none: a spot
    int part_count = 0;
    const OutlineEdge* edges = nullptr;
    // Of a spot: coverage = (1 - q)^2, q = xx dx^2 + 2 xy dx dy + yy dy^2 below 1.
    float spot_x = 0, spot_y = 0, spot_xx = 0, spot_xy = 0, spot_yy = 0;
    // Pictures in the pupil at u = (x - x0) du, v = (y - y0) dv, and in those of `clips`.
    const Pupil* pupil = nullptr;  // null: none
    Entrance entrance;
    float x0 = 0, y0 = 0, du = 0, dv = 0;
    const MatrixGhost* ghost = nullptr;
};

// What a ghost needs of room for its parts and edges.
int max_outline_edges(const Iris& iris);
inline constexpr int kMaxOutlineParts = 1 + MatrixGhost::kMaxClips;

// Makes the drawing of a placed ghost at a level, without colour. `parts` and `edges` have room for
// the numbers above. The rows are those of an endless picture.
MatrixDrawing outline(const MatrixGhost& ghost, const Pupil& pupil, const Entrance& entrance,
                      int level, OutlinePart* parts, OutlineEdge* edges) noexcept;

// Of one row, cut to pixels [begin, end).
RowChords row_chords(const MatrixDrawing& drawing, int y, int begin, int end) noexcept;

}  // namespace aureole::lens
