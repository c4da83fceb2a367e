#include "fourier/convolver_kernels.h"

#include <algorithm>

#include "fourier/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fourier/convolver_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "fourier/line_transform-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::fourier::HWY_NAMESPACE {
namespace {

float* element(float* scratch, int index) {
    return scratch + static_cast<std::size_t>(index) * kElement;
}

// Columns left of x0 + 2 V that exist.
int columns_at(const ConstImageView& image, int x0) {
    return std::min(2 * kLanes, image.width - x0);
}

// Any strides, any number of columns: one sample at a time.
void gather_row(const ConstImageView& in, int x0, int y, int channel, float* to) {
    const float* from = in.data + in.offset(x0, y, channel);
    const int count = columns_at(in, x0);
    for (int l = 0; l < 2 * kLanes; ++l) to[l] = l < count ? from[l * in.pixel_stride] : 0.0F;
}

void scatter_row(const ImageView& out, int x0, int y, int channel, const float* from) {
    float* to = &out.at(x0, y, channel);
    const int count = columns_at(out, x0);
    for (int l = 0; l < count; ++l) to[l * out.pixel_stride] = from[l];
}

// The weights of 2 V pixels from (x0, y) on; 1 beyond the picture.
Complex load_weights(const ConstImageView& image, const float* weights, int x0, int y) {
    const D d;
    const float* w = weights + static_cast<std::ptrdiff_t>(y) * image.width + x0;
    const int count = columns_at(image, x0);
    if (count == 2 * kLanes) return {hn::LoadU(d, w), hn::LoadU(d, w + kLanes)};
    HWY_ALIGN float padded[2 * kLanes];
    for (int l = 0; l < 2 * kLanes; ++l) padded[l] = l < count ? w[l] : 1.0F;
    return load(padded);
}

// Row y of all channels, 2 V columns: the first V become the real parts, the next V the imaginary
// parts of element `row` of each channel's line batch.
void load_row(const ConstImageView& in, const float* weights, int x0, int y, int row,
              std::size_t channel_floats, float* lines) {
    const D d;
    const bool whole = columns_at(in, x0) == 2 * kLanes;
    if (whole && in.channels == 3 && in.pixel_stride == 3 && in.channel_stride == 1) {
        const float* from = in.data + in.offset(x0, y, 0);
        for (int half = 0; half < 2; ++half, from += 3 * kLanes) {
            Vec r;
            Vec g;
            Vec b;
            hn::LoadInterleaved3(d, from, r, g, b);
            float* to = element(lines, row) + half * kLanes;
            hn::Store(r, d, to);
            hn::Store(g, d, to + channel_floats);
            hn::Store(b, d, to + 2 * channel_floats);
        }
    } else {
        for (int c = 0; c < in.channels; ++c, lines += channel_floats) {
            float* to = element(lines, row);
            if (whole && in.pixel_stride == 1) {
                const float* from = in.data + in.offset(x0, y, c);
                hn::Store(hn::LoadU(d, from), d, to);
                hn::Store(hn::LoadU(d, from + kLanes), d, to + kLanes);
            } else {
                gather_row(in, x0, y, c, to);
            }
        }
        lines -= channel_floats * static_cast<std::size_t>(in.channels);
    }
    if (weights == nullptr) return;
    const Complex w = load_weights(in, weights, x0, y);
    for (int c = 0; c < in.channels; ++c) {
        float* to = element(lines, row) + channel_floats * static_cast<std::size_t>(c);
        const Complex value = load(to);
        store({hn::Mul(value.re, w.re), hn::Mul(value.im, w.im)}, to);
    }
}

void store_row(const ImageView& out, int x0, int y, std::size_t channel_floats,
               const float* lines) {
    const D d;
    const bool whole = columns_at(out, x0) == 2 * kLanes;
    const float* from = lines + static_cast<std::size_t>(y) * kElement;
    if (whole && out.channels == 3 && out.pixel_stride == 3 && out.channel_stride == 1) {
        float* to = &out.at(x0, y, 0);
        for (int half = 0; half < 2; ++half, to += 3 * kLanes, from += kLanes) {
            hn::StoreInterleaved3(hn::Load(d, from), hn::Load(d, from + channel_floats),
                                  hn::Load(d, from + 2 * channel_floats), d, to);
        }
        return;
    }
    for (int c = 0; c < out.channels; ++c, from += channel_floats) {
        if (whole && out.pixel_stride == 1) {
            float* to = &out.at(x0, y, c);
            hn::StoreU(hn::Load(d, from), d, to);
            hn::StoreU(hn::Load(d, from + kLanes), d, to + kLanes);
        } else {
            scatter_row(out, x0, y, c, from);
        }
    }
}

float* slab_of(const ColumnPass& pass, int channel, int group) {
    const std::size_t index =
        static_cast<std::size_t>(channel) * static_cast<std::size_t>(pass.slabs_per_channel) +
        static_cast<std::size_t>(group);
    return pass.slabs + index * pass.slab_floats;
}

// Separates the spectra of the two real columns in each line, Z = A + i B:
//   2 A(k) = Z(k) + conj Z(N - k),   2 B(k) = -i (Z(k) - conj Z(N - k)),
// and turns V frequencies x 2 V columns into slab elements. The factors 2 are undone by the scale
// of the kernel's spectrum.
void split_into_slabs(const ColumnPass& pass, int channel, int x0, float* spectrum) {
    const int n = pass.plan->length;
    const int* position = pass.plan->position.data();
    for (int g = 0; g < pass.slabs_per_channel; ++g) {
        Vec a_re[kLanes];
        Vec a_im[kLanes];
        Vec b_re[kLanes];
        Vec b_im[kLanes];
        for (int l = 0; l < kLanes; ++l) {
            const int k = g * kLanes + l;
            if (k > n / 2) {
                a_re[l] = a_im[l] = b_re[l] = b_im[l] = hn::Zero(D());
                continue;
            }
            const Complex z = load(element(spectrum, position[k]));
            const Complex mirror = load(element(spectrum, position[k == 0 ? 0 : n - k]));
            a_re[l] = hn::Add(z.re, mirror.re);
            a_im[l] = hn::Sub(z.im, mirror.im);
            b_re[l] = hn::Add(z.im, mirror.im);
            b_im[l] = hn::Sub(mirror.re, z.re);
        }
        transpose(a_re);
        transpose(a_im);
        transpose(b_re);
        transpose(b_im);
        float* slab = element(slab_of(pass, channel, g), x0);
        for (int l = 0; l < kLanes; ++l, slab += kElement) {
            if (x0 + l < pass.columns) store({a_re[l], a_im[l]}, slab);
            if (x0 + kLanes + l < pass.columns) store({b_re[l], b_im[l]}, slab + kLanes * kElement);
        }
    }
}

// The inverse: Z(k) = A(k) + i B(k) and Z(N - k) = conj A(k) + i conj B(k).
void merge_from_slabs(const ColumnPass& pass, int channel, int x0, float* spectrum) {
    const int n = pass.plan->length;
    const int* position = pass.plan->position.data();
    for (int g = 0; g < pass.slabs_per_channel; ++g) {
        Vec a_re[kLanes];
        Vec a_im[kLanes];
        Vec b_re[kLanes];
        Vec b_im[kLanes];
        const float* slab = element(slab_of(pass, channel, g), x0);
        for (int l = 0; l < kLanes; ++l, slab += kElement) {
            const Complex a = load(slab);
            const Complex b = load(slab + kLanes * kElement);
            a_re[l] = a.re;
            a_im[l] = a.im;
            b_re[l] = b.re;
            b_im[l] = b.im;
        }
        transpose(a_re);
        transpose(a_im);
        transpose(b_re);
        transpose(b_im);
        for (int l = 0; l < kLanes; ++l) {
            const int k = g * kLanes + l;
            if (k > n / 2) break;
            store({hn::Add(a_re[l], b_im[l]), hn::Sub(b_re[l], a_im[l])},
                  element(spectrum, position[k == 0 ? 0 : n - k]));
            store({hn::Sub(a_re[l], b_im[l]), hn::Add(a_im[l], b_re[l])},
                  element(spectrum, position[k]));
        }
    }
}

void columns_in(const ColumnPass& pass, const ConstImageView& in, int batch, float* scratch) {
    const int n = pass.plan->length;
    const int x0 = batch * 2 * kLanes;
    float* spectrum = scratch;
    float* lines = element(scratch, n);
    const int valid = std::min(pass.first_row + in.height, n);
    const std::size_t channel_floats = static_cast<std::size_t>(valid) * kElement;
    if (pass.first_row > 0) {
        std::fill(lines, lines + channel_floats * static_cast<std::size_t>(in.channels), 0.0F);
    }
    for (int y = 0; y < in.height; ++y) {
        const int row = (pass.first_row + y) % n;
        load_row(in, pass.weights, x0, y, row, channel_floats, lines);
    }
    for (int c = 0; c < in.channels; ++c, lines += channel_floats) {
        const int lower = pass.lower_column - x0;
        if (lower >= 0 && lower < 2 * kLanes) lines[lower] -= pass.lower_by;
        forward_line(*pass.plan, lines, valid, spectrum);
        split_into_slabs(pass, c, x0, spectrum);
    }
}

void columns_out(const ColumnPass& pass, const ConstImageView& in, const float* peaks,
                 const ImageView& out, int batch, float* scratch) {
    const int x0 = batch * 2 * kLanes;
    float* spectrum = scratch;
    float* lines = element(scratch, pass.plan->length);
    const std::size_t channel_floats = static_cast<std::size_t>(out.height) * kElement;
    for (int c = 0; c < out.channels; ++c) {
        merge_from_slabs(pass, c, x0, spectrum);
        inverse_line(*pass.plan, spectrum, lines + channel_floats * static_cast<std::size_t>(c),
                     out.height);
    }
    float* input = lines + channel_floats * static_cast<std::size_t>(out.channels);
    for (int y = 0; y < out.height; ++y) {
        load_row(in, nullptr, x0, y, 0, kElement, input);
        Complex inverse = {hn::Set(D(), 1.0F), hn::Set(D(), 1.0F)};
        if (pass.weights != nullptr) {
            const Complex w = load_weights(in, pass.weights, x0, y);
            inverse = {hn::Div(inverse.re, w.re), hn::Div(inverse.im, w.im)};
        }
        for (int c = 0; c < out.channels; ++c) {
            const auto channel = static_cast<std::size_t>(c);
            float* line = element(lines, y) + channel * channel_floats;
            const Complex spread = load(line);
            store(add_scaled({hn::Mul(spread.re, inverse.re), hn::Mul(spread.im, inverse.im)},
                             load(input + channel * kElement), peaks[c]),
                  line);
        }
        store_row(out, x0, y, channel_floats, lines);
    }
}

void convolve_rows(const RowPass& pass, float* slab, const float* spectrum, float* scratch) {
    convolve_line<Spectrum::kComplex>(*pass.plan, slab, pass.width, slab, pass.width, spectrum,
                                      scratch);
}

void convolve_node(const NodePass& pass, const float* slab, const float* spectrum, float* sum,
                   float* scratch) {
    float* x = element(scratch, pass.plan->length);
    for (int i = 0; i < pass.margin; ++i) store(zero(), element(scratch, i));
    const float* from = slab + static_cast<std::size_t>(pass.first_source) * kElement;
    float* to = element(scratch, pass.margin);
    for (int i = 0; i < pass.sources; ++i, from += kElement, to += kElement) {
        store(scale(load(from), pass.shares[i]), to);
    }
    convolve_line<Spectrum::kReal>(*pass.plan, scratch, pass.margin + pass.sources, scratch,
                                   pass.targets, spectrum, x);
    float* into = element(sum, pass.first_source - pass.margin);
    for (int i = 0; i < pass.targets; ++i, into += kElement) {
        store(add(load(into), load(element(scratch, i))), into);
    }
}

// With f(-x) = conj f(x) the transform of f is real: f + i g holds two of them.
void even_spectra(const LinePlan& plan, int reach, float scale_by, const float* first,
                  const float* second, float* spectra, float* scratch) {
    const int n = plan.length;
    for (int x = reach + 1; x < n - reach; ++x) store(zero(), element(scratch, x));
    const Vec s = hn::Set(D(), scale_by);
    for (int x = 0; x <= reach; ++x) {
        const auto at = static_cast<std::size_t>(x) * kElement;
        const Complex f = load(first + at);
        const Complex g = second == nullptr ? zero() : load(second + at);
        if (x > 0) {
            store({hn::Mul(s, hn::Add(f.re, g.im)), hn::Mul(s, hn::Sub(g.re, f.im))},
                  element(scratch, n - x));
            store({hn::Mul(s, hn::Sub(f.re, g.im)), hn::Mul(s, hn::Add(g.re, f.im))},
                  element(scratch, x));
        } else {
            store({hn::Mul(s, f.re), hn::Mul(s, g.re)}, scratch);
        }
    }
    forward_line(plan, scratch, n, spectra);
}

void mix_rows(const RowPass& pass, int channels, float* slab, std::size_t slab_floats,
              const float* spectrum, std::size_t spectrum_floats, float* scratch) {
    const int n = pass.plan->length;
    const auto count = static_cast<std::size_t>(channels);
    const std::size_t line_floats = static_cast<std::size_t>(n) * kElement;
    float* sum = scratch + count * line_floats;
    for (std::size_t j = 0; j < count; ++j) {
        forward_line(*pass.plan, slab + j * slab_floats, pass.width, scratch + j * line_floats);
    }
    for (std::size_t c = 0; c < count; ++c) {
        for (int x = 0; x < n; ++x) {
            Complex value = zero();
            for (std::size_t j = 0; j < count; ++j) {
                const float* kernel = spectrum + (count * j + c) * spectrum_floats;
                value = add(value, multiply(load(element(scratch + j * line_floats, x)),
                                            load(kernel + static_cast<std::size_t>(x) * kElement)));
            }
            store(value, element(sum, x));
        }
        inverse_line(*pass.plan, sum, slab + c * slab_floats, pass.width);
    }
}

void spectrum_rows(const RowPass& pass, int first_column, float scale_by, float* slab,
                   float* scratch) {
    const int n = pass.plan->length;
    for (int x = 0; x < n; ++x) store(zero(), element(scratch, x));
    for (int x = 0; x < pass.width; ++x) {
        store(scale(load(element(slab, x)), scale_by), element(scratch, (first_column + x) % n));
    }
    forward_line(*pass.plan, scratch, n, slab);
}

}  // namespace

ConvolverKernels make_convolver_kernels() {
    return {kLanes,    &columns_in,    &columns_out,   &convolve_rows,
            &mix_rows, &spectrum_rows, &convolve_node, &even_spectra};
}

}  // namespace aureole::fourier::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::fourier {
HWY_EXPORT(make_convolver_kernels);
ConvolverKernels convolver_kernels() { return HWY_DYNAMIC_DISPATCH(make_convolver_kernels)(); }
}  // namespace aureole::fourier
#endif
