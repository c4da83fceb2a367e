#include "aureole/fourier/convolver.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "aureole/base/error.h"
#include "fourier/convolver_kernels.h"
#include "fourier/scratch.h"

namespace aureole::fourier {
namespace {

void check_kernel(const ConstImageView& kernel, int channels) {
    if (kernel.width <= 0 || kernel.height <= 0 ||
        (kernel.channels != 1 && kernel.channels != channels &&
         kernel.channels != channels * channels)) {
        throw InvalidArgument("kernel",
                              std::to_string(kernel.width) + "x" + std::to_string(kernel.height) +
                                  ", " + std::to_string(kernel.channels) + " channels",
                              "must be at least 1x1 and have 1 channel, the picture's " +
                                  std::to_string(channels) + ", or one for each pair of them");
    }
}

// How far a kernel reaches from its centre in one dimension, cut to what can be seen within n
// pixels.
struct Reach {
    Reach(int kernel_size, int picture_size)
        : centre(kernel_size / 2),
          before(std::min(centre, picture_size - 1)),
          after(std::min(kernel_size - 1 - centre, picture_size - 1)) {}
    int size() const { return before + 1 + after; }
    int radius() const { return std::max(before, after); }

    int centre;
    int before;
    int after;
};

ConstImageView cut(const ConstImageView& kernel, const Reach& x, const Reach& y) {
    ConstImageView view = kernel;
    view.data += kernel.offset(x.centre - x.before, y.centre - y.before, 0);
    view.width = x.size();
    view.height = y.size();
    return view;
}

// How much the kernel's centre stands out of its neighbours. That part is a plain factor on the
// input and is kept out of the transforms: rounding leaves a ghost of about 1e-8 of the kernel at
// some fractions of the padded size from every light, and a peak's ghost would show in the dark.
float peak(const ConstImageView& kernel, int channel) {
    const int x = kernel.width / 2;
    const int y = kernel.height / 2;
    float neighbours = 0;
    int count = 0;
    for (const auto& [dx, dy] :
         {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)}) {
        if (x + dx < 0 || x + dx >= kernel.width || y + dy < 0 || y + dy >= kernel.height) continue;
        neighbours += kernel.at(x + dx, y + dy, channel);
        ++count;
    }
    const float value = kernel.at(x, y, channel);
    return count == 0 ? value : value - neighbours / static_cast<float>(count);
}

// convolve_rows() needs at least two passes; 12 = 3 * 4 has them, and so has all that is larger.
int padded(int needed) { return best_length(std::max(needed, 12)); }

std::size_t batches(int count, int size) {
    return static_cast<std::size_t>((count + size - 1) / size);
}

}  // namespace

struct Convolver::Impl {
    Impl(int w, int h, int c, const ConstImageView& kernel)
        : width(w),
          height(h),
          channels(c),
          reach_x(kernel.width, w),
          reach_y(kernel.height, h),
          simd(convolver_kernels()),
          across(padded(w + reach_x.radius())),
          down(padded(h + reach_y.radius())),
          kernel_channels(kernel.channels),
          mixes(kernel.channels != 1 && kernel.channels != c),
          slabs_per_channel(static_cast<int>(batches(down.length / 2 + 1, simd.lanes))),
          scratch(element() * (static_cast<std::size_t>(across.length) +
                               static_cast<std::size_t>(down.length + 1) *
                                   (static_cast<std::size_t>(channels) + 1) +
                               (mixes ? static_cast<std::size_t>(across.length * channels) : 0))),
          spectrum(element() * static_cast<std::size_t>(across.length) * slabs(kernel_channels)) {
        for (int k = 0; k < channels; ++k) peaks.push_back(peak(kernel, kernel_channel(k)));
        prepare(cut(kernel, reach_x, reach_y));
        slab_memory = Buffer(slab_floats(width) * slabs(channels));
    }

