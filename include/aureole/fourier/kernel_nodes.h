// Kernels that change over a picture, known at nodes.
//
// The nodes are spread evenly over the picture, its corners included, and blended bilinearly
// between them: node n has the share h_n of a source pixel, 1 at its node, falling to 0 at the
// neighbouring ones; all shares of a pixel sum to 1.
//
// Only kernels that a half turn does not change, k(-x) = k(x), as the diffraction patterns of all
// apertures without phase are. Half of each is kept, and their spectra are real.
#pragma once

#include <cstddef>
#include <vector>

#include "aureole/image/image.h"

namespace aureole::fourier {

// One part of a kernel at columns x rows nodes. Node (i, j) is at the pixel
// (i (width - 1) / (columns - 1), j (height - 1) / (rows - 1)); a single column or row serves for
// the whole width or height.
struct KernelNodes {
    int columns = 1;
    int rows = 1;
    // right_half() of kernels, all of one size, of odd height, and channel count: those of the
    // nodes, row by row, or, with a mixture, terms of which every node's is a sum.
    std::vector<Image> halves;
    // Empty, or the factors of the terms: node n has the sum of mixture[n halves.size() + t] times
    // halves[t].
    std::vector<float> mixture;

    int nodes() const { return columns * rows; }
    int reach_x() const { return halves.front().width() - 1; }
    int reach_y() const { return halves.front().height() / 2; }
    // The half of node n = row * columns + column; `out` has the size of the halves.
    void half_of(int node, const ImageView& out) const noexcept;
    Image half_of(int node) const;
};

// The same nodes as a mixture of their mean and `rank` principal components, by which the sum of
// squared differences, each over the mean value there, is nearly the least that so many can reach
// (subspace iteration: Halko, Martinsson, Tropp 2011, "Finding structure with randomness",
// algorithm 4.4). Nodes that are no more than that are returned as they are.
// Throws InvalidArgument unless rank is at least 1.
KernelNodes principal_components(const KernelNodes& part, int rank);

// The middle column of a kernel of odd size and all to the right of it, made even: the mean of the
// kernel and its half turn. Throws InvalidArgument for an even size.
Image right_half(const Image& kernel);
// The kernel again.
Image whole_kernel(const Image& right_half);

// h_n along one axis: the two nodes around a pixel, and the share of the second.
struct NodeBlend {
    int first = 0;
    float second_share = 0;  // of node first + 1, in [0, 1); 0 where there is none
};
NodeBlend node_blend(int pixel, int pixels, int nodes);

// The kernel of the source in pixel (x, y): the sum over all parts, on a grid as large as the
// largest.
Image kernel_at(const std::vector<KernelNodes>& parts, int width, int height, int x, int y);

// Memory of the kernels, or of terms and factors.
std::size_t bytes(const std::vector<KernelNodes>& parts);

}  // namespace aureole::fourier
