#include "aureole/fourier/varying_convolver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "fourier/convolver_kernels.h"
#include "fourier/scratch.h"

namespace aureole::fourier {
namespace {

// convolve_rows() needs at least two passes; 12 = 3 * 4 has them, and so has all that is larger.
int padded(int needed) { return best_length(std::max(needed, 12)); }

int batches(int count, int size) { return (count + size - 1) / size; }

std::string size_of(const Image& image) {
    return std::to_string(image.width()) + "x" + std::to_string(image.height()) + "x" +
           std::to_string(image.channels());
}

void check(int width, int height, int channels, const std::vector<KernelNodes>& parts) {
    if (width <= 0 || height <= 0 || channels <= 0) {
        throw InvalidArgument("picture size",
                              std::to_string(width) + "x" + std::to_string(height) + ", " +
                                  std::to_string(channels) + " channels",
                              "all three must be positive");
    }
    for (const KernelNodes& part : parts) {
        if (part.columns < 1 || part.rows < 1 || part.columns > width || part.rows > height ||
            part.kernels.size() !=
                static_cast<std::size_t>(part.columns) * static_cast<std::size_t>(part.rows)) {
            throw InvalidArgument("nodes of a kernel",
                                  std::to_string(part.columns) + "x" + std::to_string(part.rows) +
                                      ", " + std::to_string(part.kernels.size()) + " kernels",
                                  "must be one kernel per node, and 1 to " + std::to_string(width) +
                                      " x 1 to " + std::to_string(height) + " nodes");
        }
        const Image& first = part.kernels.front();
        for (const Image& kernel : part.kernels) {
            if (kernel.width() % 2 == 1 && kernel.height() % 2 == 1 &&
                kernel.width() == first.width() && kernel.height() == first.height() &&
                kernel.channels() == channels) {
                continue;
            }
            throw InvalidArgument("kernel of a node", size_of(kernel),
                                  "must be odd, as large as the first, " + size_of(first) +
                                      ", with the picture's " + std::to_string(channels) +
                                      " channels");
        }
    }
}

// The pixels to which a node of an axis gives weight: all between its neighbours.
struct Support {
    int first;
    int size;
};

Support support(int node, int pixels, int nodes) {
    const auto position = [&](int n) {
        return nodes == 1 ? 0.0 : static_cast<double>(n) * (pixels - 1) / (nodes - 1);
    };
    if (nodes == 1) return {0, pixels};
    const int first = node == 0 ? 0 : static_cast<int>(std::floor(position(node - 1))) + 1;
    const int last =
        node == nodes - 1 ? pixels - 1 : static_cast<int>(std::ceil(position(node + 1))) - 1;
    return {first, last - first + 1};
}

// One axis of the transforms of a part. Offsets of `reach` around the support, cyclically: nothing
// falls back into the pixels wanted if the line holds support and both reaches, nor, wherever the
// support lies, if it holds the picture and one (convolver.h). Nodes at the border have half the
// support of those within.
struct Axis {
    Axis(int pixels_, int nodes_, int kernel_size)
        : pixels(pixels_),
          nodes(nodes_),
          centre(kernel_size / 2),
          reach(std::min(centre, pixels - 1)),
          within(needed(nodes / 2)),
          border(needed(0)) {
        // Supports of nodes within differ by a pixel.
        for (int n = 1; n < nodes - 1; ++n) {
            largest = std::max(largest, support(n, pixels, nodes).size);
            if (needed(n) > within.length) within = LinePlan(needed(n));
        }
        for (const int n : {0, nodes - 1}) {
            largest = std::max(largest, support(n, pixels, nodes).size);
            if (needed(n) > border.length) border = LinePlan(needed(n));
        }
    }

    int needed(int node) const {
        return padded(std::min(support(node, pixels, nodes).size + 2 * reach, pixels + reach));
    }
    const LinePlan& plan(int node) const {
        return node == 0 || node == nodes - 1 ? border : within;
    }
    int longest() const { return std::max(within.length, border.length); }

