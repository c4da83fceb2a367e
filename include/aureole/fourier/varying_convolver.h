// Convolution with a kernel that changes over the picture (kernel_nodes.h):
//
//   out(x) = (1 / w(x)) * sum over nodes n, sources s of  h_n(s) w(s) in(s) k_n(x - s)
//
// Method: h_n in is nonzero within two cells of the grid only. That patch is convolved with the
// node's kernel by transforms of (patch + 2 reach)^2 and added to the picture where it falls
// (overlap-add). Along one row of nodes h_n in = h_x (h_y in), and h_x does not depend on the row
// of pixels: so all nodes of a row share the transforms of the picture's columns, forward and
// inverse, and only transforms along rows are made node by node. The cost is about that of
// transforming 4 picture areas, widened by the kernels' reach, however many nodes there are.
// Kernels that reach far but change slowly, and such that change fast but do not reach far, are
// therefore given as parts of their own, each on its own grid of nodes.
#pragma once

#include <memory>
#include <vector>

#include "aureole/fourier/kernel_nodes.h"
#include "aureole/image/image.h"

namespace aureole::fourier {

class VaryingConvolver {
  public:
    // The kernels are kept (4 bytes per sample of their halves), their spectra are made anew in
    // each run: the memory of all of them would be eight times the kernels'.
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

}  // namespace aureole::fourier
