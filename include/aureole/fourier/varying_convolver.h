// Convolution with a kernel that changes over the picture.
//
// The kernel is known at nodes spread evenly over the picture, its corners included, and blended
// bilinearly between them:
//
//   out(x) = (1 / w(x)) * sum over nodes n, sources s of  h_n(s) w(s) in(s) k_n(x - s)
//
// h_n being 1 at its node, falling to 0 at the neighbouring ones, with sum 1 everywhere.
//
// Method: each h_n in is nonzero within two cells of the grid only. That patch is convolved with
// the node's kernel by transforms of (patch + 2 reach)^2 and added to the picture where it falls
// (overlap-add): the cost is about one transform of 4 picture areas, widened by the kernels' reach,
// however many nodes there are. Kernels that reach far but change slowly, and such that change fast
// but do not reach far, are therefore given as parts of their own, each on its own grid of nodes.
#pragma once

#include <memory>
#include <vector>

#include "aureole/image/image.h"

namespace aureole::fourier {

// One part of a kernel at columns x rows nodes. Node (i, j) is at the pixel
// (i (width - 1) / (columns - 1), j (height - 1) / (rows - 1)); a single column or row serves for
// the whole width or height.
struct KernelNodes {
    int columns = 1;
    int rows = 1;
    std::vector<Image> kernels;  // row by row; all of one odd size and channel count
};

// h_n along one axis: the two nodes around a pixel, and the share of the second.
struct NodeBlend {
    int first = 0;
    float second_share = 0;  // of node first + 1, in [0, 1); 0 where there is none
};
NodeBlend node_blend(int pixel, int pixels, int nodes);

class VaryingConvolver {
  public:
    // The kernels' centre is their middle pixel; they are kept (4 bytes per sample), their spectra
    // are made anew in each run: the memory of all of them would be ten times the kernels'.
    // Throws InvalidArgument for empty pictures, no nodes, more than one node per pixel, a number
    // of kernels that is not columns * rows, and kernels of different or even sizes or of another
    // channel count than the picture's.
    VaryingConvolver(int width, int height, int channels, std::vector<KernelNodes> parts);
    ~VaryingConvolver();
    VaryingConvolver(VaryingConvolver&&) noexcept;
    VaryingConvolver& operator=(VaryingConvolver&&) noexcept;

    const std::vector<KernelNodes>& parts() const noexcept;

    // Sizes as given at construction; `in` and `out` must not overlap. `weights` as in
    // Convolver::run. Allocates nothing; not to be run from two threads at once.
    void run(const ConstImageView& in, const ImageView& out,
             const float* weights = nullptr) noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// The kernel of the source in one pixel: the sum over all parts, on a grid as large as the largest.
Image kernel_at(const std::vector<KernelNodes>& parts, int width, int height, int x, int y);

}  // namespace aureole::fourier
