#include "aureole/wave/field_error.h"

#include <algorithm>
#include <cmath>

#include "aureole/fourier/kernel_nodes.h"

namespace aureole::wave {

void FieldErrorSum::add(const Image& half_blend, const Image& truth, bool with_source) {
    const Image blend = fourier::whole_kernel(half_blend);
    const int dx = (truth.width() - blend.width()) / 2;
    const int dy = (truth.height() - blend.height()) / 2;
    double difference = 0;
    double energy = 0;
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < truth.height(); ++y) {
            for (int x = 0; x < truth.width(); ++x) {
                if (!with_source && x == truth.width() / 2 && y == truth.height() / 2) continue;
                const int bx = x - dx;
                const int by = y - dy;
                const bool held = bx >= 0 && by >= 0 && bx < blend.width() && by < blend.height();
                const auto value = static_cast<double>(truth.at(x, y, c));
                difference +=
                    std::abs((held ? static_cast<double>(blend.at(bx, by, c)) : 0.0) - value);
                energy += value;
            }
        }
    }
    ++sum_.positions;
    sum_.l1 += difference;
    energy_ += energy;
    if (energy == 0) return;
    ++lit_;
    sum_.mean += difference / energy;
    sum_.worst = std::max(sum_.worst, difference / energy);
}

FieldError FieldErrorSum::error() const {
    FieldError error = sum_;
    error.l1 = energy_ > 0 ? sum_.l1 / energy_ : 0;
    error.mean = lit_ > 0 ? sum_.mean / lit_ : 0;
    return error;
}

}  // namespace aureole::wave
