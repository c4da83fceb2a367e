// A scatter model integrated over the pixels of a kernel.
//
// In kernel pixels, rho away from the source, the energy per pixel area of a density D(theta) is
//     perspective:     D(theta) cos^3(theta) / f^2,          theta = atan(rho / f)
//     constant pitch:  D(theta) sin(theta) / theta * p^2,    theta = rho p  (azimuthal equidistant)
// and a pixel holds its integral over the unit square. The core of the eye's PSF is 0.005 deg
// wide, a seventh of a usual pixel, so the square around the source is the exact complement of the
// energy outside it, the pixels next to it are subdivided until they have converged, and those
// farther than kExactRadius come from a table over rho.
#pragma once

#include <vector>

#include "aureole/eye/scatter.h"
#include "aureole/image/image.h"
#include "aureole/wave/psf.h"

namespace aureole::eye {

class ScatterPixels {
  public:
    ScatterPixels(const ScatterPsf& scatter, const wave::KernelGrid& grid);

    // Energy in the pixels (dx, dy), dx = 0 .. count - 1, relative to the central pixel; dy >= 0.
    void row(int dy, int count, float* energy) const;

    // The central pixels, `width` x `height` (both odd) of them; one channel.
    Image image(int width, int height) const;

    // Share of energy that misses the kernel: an integral of the model over the outside, along
    // the kernel's edge, independent of the pixels.
    double off_kernel_energy() const { return off_kernel_energy_; }

  private:
    // Accuracy of the pixels within this distance: 1e-6 by subdivision. Beyond, the mean over a
    // pixel depends on its direction by less than 1e-6.
    static constexpr int kExactRadius = 16;

    double energy_outside(double half_width_px, double half_height_px) const;
    double angle_deg(double rho_px) const;
    double per_pixel_area(double rho_px) const;
    double exact_pixel(int dx, int dy) const;
    void tabulate(double max_rho_px);

    ScatterPsf scatter_;
    wave::KernelGrid grid_;
    double focal_length_px_;
    double off_kernel_energy_;
    std::vector<float> near_;   // (kExactRadius + 1)^2
    std::vector<float> table_;  // over the squared distance, from table_node(kExactRadius^2)
};

}  // namespace aureole::eye
