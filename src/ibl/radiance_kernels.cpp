#include "ibl/radiance_kernels.h"

#include "ibl/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ibl/radiance_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "ibl/texel_patch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::ibl::HWY_NAMESPACE {
namespace {

// The four leaves of a block, three channels.
struct Texels {
    alignas(16) float value[3][4];
};

RowLight make_leaves(const CubeMap& environment, int subdivision, int face, int y, int nodes,
                     RadianceBlock* row) {
    const D4 d;
    const float side = 2 / static_cast<float>(nodes);
    const FaceFrame& frame = kFaceFrames[static_cast<std::size_t>(face)];
    const int y0 = 2 * y;
    const int y1 = 2 * y + 1 < nodes ? 2 * y + 1 : y0;
    const float* rows[2][3];
    for (int c = 0; c < 3; ++c) {
        rows[0][c] = environment.row(face, y0 / subdivision, c);
        rows[1][c] = environment.row(face, y1 / subdivision, c);
    }
    const auto centre = [side](int i) { return (static_cast<float>(i) + 0.5F) * side - 1; };
    alignas(16) float s[4];
    alignas(16) const float t[4] = {centre(y0), centre(y0), centre(y0 + 1), centre(y0 + 1)};
    V4 light[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    for (int block = 0; 2 * block < nodes; ++block) {
        const int x0 = 2 * block;
        const int x1 = x0 + 1 < nodes ? x0 + 1 : x0;
        const int from0 = subdivision == 1 ? x0 : x0 / subdivision;
        const int from1 = subdivision == 1 ? x1 : x1 / subdivision;
        Texels texels;
        for (int c = 0; c < 3; ++c) {
            texels.value[c][0] = rows[0][c][from0];
            texels.value[c][1] = rows[0][c][from1];
            texels.value[c][2] = rows[1][c][from0];
            texels.value[c][3] = rows[1][c][from1];
        }
        s[0] = s[2] = centre(x0);
        s[1] = s[3] = centre(x0 + 1);
        RadianceBlock& out = row[block];
        for (int i = 0; i < 4; i += kFourLanes) {
            const Patches p = texel_patches(frame, hn::Load(d, s + i), hn::Load(d, t + i), side);
            hn::Store(p.x, d, out.x + i);
            hn::Store(p.y, d, out.y + i);
            hn::Store(p.z, d, out.z + i);
            hn::Store(p.moment, d, out.moment + i);
            hn::Store(p.solid_angle_sr, d, out.solid_angle_sr + i);
            hn::Store(hn::Mul(p.solid_angle_sr, hn::Load(d, texels.value[0] + i)), d, out.r + i);
            hn::Store(hn::Mul(p.solid_angle_sr, hn::Load(d, texels.value[1] + i)), d, out.g + i);
            hn::Store(hn::Mul(p.solid_angle_sr, hn::Load(d, texels.value[2] + i)), d, out.b + i);
        }
        for (int i = 0; i < 4; ++i) {
            if (x0 + i % 2 < nodes && y0 + i / 2 < nodes) continue;
            out.r[i] = out.g[i] = out.b[i] = out.solid_angle_sr[i] = 0;
        }
        for (int i = 0; i < 4; i += kFourLanes) {
            light[0] = hn::Add(light[0], hn::Abs(hn::Load(d, out.r + i)));
            light[1] = hn::Add(light[1], hn::Abs(hn::Load(d, out.g + i)));
            light[2] = hn::Add(light[2], hn::Abs(hn::Load(d, out.b + i)));
        }
    }
    return {hn::GetLane(hn::SumOfLanes(d, light[0])), hn::GetLane(hn::SumOfLanes(d, light[1])),
            hn::GetLane(hn::SumOfLanes(d, light[2]))};
}

// One field of the four children of each of the nodes of a block.
struct FourOfFour {
    alignas(16) float value[16];

    void set(int node, const float* children) {
        const D4 d;
        for (int i = 0; i < 4; i += kFourLanes) {
            hn::Store(hn::LoadU(d, children + i), d, value + 4 * node + i);
        }
    }
};

// A child each of several nodes.
struct FourChildren {
    V4 of[4];
};

HWY_INLINE FourChildren children_of(const FourOfFour& field, int node) {
    FourChildren c;
    hn::LoadInterleaved4(D4(), field.value + 4 * node, c.of[0], c.of[1], c.of[2], c.of[3]);
    return c;
}

HWY_INLINE V4 sum4(const FourChildren& a) {
    return hn::Add(hn::Add(a.of[0], a.of[1]), hn::Add(a.of[2], a.of[3]));
}

HWY_INLINE V4 sum4(const FourChildren& a, const FourChildren& weights) {
    const V4 first = hn::MulAdd(a.of[0], weights.of[0], hn::Mul(a.of[1], weights.of[1]));
    const V4 second = hn::MulAdd(a.of[2], weights.of[2], hn::Mul(a.of[3], weights.of[3]));
    return hn::Add(first, second);
}

HWY_INLINE FourChildren minus(const FourChildren& a, V4 b) {
    return {{hn::Sub(a.of[0], b), hn::Sub(a.of[1], b), hn::Sub(a.of[2], b), hn::Sub(a.of[3], b)}};
}

HWY_INLINE V4 square_of(V4 x, V4 y, V4 z) {
    return hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
}

// The children of a block of nodes; zero where there are none.
struct Children {
    FourOfFour x, y, z, moment, r, g, b, solid_angle_sr, dipole;
};

void join(const Children& children, const RowLight& scales, RadianceBlock& parent, float* dipoles) {
    // Black nodes need a mean direction, too; those beyond the edge are at the origin.
    constexpr float kBlack = 1e-24F;
    constexpr float kNothing = 1e-37F;
    const D4 d;
    for (int node = 0; node < 4; node += kFourLanes) {
        const FourChildren r = children_of(children.r, node);
        const FourChildren g = children_of(children.g, node);
        const FourChildren b = children_of(children.b, node);
        const FourChildren solid_angle_sr = children_of(children.solid_angle_sr, node);
        FourChildren weight;
        for (int i = 0; i < 4; ++i) {
            const V4 luminance =
                hn::MulAdd(r.of[i], set4(kLuminanceWeights[0]),
                           hn::MulAdd(g.of[i], set4(kLuminanceWeights[1]),
                                      hn::Mul(b.of[i], set4(kLuminanceWeights[2]))));
            weight.of[i] = hn::MulAdd(solid_angle_sr.of[i], set4(kBlack), hn::Abs(luminance));
        }
        const V4 share = hn::Div(set4(1), hn::Max(sum4(weight), set4(kNothing)));
        for (V4& w : weight.of) w = hn::Mul(w, share);
        FourChildren x = children_of(children.x, node);
        FourChildren y = children_of(children.y, node);
        FourChildren z = children_of(children.z, node);
        const V4 mean_x = sum4(x, weight);
        const V4 mean_y = sum4(y, weight);
        const V4 mean_z = sum4(z, weight);
        x = minus(x, mean_x);
        y = minus(y, mean_y);
        z = minus(z, mean_z);
        FourChildren spread = children_of(children.moment, node);
        for (int i = 0; i < 4; ++i) {
            spread.of[i] = hn::Add(spread.of[i], square_of(x.of[i], y.of[i], z.of[i]));
        }
        const auto dipole2 = [&](const FourChildren& light, float scale) {
            const V4 factor = set4(scale);
            return square_of(hn::Mul(factor, sum4(x, light)), hn::Mul(factor, sum4(y, light)),
                             hn::Mul(factor, sum4(z, light)));
        };
        // The children's own add to that of their light about the mean direction.
        const V4 own = hn::Sqrt(
            hn::Max(dipole2(r, scales[0]), hn::Max(dipole2(g, scales[1]), dipole2(b, scales[2]))));
        hn::StoreU(hn::Add(own, sum4(children_of(children.dipole, node))), d, dipoles + node);
        hn::Store(mean_x, d, parent.x + node);
        hn::Store(mean_y, d, parent.y + node);
        hn::Store(mean_z, d, parent.z + node);
        hn::Store(sum4(spread, weight), d, parent.moment + node);
        hn::Store(sum4(r), d, parent.r + node);
        hn::Store(sum4(g), d, parent.g + node);
        hn::Store(sum4(b), d, parent.b + node);
        hn::Store(sum4(solid_angle_sr), d, parent.solid_angle_sr + node);
    }
}

void join_row(const RadianceLevel& children, const RadianceLevel& parents, const RowLight& scales,
              int face, int y) {
    constexpr RadianceBlock kNone = {};
    constexpr float kNoDipoles[4] = {};
    const int count = children.per_side;
    Children of;
    for (int x = 0; x < parents.per_side; ++x) {
        for (int node = 0; node < 4; ++node) {
            const int column = 2 * x + node % 2;
            const int row = 2 * y + node / 2;
            const bool is_there = column < count && row < count;
            const RadianceBlock& in = is_there ? children.row(face, row)[column] : kNone;
            of.x.set(node, in.x);
            of.y.set(node, in.y);
            of.z.set(node, in.z);
            of.moment.set(node, in.moment);
            of.r.set(node, in.r);
            of.g.set(node, in.g);
            of.b.set(node, in.b);
            of.solid_angle_sr.set(node, in.solid_angle_sr);
            of.dipole.set(node, is_there && children.dipoles != nullptr
                                    ? children.dipole_row(face, row) + 4 * column
                                    : kNoDipoles);
        }
        join(of, scales, parents.row(face, y)[x], parents.dipole_row(face, y) + 4 * x);
    }
}

}  // namespace

RadianceKernels make_radiance_kernels() { return {&make_leaves, &join_row}; }

}  // namespace aureole::ibl::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::ibl {
HWY_EXPORT(make_radiance_kernels);
const RadianceKernels& radiance_kernels() {
    static const RadianceKernels kernels = HWY_DYNAMIC_DISPATCH(make_radiance_kernels)();
    return kernels;
}
}  // namespace aureole::ibl
#endif
