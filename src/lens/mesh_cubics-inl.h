// Coordinates over cells by cubics through the rays around them. Included once per instruction set.
#if defined(AUREOLE_LENS_MESH_CUBICS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_LENS_MESH_CUBICS_INL_H_
#undef AUREOLE_LENS_MESH_CUBICS_INL_H_
#else
#define AUREOLE_LENS_MESH_CUBICS_INL_H_
#endif

#include "lens/mesh_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

// A coordinate over the cells of a group by powers of the place (i, j) in the cell, from the cubics
// of Catmull and Rom in both directions.
struct GroupCubics {
    HWY_ALIGN float base[kGroup];
    HWY_ALIGN float power[4][4][kGroup];  // of j, of i, by cell; without base
    // The derivative by j at i = 0 and i = 1, by powers of j.
    HWY_ALIGN float left[3][kGroup];
    HWY_ALIGN float right[3][kGroup];

    // `field` at the first vertex of the first cell.
    GroupCubics(const float* field, std::ptrdiff_t stride) {
        const D d;
        for (int cell = 0; cell < kGroup; cell += kLanes) {
            const float* at = field + cell;
            const V origin = load(at);
            hn::Store(origin, d, base + cell);
            V columns[4][4];
            for (int k = 0; k < 4; ++k) {
                V values[4];
                for (int m = 0; m < 4; ++m) {
                    values[m] = hn::Sub(load(at + (m - 1) * stride + k - 1), origin);
                }
                powers_of(values, columns[k]);
            }
            for (int j = 0; j < 4; ++j) {
                const V values[4] = {columns[0][j], columns[1][j], columns[2][j], columns[3][j]};
                V powers[4];
                powers_of(values, powers);
                for (int i = 0; i < 4; ++i) hn::Store(powers[i], d, power[j][i] + cell);
                if (j == 0) continue;
                const V times = set(static_cast<float>(j));
                hn::Store(hn::Mul(times, values[1]), d, left[j - 1] + cell);
                hn::Store(hn::Mul(times, values[2]), d, right[j - 1] + cell);
            }
        }
    }

  private:
    // Of the cubic between the middle two of four values.
    static HWY_INLINE void powers_of(const V values[4], V powers[4]) {
        const V half = set(0.5F);
        const V rise = hn::Sub(values[2], values[1]);
        powers[0] = values[1];
        powers[1] = hn::Mul(half, hn::Sub(values[2], values[0]));
        powers[3] = hn::NegMulAdd(set(1.5F), rise, hn::Mul(half, hn::Sub(values[3], values[0])));
        powers[2] = hn::Sub(rise, hn::Add(powers[1], powers[3]));
    }
};

// What a line of a cell at j is by powers of i.
HWY_INLINE void line_at(const GroupCubics& cubics, int cell, V j, V of_i[4]) {
    for (int i = 0; i < 4; ++i) {
        V sum = set(cubics.power[3][i][cell]);
        for (int k = 2; k >= 0; --k) sum = hn::MulAdd(sum, j, set(cubics.power[k][i][cell]));
        of_i[i] = sum;
    }
    of_i[0] = hn::Add(of_i[0], set(cubics.base[cell]));
}

// A coordinate in the middles of pieces, and its changes over a piece.
struct PiecePosition {
    V value, along, across;
    PiecePosition(const GroupCubics& cubics, int cell, V i, V j, V step_i, V step_j) {
        V of_i[4];
        line_at(cubics, cell, j, of_i);
        // Horner's rule for a polynomial and its derivative.
        V slope = of_i[3];
        V sum = hn::MulAdd(of_i[3], i, of_i[2]);
        slope = hn::MulAdd(slope, i, sum);
        sum = hn::MulAdd(sum, i, of_i[1]);
        slope = hn::MulAdd(slope, i, sum);
        value = hn::MulAdd(sum, i, of_i[0]);
        along = hn::Mul(step_i, slope);
        // Linear between both sides, which is enough for the size of a piece.
        const auto on_side = [&](const float(&powers)[3][kGroup]) {
            return hn::MulAdd(hn::MulAdd(set(powers[2][cell]), j, set(powers[1][cell])), j,
                              set(powers[0][cell]));
        };
        const V left = on_side(cubics.left);
        across = hn::Mul(step_j, hn::MulAdd(i, hn::Sub(on_side(cubics.right), left), left));
    }
};

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
