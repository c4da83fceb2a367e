// What the tests of previews have in common.
#pragma once

#include "aureole/base/units.h"
#include "aureole/ibl/preview.h"
#include "ibl/test_environments.h"

namespace aureole::ibl {

inline const PreviewMaterial kMirror = {"mirror", {1, 1, 1}, {0, 0, 0}};
inline const PreviewMaterial kWhitewash = {"whitewash", {0.04, 0.04, 0.04}, {1, 1, 1}};

inline const BrdfTable& preview_table() {
    static const BrdfTable the_table(BrdfTableKind::kGgx, 64);
    return the_table;
}

inline PreviewOptions small_preview() {
    PreviewOptions options;
    options.sphere_px = 32;
    options.samples_per_side = 2;
    options.integral_samples = 64;
    return options;
}

// Its own levels: each is the environment at its size, whatever its roughness.
inline CubeChain unfiltered(int size, int levels, CubeMap (*environment)(int)) {
    CubeChain chain;
    for (int level = 0; level < levels; ++level) chain.push_back(environment(size >> level));
    return chain;
}

inline CubeMap white(int size) { return constant_environment(size, {2, 2, 2}); }

inline CubeMap white_irradiance() {
    const auto value = static_cast<float>(2 * kPi);
    return constant_environment(1, {value, value, value});
}

}  // namespace aureole::ibl
