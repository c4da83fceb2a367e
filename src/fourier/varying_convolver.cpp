#include "aureole/fourier/varying_convolver.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "fourier/convolver_kernels.h"
#include "fourier/node_axis.h"
#include "fourier/scratch.h"

namespace aureole::fourier {
namespace {

int batches(int count, int size) { return (count + size - 1) / size; }

std::string size_of(const Image& image) {
    return std::to_string(image.width()) + "x" + std::to_string(image.height()) + "x" +
           std::to_string(image.channels());
}

// Whether every node has its kernel.
bool complete(const KernelNodes& part) {
    const auto nodes = static_cast<std::size_t>(part.nodes());
    return part.mixture.empty() ? part.halves.size() == nodes
                                : part.mixture.size() == nodes * part.halves.size();
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
            part.halves.empty() || !complete(part)) {
            throw InvalidArgument("nodes of a kernel",
                                  std::to_string(part.columns) + "x" + std::to_string(part.rows) +
                                      ", " + std::to_string(part.halves.size()) + " kernels",
                                  "must be one kernel or mixture per node, and 1 to " +
                                      std::to_string(width) + " x 1 to " + std::to_string(height) +
                                      " nodes");
        }
        const Image& first = part.halves.front();
        for (const Image& half : part.halves) {
            if (half.width() > 0 && half.height() % 2 == 1 && half.width() == first.width() &&
                half.height() == first.height() && half.channels() == channels) {
                continue;
            }
            throw InvalidArgument("half a kernel of a node", size_of(half),
                                  "must be of odd height, as large as the first, " +
                                      size_of(first) + ", with the picture's " +
                                      std::to_string(channels) + " channels");
        }
    }
}

bool is_empty(const Image& kernel) {
    const float* values = kernel.plane(0);
    return std::all_of(values,
                       values + kernel.pixels() * static_cast<std::size_t>(kernel.channels()),
                       [](float value) { return value == 0; });
}

ConstImageView rows_of(ConstImageView view, int first, int count) {
    view.data += view.offset(0, first, 0);
    view.height = count;
    return view;
}

ImageView rows_of(ImageView view, int first, int count) {
    view.data = &view.at(0, first, 0);
    view.height = count;
    return view;
}

// The part of a half that can be seen.
ConstImageView seen(const Image& half, int reach_x, int reach_y) {
    ConstImageView view = rows_of(half.view(), half.height() / 2 - reach_y, 2 * reach_y + 1);
    view.width = reach_x + 1;
    return view;
}

}  // namespace

// Transforms of one part, with memory for one row of nodes at a time.
class PartConvolver {
  public:
    PartConvolver(int width, int height, int channels, const KernelNodes& nodes)
        : channels_(channels),
          nodes_(&nodes),
          simd_(convolver_kernels()),
          x_(width, nodes.columns, nodes.reach_x()),
          y_(height, nodes.rows, nodes.reach_y()),
          // One element more: equal strides of many slabs would compete for the same cache sets.
          slab_floats_(element() * (static_cast<std::size_t>(padded_columns(width)) + 1)),
          kernel_slab_floats_(element() * static_cast<std::size_t>(x_.reach + 1)),
          scratch_(element() * std::max(3 * static_cast<std::size_t>(x_.longest()),
                                        static_cast<std::size_t>(y_.longest() + 1) *
                                            (static_cast<std::size_t>(channels) + 1))),
          light_(slab_floats_ * slabs(y_.longest())),
          sum_(light_.size()),
          kernel_columns_(kernel_slab_floats_ * slabs(y_.longest()) *
                          static_cast<std::size_t>(nodes.columns)),
          weights_(static_cast<std::size_t>(width) * static_cast<std::size_t>(y_.largest)),
          ones_(static_cast<std::size_t>(channels), 1.0F) {
        for (int i = 0; i < nodes.columns; ++i) {
            mixed_.emplace_back(nodes.reach_x() + 1, 2 * nodes.reach_y() + 1, channels);
        }
        for (int n = 0; n < nodes.nodes(); ++n) {
            nodes.half_of(n, mixed_.front());
            empty_.push_back(is_empty(mixed_.front()) ? 1 : 0);
        }
        for (int i = 0; i < nodes.columns; ++i) {
            const Support source = support(i, width, nodes.columns);
            shares_at_.push_back(shares_.size());
            for (int k = 0; k < source.size; ++k) {
                shares_.push_back(share(node_blend(source.first + k, width, nodes.columns), i));
            }
        }
    }

