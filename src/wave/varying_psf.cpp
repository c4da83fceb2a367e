#include "aureole/wave/varying_psf.h"

#include <algorithm>
#include <cstddef>

namespace aureole::wave {

Psf psf_at(const VaryingPsf& psf, int x, int y) {
    const Image varying = fourier::kernel_at(psf.parts, psf.view.width, psf.view.height, x, y);
    Psf result = psf.base;
    Image& kernel = result.kernel;
    const int shift_x = varying.width() / 2 - kernel.width() / 2;
    const int shift_y = varying.height() / 2 - kernel.height() / 2;
    for (int c = 0; c < varying.channels(); ++c) {
        double energy = 0;
        double inside = 0;
        const auto at = [&](int kx, int ky) { return static_cast<double>(varying.at(kx, ky, c)); };
        for (int ky = 0; ky < varying.height(); ++ky) {
            for (int kx = 0; kx < varying.width(); ++kx) energy += at(kx, ky);
        }
        for (int ky = 0; ky < kernel.height(); ++ky) {
            for (int kx = 0; kx < kernel.width(); ++kx) {
                float& value = kernel.at(kx, ky, c);
                value = static_cast<float>((1 - energy) * static_cast<double>(value));
                const int vx = kx + shift_x;
                const int vy = ky + shift_y;
                if (vx < 0 || vy < 0 || vx >= varying.width() || vy >= varying.height()) continue;
                value += varying.at(vx, vy, c);
                inside += at(vx, vy);
            }
        }
        double& off = result.off_kernel_energy[static_cast<std::size_t>(c)];
        off = (1 - energy) * off + (energy - inside);
    }
    return result;
}

}  // namespace aureole::wave
