#include "fourier/fft_kernels.h"

#include "fourier/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fourier/fft_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "fourier/line_transform-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::fourier::HWY_NAMESPACE {
namespace {

float* element(float* scratch, int index) {
    return scratch + static_cast<std::size_t>(index) * kElement;
}

void transform(const LinePlan& plan, bool inverse, float* x) {
    if (inverse) {
        inverse_line(plan, x, x, plan.length);
    } else {
        forward_line(plan, x, plan.length, x);
    }
}

void columns(const LinePlan& plan, bool inverse, float* re, float* im, std::ptrdiff_t row_stride,
             std::ptrdiff_t x, int count, float scale_by, float* scratch) {
    const D d;
    const int n = plan.length;
    const int* position = plan.position.data();
    re += x;
    im += x;
    const bool whole = count == kLanes;
    for (int y = 0; y < n; ++y) {
        float* to = element(scratch, inverse ? position[y] : y);
        const float* from_re = re + y * row_stride;
        const float* from_im = im + y * row_stride;
        if (whole) {
            hn::Store(hn::LoadU(d, from_re), d, to);
            hn::Store(hn::LoadU(d, from_im), d, to + kLanes);
        } else {
            for (int l = 0; l < kLanes; ++l) {
                to[l] = l < count ? from_re[l] : 0.0F;
                to[kLanes + l] = l < count ? from_im[l] : 0.0F;
            }
        }
    }
    transform(plan, inverse, scratch);
    const Vec factor = hn::Set(d, scale_by);
    for (int y = 0; y < n; ++y) {
        const float* from = element(scratch, inverse ? y : position[y]);
        float* to_re = re + y * row_stride;
        float* to_im = im + y * row_stride;
        if (whole) {
            hn::StoreU(hn::Mul(hn::Load(d, from), factor), d, to_re);
            hn::StoreU(hn::Mul(hn::Load(d, from + kLanes), factor), d, to_im);
        } else {
            for (int l = 0; l < count; ++l) {
                to_re[l] = from[l] * scale_by;
                to_im[l] = from[kLanes + l] * scale_by;
            }
        }
    }
}

// One plane of up to kLanes rows into the real (part 0) or imaginary (part 1) halves of scratch.
void load_rows(const LinePlan& plan, bool inverse, const float* plane, std::ptrdiff_t row_stride,
               int count, int first, int end, int part, float* scratch) {
    const D d;
    const int* position = plan.position.data();
    const auto target = [&](int x) HWY_ATTR {
        return element(scratch, inverse ? position[x] : x) + part * kLanes;
    };
    int x = first;
    if (count == kLanes) {
        for (; x + kLanes <= end; x += kLanes) {
            Vec tile[kLanes];
            for (int l = 0; l < kLanes; ++l) tile[l] = hn::LoadU(d, plane + l * row_stride + x);
            transpose(tile);
            for (int i = 0; i < kLanes; ++i) hn::Store(tile[i], d, target(x + i));
        }
    }
    for (; x < end; ++x) {
        float* to = target(x);
        for (int l = 0; l < kLanes; ++l) to[l] = l < count ? plane[l * row_stride + x] : 0.0F;
    }
}

void store_rows(const LinePlan& plan, bool inverse, float* plane, std::ptrdiff_t row_stride,
                int count, float scale_by, int part, float* scratch) {
    const D d;
    const int n = plan.length;
    const int* position = plan.position.data();
    const Vec factor = hn::Set(d, scale_by);
    const auto origin = [&](int x) HWY_ATTR {
        return element(scratch, inverse ? x : position[x]) + part * kLanes;
    };
    int x = 0;
    if (count == kLanes) {
        for (; x + kLanes <= n; x += kLanes) {
            Vec tile[kLanes];
            for (int i = 0; i < kLanes; ++i) {
                tile[i] = hn::Mul(hn::Load(d, origin(x + i)), factor);
            }
            transpose(tile);
            for (int l = 0; l < kLanes; ++l) hn::StoreU(tile[l], d, plane + l * row_stride + x);
        }
    }
    for (; x < n; ++x) {
        const float* from = origin(x);
        for (int l = 0; l < count; ++l) plane[l * row_stride + x] = from[l] * scale_by;
    }
}

void rows(const LinePlan& plan, bool inverse, float* re, float* im, std::ptrdiff_t row_stride,
          int count, int first, int end, float scale_by, float* scratch) {
    const auto clear = [&](int from, int to) HWY_ATTR {
        for (int x = from; x < to; ++x) store(zero(), element(scratch, x));
    };
    if (!inverse) {
        clear(0, first);
        clear(end, plan.length);
    }
    load_rows(plan, inverse, re, row_stride, count, first, end, 0, scratch);
    load_rows(plan, inverse, im, row_stride, count, first, end, 1, scratch);
    transform(plan, inverse, scratch);
    store_rows(plan, inverse, re, row_stride, count, scale_by, 0, scratch);
    store_rows(plan, inverse, im, row_stride, count, scale_by, 1, scratch);
}

}  // namespace

FftKernels make_fft_kernels() { return {kLanes, &columns, &rows}; }

}  // namespace aureole::fourier::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::fourier {
HWY_EXPORT(make_fft_kernels);
FftKernels fft_kernels() { return HWY_DYNAMIC_DISPATCH(make_fft_kernels)(); }
}  // namespace aureole::fourier
#endif
