// Bright pixels joined into clusters, each of which is drawn with one sprite of a kernel instead of
// one per pixel: Sikachev, Tisevich & Ignatenko 2008, "Using Quad-Trees for Acceleration of
// Physically-Based Image-Space Rendering of Glare", section 4; and beyond it, clusters whose error
// is bounded.
//
// Light e(s) at pixels s makes the glare sum over s of e(s) k(x - s). Over a square cell of side N
// this is replaced by one of
//
//     cell    E k_N(x - corner)   k_N: mean of k over the N x N shifts, the paper's integral streak
//
//     point   E k(x - c)          c: the cell's centroid; k between pixels by bilinear weights
//
// with E the cell's energy, which both keep. How far that is from the truth, as the sum over pixels
// and channels of |difference|, is bounded by what docs/sprites.md derives:
//
//     cell    |k| times the sum of |e - E / N^2|
//     point   first order:  V_x sum e |dx| + V_y sum e |dy|
//             second order: half of C_xx sum e |dx| (|dx| + 1), the same in y, C_xy sum e |dx dy|,
//                           and V times how far a colour's own centroid is from the common one
//
// where V and C are the total variations of the kernel and of its differences. Clusters therefore
// follow smooth kernels with large cells, whatever the light looks like, and even light with large
// cells, however rough the kernel.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "aureole/image/image.h"

namespace aureole::sources {

class BrightnessHistogram;

// Sums over a kernel of |k| and of |its differences|, the largest of its channels.
struct KernelRoughness {
    double sum = 1;           // |k(x, y)|; 1 for a kernel that is not negative and conserves energy
    double variation_x = 0;   // |k(x + 1, y) - k(x, y)|
    double variation_y = 0;   // |k(x, y + 1) - k(x, y)|
    double curvature_xx = 0;  // |k(x + 1, y) - 2 k(x, y) + k(x - 1, y)|
    double curvature_yy = 0;
    double curvature_xy = 0;  // |k(x + 1, y + 1) - k(x + 1, y) - k(x, y + 1) + k(x, y)|
};

// Beyond its border the kernel is 0: a step there counts. Throws InvalidArgument for an empty one.
KernelRoughness roughness_of(const ConstImageView& kernel);

inline constexpr int kMaxClusterSide = 64;

struct ClusterOptions {
    enum class Criterion {
        // A cell is a cluster if its bound is at most `error` of its energy: so is then the error
        // of the whole picture.
        kBoundedError,
        // The paper's: all pixels of the cell are bright, and similar in colour. Nothing is known
        // about the error.
        kSimilarColor,
    };
    Criterion criterion = Criterion::kBoundedError;
    double error = 0.01;  // kBoundedError; in [0, 1]. 0: only what is exact
    // kSimilarColor: the largest distance from the cell's mean, in any channel, over the mean of
    // all channels; >= 0.
    double color_spread = 0.1;
    // Side of the largest cells, a power of two up to kMaxClusterSide; 1: no clusters. Cells lie on
    // multiples of their side.
    int max_side = 16;
    // false: cells of max_side or single pixels only, the paper's static grid.
    bool tree = true;
    // kBoundedError: whether Shape::kCell may be chosen, which needs a kernel for each side.
    bool cells = true;
    // Pixels none of whose channels exceeds this are not bright: they are in no cluster. >= 0.
    float dim_limit = 0;
    // Of a pixel between dim_limit and this one only a share is bright, which rises smoothly
    // (bright_share()): no edge shows where light crosses the limit. <= dim_limit: all is.
    float full_limit = 0;
};

struct Cluster {
    enum class Shape { kCell, kPoint };
    Shape shape = Shape::kPoint;
    int x = 0;  // first pixel of the cell
    int y = 0;
    int side = 1;
    // Continuous pixel coordinates: the middle of pixel (0, 0) is (0.5, 0.5). Weighted by the sum
    // over channels; the cell's middle for Shape::kCell.
    double centroid_x = 0;
    double centroid_y = 0;
    std::array<float, 3> energy = {};  // grey pictures: the first
    double error_bound = 0;            // 0 for single pixels and kSimilarColor
};

struct Clusters {
    std::vector<Cluster> clusters;  // block by block of max_side, row by row
    std::size_t bright_pixels = 0;  // that are in clusters
    double energy = 0;              // of the clusters: sums over channels of |e|
    double energy_left = 0;         // of what is not bright
    double error_bound = 0;         // sum over clusters
};

// Finds clusters picture by picture, in memory that it keeps: once pictures have as many clusters
// as before, nothing is allocated.
class ClusterFinder {
  public:
    ClusterFinder();
    ~ClusterFinder();
    ClusterFinder(ClusterFinder&&) noexcept;
    ClusterFinder& operator=(ClusterFinder&&) noexcept;

    // `light`: 1 or 3 channels, finite; `weights`: null, or width * height factors (relative solid
    // angles) by which pixels are multiplied to give energy. Negative light counts with its amount
    // in all sums and bounds, and may be in clusters. The same clusters for any number of threads.
    // `measured`: null, or all of the same light with the same weights: dark parts are then not
    // looked at again. The result is valid until the next call.
    // Throws InvalidArgument for an empty picture, other channel counts, options out of range.
    const Clusters& find(const ConstImageView& light, const float* weights,
                         const KernelRoughness& roughness, const ClusterOptions& options = {},
                         const BrightnessHistogram* measured = nullptr);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// The same for one picture.
Clusters find_clusters(const ConstImageView& light, const float* weights,
                       const KernelRoughness& roughness, const ClusterOptions& options = {},
                       const BrightnessHistogram* measured = nullptr);

// The largest value such that pixels none of whose channels exceeds it hold at most `share` of the
// energy (sum of |light| * weight over channels), to within 5 % of the value, never above it:
// a dim_limit for pictures without a threshold. `share` in [0, 1].
float dim_limit_for(const ConstImageView& light, const float* weights, double share);

}  // namespace aureole::sources
