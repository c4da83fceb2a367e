// Which light of a picture makes glare.
#pragma once

namespace aureole::sources {

// The continuous ramp max(0, value - threshold) of the thesis, eq. 3.2, per channel and without
// its factor 10000: nothing pops as a light crosses the threshold. A threshold of 0 passes
// everything, negative values included: the physical default.
inline float ramp(float value, float threshold) {
    if (threshold <= 0) return value;
    return value > threshold ? value - threshold : 0.0F;
}

}  // namespace aureole::sources
