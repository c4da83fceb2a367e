#include "ibl/gather_kernels.h"

#include "ibl/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ibl/gather_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "ibl/gather_cut-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::ibl::HWY_NAMESPACE {
namespace {

template <LobeShape kShape>
void gather_tile(const std::vector<RadianceLevel>& levels, const GatherLobe& lobe,
                 const GatherTile& tile, GatherScratch& scratch, TileSums& sums) {
    const float scale = kShape == LobeShape::kCosine ? -1 : lobe.scale;
    const GroupPoints whole = group_points(tile.face, tile.interpolation, scale, sums.far.length);
    GroupPoints quarters[kMostQuarters];
    for (int i = 0; i < tile.quarter_count; ++i) {
        quarters[i] = group_points(tile.face, tile.quarters[i], scale, sums.near[i].length);
    }
    Stack deferred = {scratch.deferred, 0};
    Records far = {scratch.far, 0, &sums.far};
    const auto finish_deferred = [&] {
        for (int i = 0; i < tile.quarter_count; ++i) {
            Records near = {scratch.near, 0, &sums.near[i]};
            const CutTask task = {levels, lobe, quarters[i]};
            for (int k = 0; k < deferred.count; ++k) {
                Stack stack = {scratch.near_stack, 1};
                stack.refs[0] = deferred.refs[k];
                cut<kShape, false>(task, stack, near, nullptr);
            }
            add_records<kShape>(lobe, near.list, near.count, quarters[i], *near.sums);
        }
        deferred.count = 0;
    };
    const CutTask task = {levels, lobe, whole};
    const int last = static_cast<int>(levels.size()) - 1;
    const RadianceLevel& roots = levels.back();
    for (int face = 0; face < kFaces; ++face) {
        Stack stack = {scratch.stack, 0};
        for (int i = 0; i < roots.per_side * roots.per_side; ++i) {
            const Place place = {face, i % roots.per_side, i / roots.per_side};
            stack.refs[stack.count++] = {packed(place), static_cast<std::uint16_t>(last),
                                         kAllNodes};
        }
        while (stack.count > 0) {
            cut<kShape, true>(task, stack, far, &deferred);
            if (deferred.count == GatherScratch::kDeferred) finish_deferred();
        }
    }
    finish_deferred();
    add_records<kShape>(lobe, far.list, far.count, whole, *far.sums);
}

void gather(const std::vector<RadianceLevel>& levels, const GatherLobe& lobe,
            const GatherTile& tile, GatherScratch& scratch, TileSums& sums) {
    switch (lobe.shape) {
        case LobeShape::kNarrow:
            return gather_tile<LobeShape::kNarrow>(levels, lobe, tile, scratch, sums);
        case LobeShape::kWide:
            return gather_tile<LobeShape::kWide>(levels, lobe, tile, scratch, sums);
        case LobeShape::kCosine:
            return gather_tile<LobeShape::kCosine>(levels, lobe, tile, scratch, sums);
    }
}

}  // namespace

GatherKernels make_gather_kernels() { return {&gather}; }

}  // namespace aureole::ibl::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::ibl {
HWY_EXPORT(make_gather_kernels);
const GatherKernels& gather_kernels() {
    static const GatherKernels kernels = HWY_DYNAMIC_DISPATCH(make_gather_kernels)();
    return kernels;
}
}  // namespace aureole::ibl
#endif
