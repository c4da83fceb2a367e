// Which instruction sets the kernels of ibl are compiled for; include before hwy/highway.h.
// On x86: the scalar baseline, SSSE3, AVX2 + FMA and AVX-512; NEON on ARM. SSE4 and AVX-512's
// later extensions gain nothing here.
#pragma once

#include <hwy/detect_targets.h>

#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSE4 | HWY_AVX3_DL)
