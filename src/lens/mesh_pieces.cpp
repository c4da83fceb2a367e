#include "lens/mesh_pieces.h"

#include <cmath>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/mesh_pieces.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "lens/mesh_few_pieces-inl.h"
#include "lens/mesh_many_pieces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

void draw(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask, const MeshTile& tile) {
    constexpr int kFewPieces = 9;
    if (group.pieces_i * group.pieces_j <= kFewPieces) {
        draw_few(mesh, group, mask, tile);
    } else {
        draw_many(mesh, group, mask, tile);
    }
}

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(draw);
void draw_pieces(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask,
                 const MeshTile& tile) {
    HWY_DYNAMIC_DISPATCH(draw)(mesh, group, mask, tile);
}
}  // namespace aureole::lens
#endif
