// Ghosts by linear optics: where they are, how bright, and drawing them.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "aureole/lens/flare.h"
#include "lens/canvas.h"
#include "lens/film.h"
#include "lens/ghost_draw.h"

namespace aureole::lens {

class BlogField;

// One ghost of one light, in continuous pixel coordinates of the picture. The iris is projected by
//     u = (x - center_x) * u_per_px,   v = (y - center_y) * v_per_px
// (both may be negative: a mirrored iris), and clipped by housings.
struct MatrixGhost {
    float center_x = 0, center_y = 0;
    float u_per_px = 0, v_per_px = 0;  // 0: blocked, or no light
    // Another aperture on the way, in iris coordinates: an ellipse (of a housing or the front), or
    // the iris itself at another of its crossings, mirrored if ru is negative. Inside where the
    // distance of ((u - u0) / ru, (v - v0) / rv) is below 1.
    struct Clip {
        float u0 = 0, v0 = 0, ru = 1, rv = 1;
        bool iris = false;
        float edge = 0;  // half the width over which a light of finite size softens it, in its own
                         // relative units
    };
    static constexpr int kMaxClips = 6;
    Clip clips[kMaxClips] = {};
    int clip_count = 0;
    float edge = 0;          // the same softening of the iris, in iris units
    float radiance[3] = {};  // where nothing is clipped, picture units, without gains
    float energy = 0;        // sum over pixels (of an endless picture) and RGB, clips included
    float radius_px = 0;     // of the projected iris: geometric mean of both axes
    // The open part: its centroid, and the radius of a disc of its area. Where clips leave little
    // of a wide iris this is what is seen.
    float open_x = 0, open_y = 0;
    float open_radius_px = 0;
    // The image of a light much larger than the ghost: no edges are left of it, and the ghost is
    // drawn as a smooth spot of these second moments (px^2) around its centroid.
    bool spot = false;
    float spot_xx = 0, spot_xy = 0, spot_yy = 0;
    // Look::kBlog: its distance field, by which everything is drawn; else null.
    const BlogField* blog = nullptr;

    // Share of `radiance` at a pixel position, edges antialiased over one pixel of the picture.
    // Plain code: what draw() does in SIMD, but for textures and dirt.
    float coverage(const Iris& iris, float x, float y) const noexcept;
};

class MatrixGhosts {
  public:
    MatrixGhosts(const Lens& lens, const Iris& iris, const Film& film, const FlareOptions& options,
                 std::vector<Bounces> ghosts, const Occluder* occluder);
    ~MatrixGhosts();
    MatrixGhosts(MatrixGhosts&&) noexcept;

    // Allocates nothing, on one thread.
    void place(const sources::Light& light) noexcept;
    // Of the last place().
    std::span<const MatrixGhost> placements() const noexcept;
    // Draws ghosts of the last place() by several threads; marks the levels it uses.
    void draw(std::span<const GhostDraw> ghosts, Canvas& canvas) noexcept;

    std::array<double, 3> axial_transmission() const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::lens