    void add(const ConstImageView& in, const float* weights, const ImageView& sum) noexcept {
        for (int j = 0; j < nodes_->rows; ++j) {
            const char* row = empty_.data() + index(0, j);
            if (std::any_of(row, row + nodes_->columns, [](char empty) { return empty == 0; })) {
                add_row(j, in, weights, sum);
            }
        }
    }

  private:
    static float share(NodeBlend blend, int node) {
        return blend.first == node ? 1 - blend.second_share : blend.second_share;
    }
    std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(nodes_->columns) +
               static_cast<std::size_t>(i);
    }
    std::size_t element() const { return 2 * static_cast<std::size_t>(simd_.lanes); }
    int padded_columns(int columns) const {
        return batches(columns, 2 * simd_.lanes) * 2 * simd_.lanes;
    }
    int slabs_per_channel(int length) const { return batches(length / 2 + 1, simd_.lanes); }
    std::size_t slabs(int length) const {
        return static_cast<std::size_t>(slabs_per_channel(length)) *
               static_cast<std::size_t>(channels_);
    }
    std::size_t column_batches(int columns) const {
        return static_cast<std::size_t>(batches(columns, 2 * simd_.lanes));
    }
    float* kernel_columns(int node) {
        return kernel_columns_.data() +
               static_cast<std::size_t>(node) * slabs(y_.longest()) * kernel_slab_floats_;
    }

    const Image& half_of(int i, int j) const {
        return nodes_->mixture.empty() ? nodes_->halves[index(i, j)]
                                       : mixed_[static_cast<std::size_t>(i)];
    }

    // h_y times the pixel weights, over the source pixels of a row of nodes.
    void fill_weights(int j, const Support& source, const float* weights) noexcept {
        parallel_for(static_cast<std::size_t>(source.size), [&](std::size_t row, int) {
            const int y = source.first + static_cast<int>(row);
            const float row_share = share(node_blend(y, y_.pixels, y_.nodes), j);
            float* to = weights_.data() + row * static_cast<std::size_t>(x_.pixels);
            for (int x = 0; x < x_.pixels; ++x) {
                to[x] = weights == nullptr ? row_share
                                           : row_share * weights[std::ptrdiff_t{y} * x_.pixels + x];
            }
        });
    }

    void transform_kernel_columns(int j, const NodeSpan& y) noexcept {
        if (!nodes_->mixture.empty()) {
            parallel_for(mixed_.size(), [&](std::size_t i, int) {
                const auto node = static_cast<int>(index(static_cast<int>(i), j));
                nodes_->half_of(node, mixed_[i]);
            });
        }
        const std::size_t per_node = column_batches(x_.reach + 1);
        parallel_for(per_node * static_cast<std::size_t>(nodes_->columns),
                     [&](std::size_t item, int worker) {
                         const int i = static_cast<int>(item / per_node);
                         if (empty_[index(i, j)] != 0) return;
                         const ColumnPass columns{y.plan,
                                                  (y.plan->length - y_.reach) % y.plan->length,
                                                  x_.reach + 1,
                                                  0.0F,
                                                  -1,
                                                  nullptr,
                                                  kernel_columns(i),
                                                  kernel_slab_floats_,
                                                  slabs_per_channel(y.plan->length)};
                         simd_.columns_in(columns, seen(half_of(i, j), x_.reach, y_.reach),
                                          static_cast<int>(item % per_node), scratch_.of(worker));
                     });
    }

    // All nodes of a row, on two slabs of one channel.
    void convolve_slabs(int j, const NodeSpan& y, std::size_t pair, float* scratch) noexcept {
        const int per_channel = slabs_per_channel(y.plan->length);
        const auto pairs = static_cast<std::size_t>(batches(per_channel, 2));
        const std::size_t in_channel = 2 * (pair % pairs);
        const std::size_t first = pair / pairs * static_cast<std::size_t>(per_channel) + in_channel;
        const bool has_second = in_channel + 1 < static_cast<std::size_t>(per_channel);
        float* spectra = scratch + 2 * element() * static_cast<std::size_t>(x_.longest());
        std::fill_n(sum_.data() + first * slab_floats_, (has_second ? 2U : 1U) * slab_floats_,
                    0.0F);
        for (int i = 0; i < nodes_->columns; ++i) {
            if (empty_[index(i, j)] != 0) continue;
            const NodeSpan x(x_, i);
            // Column spectra of kernel and picture are both kept doubled; rows and columns
            // unscaled.
            const float scale =
                0.25F / (static_cast<float>(x.plan->length) * static_cast<float>(y.plan->length));
            const float* kernel = kernel_columns(i) + first * kernel_slab_floats_;
            simd_.even_spectra(*x.plan, x_.reach, scale, kernel,
                               has_second ? kernel + kernel_slab_floats_ : nullptr, spectra,
                               scratch);
            const NodePass pass{x.plan,
                                x.source.first,
                                x.source.size,
                                shares_.data() + shares_at_[static_cast<std::size_t>(i)],
                                x.source.first - x.first,
                                x.size};
            for (std::size_t s = 0; s < (has_second ? 2U : 1U); ++s) {
                simd_.convolve_node(pass, light_.data() + (first + s) * slab_floats_,
                                    spectra + s * static_cast<std::size_t>(simd_.lanes),
                                    sum_.data() + (first + s) * slab_floats_, scratch);
            }
        }
    }

    void add_row(int j, const ConstImageView& in, const float* weights,
                 const ImageView& sum) noexcept {
        const NodeSpan y(y_, j);
        const int per_channel = slabs_per_channel(y.plan->length);
        fill_weights(j, y.source, weights);
        transform_kernel_columns(j, y);
        ColumnPass columns{y.plan,
                           y.source.first - y.first,
                           padded_columns(x_.pixels),
                           0.0F,
                           -1,
                           weights_.data(),
                           light_.data(),
                           slab_floats_,
                           per_channel};
        const ConstImageView source = rows_of(in, y.source.first, y.source.size);
        parallel_for(column_batches(x_.pixels), [&](std::size_t batch, int worker) {
            simd_.columns_in(columns, source, static_cast<int>(batch), scratch_.of(worker));
        });
        parallel_for(
            static_cast<std::size_t>(batches(per_channel, 2)) * static_cast<std::size_t>(channels_),
            [&](std::size_t pair, int worker) { convolve_slabs(j, y, pair, scratch_.of(worker)); });
        columns.weights = nullptr;
        columns.slabs = sum_.data();
        const ImageView target = rows_of(sum, y.first, y.size);
        parallel_for(column_batches(x_.pixels), [&](std::size_t batch, int worker) {
            simd_.columns_out(columns, target, ones_.data(), target, static_cast<int>(batch),
                              scratch_.of(worker));
        });
    }

    int channels_;
    const KernelNodes* nodes_;
    ConvolverKernels simd_;
    NodeAxis x_;
    NodeAxis y_;
    std::size_t slab_floats_;
    std::size_t kernel_slab_floats_;
    Scratch scratch_;
    Buffer light_;
    Buffer sum_;
    Buffer kernel_columns_;  // half-transformed kernels of a row of nodes
    Buffer weights_;
    std::vector<Image> mixed_;  // kernels of a row of nodes, where they are mixtures
    std::vector<float> ones_;
    std::vector<char> empty_;             // nodes that send no light
    std::vector<float> shares_;           // h_x of each node over its source pixels
    std::vector<std::size_t> shares_at_;  // where those of a node begin
};

struct VaryingConvolver::Impl {
    Impl(int width, int height, int channels, std::vector<KernelNodes> given)
        : parts(std::move(given)) {
        for (const KernelNodes& part : parts) {
            convolvers.emplace_back(width, height, channels, part);
        }
    }

    void run(const ConstImageView& in, const ImageView& out, const float* weights) noexcept {
        const auto for_each_pixel = [&](const auto& body) {
            parallel_for(static_cast<std::size_t>(out.height), [&](std::size_t row, int) {
                const int y = static_cast<int>(row);
                for (int c = 0; c < out.channels; ++c) {
                    for (int x = 0; x < out.width; ++x) body(x, y, out.at(x, y, c));
                }
            });
        };
        for_each_pixel([](int, int, float& value) { value = 0; });
        for (PartConvolver& convolver : convolvers) convolver.add(in, weights, out);
        if (weights == nullptr) return;
        for_each_pixel([&](int x, int y, float& value) {
            value /= weights[std::ptrdiff_t{y} * out.width + x];
        });
    }

    std::vector<KernelNodes> parts;  // never resized: the convolvers point into it
    std::vector<PartConvolver> convolvers;
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

}  // namespace aureole::fourier