    std::size_t element() const { return 2 * static_cast<std::size_t>(simd.lanes); }
    std::size_t slabs(int channel_count) const {
        return static_cast<std::size_t>(slabs_per_channel) *
               static_cast<std::size_t>(channel_count);
    }
    // Whole batches of 2 V columns, and one element more: equal strides of many slabs would
    // compete for the same cache sets.
    std::size_t slab_floats(int columns) const {
        return element() *
               (batches(columns, 2 * simd.lanes) * static_cast<std::size_t>(2 * simd.lanes) + 1);
    }
    float* spectrum_of(std::size_t slab) {
        return spectrum.data() + slab * element() * static_cast<std::size_t>(across.length);
    }

    // The one that leads from a picture channel to itself.
    int kernel_channel(int channel) const {
        if (kernel_channels == 1) return 0;
        return mixes ? channel * (channels + 1) : channel;
    }

    // Transforms the kernel in the memory of its spectrum.
    void prepare(const ConstImageView& kernel) {
        // Column spectra of kernel and picture are both kept doubled; rows and columns unscaled.
        const float scale =
            0.25F / (static_cast<float>(across.length) * static_cast<float>(down.length));
        const int first_row = (down.length - reach_y.before) % down.length;
        const int first_column = (across.length - reach_x.before) % across.length;
        const std::size_t floats = element() * static_cast<std::size_t>(across.length);
        const RowPass rows{&across, kernel.width};
        std::vector<float> lower_by(static_cast<std::size_t>(kernel_channels));
        for (int k = 0; k < channels; ++k) {
            lower_by[static_cast<std::size_t>(kernel_channel(k))] =
                peaks[static_cast<std::size_t>(k)];
        }
        for (int c = 0; c < kernel_channels; ++c) {
            const ConstImageView plane = kernel.channel_range(c, 1);
            const ColumnPass columns{&down,
                                     first_row,
                                     kernel.width,
                                     lower_by[static_cast<std::size_t>(c)],
                                     reach_x.before,
                                     nullptr,
                                     spectrum.data() + slabs(c) * floats,
                                     floats,
                                     slabs_per_channel};
            parallel_for(batches(kernel.width, 2 * simd.lanes), [&](std::size_t batch, int worker) {
                simd.columns_in(columns, plane, static_cast<int>(batch), scratch.of(worker));
            });
            parallel_for(slabs(1), [&](std::size_t g, int worker) {
                simd.spectrum_rows(rows, first_column, scale, columns.slabs + g * floats,
                                   scratch.of(worker));
            });
        }
    }

    void run(const ConstImageView& in, const ImageView& out, const float* weights) noexcept {
        const std::size_t floats = slab_floats(width);
        const std::size_t column_batches = batches(width, 2 * simd.lanes);
        const ColumnPass columns{&down,
                                 0,
                                 static_cast<int>(column_batches) * 2 * simd.lanes,
                                 0.0F,
                                 -1,
                                 weights,
                                 slab_memory.data(),
                                 floats,
                                 slabs_per_channel};
        const RowPass rows{&across, width};
        parallel_for(column_batches, [&](std::size_t batch, int worker) {
            simd.columns_in(columns, in, static_cast<int>(batch), scratch.of(worker));
        });
        if (mixes) {
            parallel_for(slabs(1), [&](std::size_t g, int worker) {
                simd.mix_rows(rows, channels, slab_memory.data() + g * floats, slabs(1) * floats,
                              spectrum_of(g),
                              slabs(1) * element() * static_cast<std::size_t>(across.length),
                              scratch.of(worker));
            });
        } else {
            convolve_slabs(rows);
        }
        parallel_for(column_batches, [&](std::size_t batch, int worker) {
            simd.columns_out(columns, in, peaks.data(), out, static_cast<int>(batch),
                             scratch.of(worker));
        });
    }

