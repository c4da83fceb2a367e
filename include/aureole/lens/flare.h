// The ghosts that lights make in a lens, in units of the picture that they are added to.
//
// A lens images a scene of radiance L onto its sensor with irradiance E = T_0 L pi / (4 N^2), T_0
// being its transmission on the axis. The same factor turns the irradiance of a ghost into the
// radiance that it adds to the picture:
//     L_g(x) = E_g(x) / (T_0 A_EP / f^2),   E_g(x) = sum over ways to x of
//              L_src W cos(theta) T_g / |det dx/dp|,
// p the position in the entrance plane, W the light's solid angle, A_EP = pi (f / 2N)^2. In linear
// optics that is (T_g / T_0) L_src W cos(theta) f^2 / (A^2 A_EP). There is no gain.
//
// Three renderers: docs/lens_flares.md derives them and shows where they differ.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "aureole/base/progress.h"
#include "aureole/image/image.h"
#include "aureole/image/view.h"
#include "aureole/lens/ghosts.h"
#include "aureole/lens/iris.h"
#include "aureole/lens/lens.h"
#include "aureole/sources/light.h"

namespace aureole::lens {

enum class GhostMethod {
    kMatrix,  // linear optics: each ghost is a projection of the iris, clipped by the apertures on
              // its way, of even brightness (Lee & Eisemann 2013; the blog article
              // "Implementation Notes: Physically Based Lens Flares", 2015, "the blog" below)
    kTraced,  // a grid of exact rays for each ghost and wavelength, finer at folds (Hullin et al.
              // 2011); irradiance from the area between neighbouring rays, folds summed
    kHybrid,  // matrix for as many ghosts as the tolerance allows, traced for the others
};
// matrix, traced, hybrid. Throws InvalidArgument for any other name.
GhostMethod ghost_method_from_name(std::string_view name);

enum class Look {
    kPhysical,
    // The choices of the blog: intensity = ratio of the areas of the ghost's and
    // the lens's entrance pupil over the area of the quad on the sensor (in units of the image
    // circle's radius, 21.65 mm), colour = reflectance of the two faces for R, G, B at one random
    // angle per ghost, same-side ghosts, the entrance as the only clipping aperture, slopes taken
    // as angles, edges faded by smoothstep(.95, .80) of a smooth 64 x 64 distance field.
    // "Relative to an in-focus pixel" is read as: relative to the image of the light in focus, its
    // area in the same units as the quad's.
    kBlog,
};

// What an artist may change about one ghost.
struct GhostSetting {
    Bounces bounces;
    bool enabled = true;
    float gain = 1;                         // >= 0
    std::array<float, 3> tint = {1, 1, 1};  // linear sRGB, >= 0
};

struct FlareOptions {
    GhostMethod method = GhostMethod::kHybrid;
    GhostSet set = GhostSet::kAll;
    Look look = Look::kPhysical;  // kBlog needs kMatrix
    // Bands of the visible spectrum, each with its own rays (kTraced); the colour of a matrix ghost
    // always comes from 16. 1 to 64.
    int wavelengths = 6;
    int rays_per_side = 128;  // of the grid of a ghost, 8 to 1024
    // Ghosts, weakest first, are left out as long as all of them together hold at most this share
    // of the energy that falls on the picture. 0: none. [0, 1).
    double energy_dropped = 1e-3;
    // The strongest share of the ghosts by intensity; the document's "top 40 %" is .4. (0, 1].
    double strongest = 1;
    // kHybrid: how much of the energy of the flare may lie elsewhere than in the traced one (sum of
    // absolute differences over the sum). (0, 1].
    double hybrid_tolerance = 0.02;
    // Large dim ghosts are drawn at a half, a quarter, ... of the resolution as long as all that
    // this displaces is below this share of the flare's energy. 0: all at full resolution. [0, 1).
    double coarse_tolerance = 2e-3;
    std::vector<GhostSetting> ghosts = {};  // those that are not the default
    std::array<float, 3> tint = {1, 1, 1};  // of all
    // Transmission over the square [-1, 1]^2 of the projected iris, in place of its shape (one
    // channel; kMatrix draws it, and kHybrid for the ghosts it leaves to matrix; kTraced maps it by
    // the stop position of each ray). Empty: the iris.
    Image ghost_texture = {};
};

// Throws InvalidArgument with the option, the value and what is allowed.
void validate(const FlareOptions& options);

// What became of a ghost in the last render().
struct GhostReport {
    enum class Drawn { kMatrix, kTraced, kDropped, kDisabled, kBlocked /* no light passes */ };
    Bounces bounces;
    Drawn drawn = Drawn::kDropped;
    // Of the light that gives it most energy:
    double energy = 0;    // sum over the picture's pixels and RGB, in linear optics
    double center_x = 0;  // continuous pixel coordinates
    double center_y = 0;
    double radius_px = 0;    // of the projected iris
    double radiance = 0;     // mean of RGB inside
    double difference = -1;  // hybrid: estimated sum of |matrix - traced| over the ghost's energy
};

// Where linear optics puts a ghost, for callers that draw ghosts by themselves. What other
// apertures cut away is not told.
struct GhostPlacement {
    Bounces bounces;
    float center_x = 0, center_y = 0;  // of the projected iris, continuous pixel coordinates
    // Of the projected iris, whose (u, v) = ((x - center_x) / radius_x, (y - center_y) / radius_y);
    // negative: mirrored; 0: no light passes.
    float radius_x_px = 0, radius_y_px = 0;
    std::array<float, 3> radiance = {};  // inside; gains and tints are left out
};

struct FlareReport {
    std::vector<GhostReport> ghosts;
    double energy_dropped = 0;    // share, of the ghosts left out
    double coarse_displaced = 0;  // bound of the share displaced by low resolution
    std::size_t rays = 0;
};

// Configured once per lens, iris and picture geometry.
class Flare {
  public:
    // One pixel on the axis covers efl_mm / view.focal_length_px() on the sensor: the view's field
    // decides how much of the image circle is seen. Copies lens and iris. `occluder` may be null.
    // Throws InvalidArgument for options out of range or unknown ghosts among options.ghosts.
    Flare(const Lens& lens, const Iris& iris, const View& view, const FlareOptions& options = {},
          const Occluder* occluder = nullptr);
    ~Flare();
    Flare(Flare&&) noexcept;
    Flare& operator=(Flare&&) noexcept;

    // Adds the ghosts of all lights to `out` (3 channels, the view's size). Never NaN. A light that
    // the lens does not see adds nothing. Not to be run from two threads at once. Reports and may
    // throw Cancelled before each light and, of traced ghosts, after every few of them; `out` is
    // then as it was, and report() as if no light had been seen.
    void render(std::span<const sources::Light> lights, const ImageView& out,
                Progress* progress = nullptr);

    // Of all ghosts, whatever the method; allocates nothing. Valid until the next call.
    std::span<const GhostPlacement> place(const sources::Light& light) noexcept;

    // Of the last render().
    const FlareReport& report() const noexcept;
    // Transmission of the lens on the axis, T_0, for red, green and blue.
    std::array<double, 3> axial_transmission() const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::lens