    int pixels;
    int nodes;
    int centre;
    int reach;
    LinePlan within;
    LinePlan border;
    int largest = 0;  // support of a node
};

// Along one axis: where the source pixels of a node are, and where its light goes.
struct Span {
    Span(const Axis& axis, int node)
        : plan(&axis.plan(node)),
          source(support(node, axis.pixels, axis.nodes)),
          first(std::max(source.first - axis.reach, 0)),
          size(std::min(source.first + source.size + axis.reach, axis.pixels) - first),
          // Sample 0 of the kernel carries the first source pixel `reach` to the left of itself.
          kernel_at((source.first - axis.reach - first + plan->length) % plan->length) {}

    const LinePlan* plan;
    Support source;
    int first;
    int size;
    int kernel_at;
};

bool is_empty(const Image& kernel) {
    const float* values = kernel.plane(0);
    return std::all_of(values,
                       values + kernel.pixels() * static_cast<std::size_t>(kernel.channels()),
                       [](float value) { return value == 0; });
}

ConstImageView part_of(const ConstImageView& view, int x, int y, int width, int height) {
    ConstImageView result = view;
    result.data += view.offset(x, y, 0);
    result.width = width;
    result.height = height;
    return result;
}

ImageView part_of(const ImageView& view, int x, int y, int width, int height) {
    ImageView result = view;
    result.data = &view.at(x, y, 0);
    result.width = width;
    result.height = height;
    return result;
}

}  // namespace

NodeBlend node_blend(int pixel, int pixels, int nodes) {
    if (nodes == 1 || pixels == 1) return {};
    const double at = static_cast<double>(pixel) * (nodes - 1) / (pixels - 1);
    const int first = std::min(static_cast<int>(at), nodes - 1);
    return {first, static_cast<float>(at - first)};
}

// Transforms of one part, with memory for one node at a time.
class PartConvolver {
  public:
    PartConvolver(int width, int height, int channels, const KernelNodes& nodes)
        : channels_(channels),
          nodes_(&nodes),
          simd_(convolver_kernels()),
          x_(width, nodes.columns, nodes.kernels.front().width()),
          y_(height, nodes.rows, nodes.kernels.front().height()),
          slab_columns_(batches(x_.longest(), 2 * simd_.lanes) * 2 * simd_.lanes),
          // One element more: equal strides of many slabs would compete for the same cache sets.
          slab_floats_(element() * static_cast<std::size_t>(slab_columns_ + 1)),
          spectrum_floats_(element() * static_cast<std::size_t>(x_.longest())),
          scratch_(element() * (static_cast<std::size_t>(x_.longest()) +
                                static_cast<std::size_t>(y_.longest() + 1) *
                                    (static_cast<std::size_t>(channels) + 1))),
          spectrum_(spectrum_floats_ * slabs(y_.longest())),
          slab_memory_(slab_floats_ * slabs(y_.longest())),
          weights_(static_cast<std::size_t>(x_.largest) * static_cast<std::size_t>(y_.largest)),
          ones_(static_cast<std::size_t>(channels), 1.0F) {
        for (const Image& kernel : nodes.kernels) empty_.push_back(is_empty(kernel) ? 1 : 0);
    }

    void add(const ConstImageView& in, const float* weights, const ImageView& sum) noexcept {
        for (int j = 0; j < nodes_->rows; ++j) {
            for (int i = 0; i < nodes_->columns; ++i) {
                const auto node = static_cast<std::size_t>(j * nodes_->columns + i);
                if (empty_[node] == 0) add_node(i, j, nodes_->kernels[node], in, weights, sum);
            }
        }
    }

  private:
    std::size_t element() const { return 2 * static_cast<std::size_t>(simd_.lanes); }
    int slabs_per_channel(int length) const { return batches(length / 2 + 1, simd_.lanes); }
    std::size_t slabs(int length) const {
        return static_cast<std::size_t>(slabs_per_channel(length)) *
               static_cast<std::size_t>(channels_);
    }
    std::size_t column_batches(int columns) const {
        return static_cast<std::size_t>(batches(columns, 2 * simd_.lanes));
    }