    void convolve_slabs(const RowPass& rows) noexcept {
        const std::size_t floats = slab_floats(width);
        // Channels of one slab in turn: a shared kernel spectrum is read once from memory.
        parallel_for(slabs(channels), [&](std::size_t item, int worker) {
            const std::size_t g = item / static_cast<std::size_t>(channels);
            const int c = static_cast<int>(item % static_cast<std::size_t>(channels));
            simd.convolve_rows(rows, slab_memory.data() + (slabs(c) + g) * floats,
                               spectrum_of(slabs(kernel_channel(c)) + g), scratch.of(worker));
        });
    }

    int width;
    int height;
    int channels;
    Reach reach_x;
    Reach reach_y;
    ConvolverKernels simd;
    LinePlan across;
    LinePlan down;
    int kernel_channels;
    bool mixes;  // the kernel is a matrix
    int slabs_per_channel;
    Scratch scratch;
    std::vector<float> peaks;  // per picture channel
    Buffer spectrum;
    Buffer slab_memory;
};

Convolver::Convolver(int width, int height, int channels, const ConstImageView& kernel) {
    if (width <= 0 || height <= 0 || channels <= 0) {
        throw InvalidArgument("picture size",
                              std::to_string(width) + "x" + std::to_string(height) + ", " +
                                  std::to_string(channels) + " channels",
                              "all three must be positive");
    }
    check_kernel(kernel, channels);
    impl_ = std::make_unique<Impl>(width, height, channels, kernel);
}

Convolver::~Convolver() = default;
Convolver::Convolver(Convolver&&) noexcept = default;
Convolver& Convolver::operator=(Convolver&&) noexcept = default;
int Convolver::width() const noexcept { return impl_->width; }
int Convolver::height() const noexcept { return impl_->height; }
int Convolver::channels() const noexcept { return impl_->channels; }
int Convolver::padded_width() const noexcept { return impl_->across.length; }
int Convolver::padded_height() const noexcept { return impl_->down.length; }

void Convolver::run(const ConstImageView& in, const ImageView& out, const float* weights) noexcept {
    impl_->run(in, out, weights);
}

void convolve_directly(const ConstImageView& in, const ConstImageView& kernel, const ImageView& out,
                       const float* weights) {
    check_kernel(kernel, in.channels);
    if (in.width != out.width || in.height != out.height || in.channels != out.channels) {
        throw InvalidArgument("output size",
                              std::to_string(out.width) + "x" + std::to_string(out.height),
                              "must be that of the input");
    }
    const Reach reach_x(kernel.width, in.width);
    const Reach reach_y(kernel.height, in.height);
    const auto weight = [&](int x, int y) {
        return weights == nullptr ? 1.0
                                  : static_cast<double>(weights[std::ptrdiff_t{y} * in.width + x]);
    };
    parallel_for(static_cast<std::size_t>(in.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        const int first_y = std::max(0, y - reach_y.after);
        const int last_y = std::min(in.height - 1, y + reach_y.before);
        for (int c = 0; c < in.channels; ++c) {
            for (int x = 0; x < in.width; ++x) {
                const int first_x = std::max(0, x - reach_x.after);
                const int last_x = std::min(in.width - 1, x + reach_x.before);
                double sum = 0;
                const auto add_channel = [&](int from, int kernel_channel) {
                    for (int sy = first_y; sy <= last_y; ++sy) {
                        for (int sx = first_x; sx <= last_x; ++sx) {
                            const double value = in.at(sx, sy, from);
                            sum += weight(sx, sy) * value *
                                   kernel.at(reach_x.centre + x - sx, reach_y.centre + y - sy,
                                             kernel_channel);
                        }
                    }
                };
                if (kernel.channels == 1 || kernel.channels == in.channels) {
                    add_channel(c, kernel.channels == 1 ? 0 : c);
                } else {
                    for (int j = 0; j < in.channels; ++j) add_channel(j, in.channels * j + c);
                }
                out.at(x, y, c) = static_cast<float>(sum / weight(x, y));
            }
        }
    });
}

}  // namespace aureole::fourier
