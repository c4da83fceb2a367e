// Exposure and the clamp of highlights, row by row.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "aureole/color/rgb.h"
#include "aureole/ibl/environment_transform.h"
#include "aureole/image/image.h"

namespace aureole::ibl {

// What adjust_row() found in a row; rows are added in their order, so that sums do not depend on
// threads.
struct Tally {
    std::size_t clamped_texels = 0;
    double energy = 0;  // before clamping
    double lost = 0;

    void add(const Tally& other) {
        clamped_texels += other.clamped_texels;
        energy += other.energy;
        lost += other.lost;
    }
    // Adds to what a report says.
    void write(EnvironmentReport& report) const {
        report.clamped_texels = clamped_texels;
        report.clamped_share = energy > 0 ? lost / energy : 0;
    }
};

class Adjustment {
  public:
    explicit Adjustment(const EnvironmentTransform& transform)
        : scale_(static_cast<float>(std::exp2(transform.exposure_ev))),
          max_luminance_(transform.max_luminance.value_or(0)) {}

    bool needed() const { return scale_ != 1 || max_luminance_ > 0; }

    // Row y of three channels with pixel_stride 1, in place. solid_angle(x): of texel x, in any
    // unit.
    template <class SolidAngle>
    Tally row(const ImageView& view, int y, const SolidAngle& solid_angle) const {
        float* rgb[3] = {&view.at(0, y, 0), &view.at(0, y, 1), &view.at(0, y, 2)};
        if (scale_ != 1) {
            constexpr float kMost = std::numeric_limits<float>::max();
            for (float* plane : rgb) {
                for (int x = 0; x < view.width; ++x) {
                    plane[x] = std::clamp(scale_ * plane[x], -kMost, kMost);
                }
            }
        }
        Tally tally;
        if (max_luminance_ <= 0) return tally;
        for (int x = 0; x < view.width; ++x) {
            const double luminance = color::luminance({rgb[0][x], rgb[1][x], rgb[2][x]});
            const double energy = luminance * solid_angle(x);
            tally.energy += energy;
            if (luminance <= max_luminance_) continue;
            const double share = max_luminance_ / luminance;
            tally.lost += energy * (1 - share);
            ++tally.clamped_texels;
            for (float* plane : rgb) plane[x] = static_cast<float>(share * plane[x]);
        }
        return tally;
    }

  private:
    float scale_;
    double max_luminance_;  // 0: off
};

}  // namespace aureole::ibl