    void transform_kernel(const Image& kernel, const Span& x, const Span& y) noexcept {
        const int width = 2 * x_.reach + 1;
        const ConstImageView cut = part_of(kernel.view(), x_.centre - x_.reach,
                                           y_.centre - y_.reach, width, 2 * y_.reach + 1);
        // Column spectra of kernel and picture are both kept doubled; rows and columns unscaled.
        const float scale =
            0.25F / (static_cast<float>(x.plan->length) * static_cast<float>(y.plan->length));
        const ColumnPass columns{y.plan,
                                 y.kernel_at,
                                 width,
                                 0.0F,
                                 -1,
                                 nullptr,
                                 spectrum_.data(),
                                 spectrum_floats_,
                                 slabs_per_channel(y.plan->length)};
        const RowPass rows{x.plan, width};
        parallel_for(column_batches(width), [&](std::size_t batch, int worker) {
            simd_.columns_in(columns, cut, static_cast<int>(batch), scratch_.of(worker));
        });
        parallel_for(slabs(y.plan->length), [&](std::size_t g, int worker) {
            simd_.spectrum_rows(rows, x.kernel_at, scale, spectrum_.data() + g * spectrum_floats_,
                                scratch_.of(worker));
        });
    }

    // h_n times the pixel weights, over the node's source pixels.
    void fill_weights(int i, int j, const Span& x, const Span& y, const float* weights) noexcept {
        const auto share = [](NodeBlend blend, int node) {
            return blend.first == node ? 1 - blend.second_share : blend.second_share;
        };
        parallel_for(static_cast<std::size_t>(y.source.size), [&](std::size_t row, int) {
            const int py = y.source.first + static_cast<int>(row);
            const float row_share = share(node_blend(py, y_.pixels, y_.nodes), j);
            float* to = weights_.data() + row * static_cast<std::size_t>(x.source.size);
            for (int k = 0; k < x.source.size; ++k) {
                const int px = x.source.first + k;
                to[k] = row_share * share(node_blend(px, x_.pixels, x_.nodes), i);
                if (weights != nullptr) to[k] *= weights[std::ptrdiff_t{py} * x_.pixels + px];
            }
        });
    }

    void add_node(int i, int j, const Image& kernel, const ConstImageView& in, const float* weights,
                  const ImageView& sum) noexcept {
        const Span x(x_, i);
        const Span y(y_, j);
        transform_kernel(kernel, x, y);
        fill_weights(i, j, x, y, weights);
        const ConstImageView source =
            part_of(in, x.source.first, y.source.first, x.source.size, y.source.size);
        const ImageView target = part_of(sum, x.first, y.first, x.size, y.size);
        ColumnPass columns{y.plan,
                           0,
                           slab_columns_,
                           0.0F,
                           -1,
                           weights_.data(),
                           slab_memory_.data(),
                           slab_floats_,
                           slabs_per_channel(y.plan->length)};
        parallel_for(column_batches(x.source.size), [&](std::size_t batch, int worker) {
            simd_.columns_in(columns, source, static_cast<int>(batch), scratch_.of(worker));
        });
        const RowPass rows{x.plan, std::max(x.size, x.source.size)};
        // What follows the source pixels is zero to the end of the last batch that columns_out()
        // reads.
        const std::size_t filled = element() * static_cast<std::size_t>(x.source.size);
        const std::size_t read =
            element() * static_cast<std::size_t>(2 * simd_.lanes) * column_batches(rows.width);
        parallel_for(slabs(y.plan->length), [&](std::size_t g, int worker) {
            float* slab = slab_memory_.data() + g * slab_floats_;
            std::fill(slab + filled, slab + read, 0.0F);
            simd_.convolve_rows(rows, slab, spectrum_.data() + g * spectrum_floats_,
                                scratch_.of(worker));
        });
        columns.weights = nullptr;
        parallel_for(column_batches(x.size), [&](std::size_t batch, int worker) {
            simd_.columns_out(columns, target, ones_.data(), target, static_cast<int>(batch),
                              scratch_.of(worker));
        });
    }

