#include "eye/real_pair.h"

#include <cmath>
#include <cstddef>

#include "aureole/base/parallel.h"

namespace aureole::eye {

void separate_amplitudes(wave::Field& field) {
    const auto n = static_cast<std::size_t>(field.grid.samples);
    parallel_for(n / 2 + 1, [&](std::size_t j, int) {
        const std::size_t opposite = (n - j) % n;
        float* re0 = field.re.data() + j * n;
        float* im0 = field.im.data() + j * n;
        float* re1 = field.re.data() + opposite * n;
        float* im1 = field.im.data() + opposite * n;
        const auto separate = [&](std::size_t i, std::size_t k) {
            const float a_re = re0[i] + re1[k];
            const float a_im = im0[i] - im1[k];
            const float b_re = im0[i] + im1[k];
            const float b_im = re1[k] - re0[i];
            const float a = 0.5F * std::sqrt(a_re * a_re + a_im * a_im);
            const float b = 0.5F * std::sqrt(b_re * b_re + b_im * b_im);
            re0[i] = a;
            re1[k] = a;
            im0[i] = b;
            im1[k] = b;
        };
        if (j == opposite) {
            separate(0, 0);
            for (std::size_t i = 1; i <= n / 2; ++i) separate(i, n - i);
        } else {
            separate(0, 0);
            for (std::size_t i = 1; i < n; ++i) separate(i, n - i);
        }
    });
}

}  // namespace aureole::eye
