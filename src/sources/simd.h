// Which instruction sets the looks at pictures are compiled for; include before hwy/highway.h.
// Those of the transforms (src/fourier/simd.h): SSE4 and AVX-512's later extensions gain nothing
// here.
#pragma once

#include <hwy/detect_targets.h>

#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSE4 | HWY_AVX3_DL)