    int channels_;
    const KernelNodes* nodes_;
    ConvolverKernels simd_;
    Axis x_;
    Axis y_;
    int slab_columns_;
    std::size_t slab_floats_;
    std::size_t spectrum_floats_;
    Scratch scratch_;
    Buffer spectrum_;
    Buffer slab_memory_;
    Buffer weights_;
    std::vector<float> ones_;
    std::vector<char> empty_;  // nodes that send no light
};

struct VaryingConvolver::Impl {
    Impl(int width, int height, int channels, std::vector<KernelNodes> given)
        : parts(std::move(given)), sum(width, height, channels) {
        for (const KernelNodes& part : parts) {
            convolvers.emplace_back(width, height, channels, part);
        }
    }

    void run(const ConstImageView& in, const ImageView& out, const float* weights) noexcept {
        std::fill_n(sum.plane(0), sum.pixels() * static_cast<std::size_t>(sum.channels()), 0.0F);
        for (PartConvolver& convolver : convolvers) convolver.add(in, weights, sum);
        parallel_for(static_cast<std::size_t>(sum.height()), [&](std::size_t row, int) {
            const int y = static_cast<int>(row);
            for (int c = 0; c < sum.channels(); ++c) {
                const float* from = sum.row(y, c);
                for (int x = 0; x < sum.width(); ++x) {
                    const float w =
                        weights == nullptr ? 1.0F : weights[std::ptrdiff_t{y} * sum.width() + x];
                    out.at(x, y, c) = from[x] / w;
                }
            }
        });
    }

    std::vector<KernelNodes> parts;  // never resized: the convolvers point into it
    std::vector<PartConvolver> convolvers;
    Image sum;
};

VaryingConvolver::VaryingConvolver(int width, int height, int channels,
                                   std::vector<KernelNodes> parts) {
    check(width, height, channels, parts);
    impl_ = std::make_unique<Impl>(width, height, channels, std::move(parts));
}
VaryingConvolver::~VaryingConvolver() = default;
VaryingConvolver::VaryingConvolver(VaryingConvolver&&) noexcept = default;
VaryingConvolver& VaryingConvolver::operator=(VaryingConvolver&&) noexcept = default;
const std::vector<KernelNodes>& VaryingConvolver::parts() const noexcept { return impl_->parts; }

void VaryingConvolver::run(const ConstImageView& in, const ImageView& out,
                           const float* weights) noexcept {
    impl_->run(in, out, weights);
}

Image kernel_at(const std::vector<KernelNodes>& parts, int width, int height, int x, int y) {
    int kernel_width = 1;
    int kernel_height = 1;
    int channels = 1;
    for (const KernelNodes& part : parts) {
        kernel_width = std::max(kernel_width, part.kernels.front().width());
        kernel_height = std::max(kernel_height, part.kernels.front().height());
        channels = part.kernels.front().channels();
    }
    Image result(kernel_width, kernel_height, channels);
    for (const KernelNodes& part : parts) {
        const NodeBlend across = node_blend(x, width, part.columns);
        const NodeBlend down = node_blend(y, height, part.rows);
        for (const int j : {0, 1}) {
            for (const int i : {0, 1}) {
                const float share = (i == 0 ? 1 - across.second_share : across.second_share) *
                                    (j == 0 ? 1 - down.second_share : down.second_share);
                if (share == 0) continue;
                const Image& kernel = part.kernels[static_cast<std::size_t>(
                    (down.first + j) * part.columns + across.first + i)];
                const int x0 = (kernel_width - kernel.width()) / 2;
                const int y0 = (kernel_height - kernel.height()) / 2;
                for (int c = 0; c < channels; ++c) {
                    for (int ky = 0; ky < kernel.height(); ++ky) {
                        float* to = result.row(y0 + ky, c) + x0;
                        const float* from = kernel.row(ky, c);
                        for (int kx = 0; kx < kernel.width(); ++kx) to[kx] += share * from[kx];
                    }
                }
            }
        }
    }
    return result;
}

}  // namespace aureole::fourier
