#include "eye/kernel_checks.h"

#include <fmt/format.h>

#include <cstddef>
#include <numeric>

#include "aureole/base/error.h"

namespace aureole::eye {

void check_kernel(const wave::KernelGrid& grid) {
    const auto odd = [](int size) { return size > 0 && size % 2 == 1; };
    if (!odd(grid.width) || !odd(grid.height)) {
        throw InvalidArgument("kernel size", fmt::format("{}x{}", grid.width, grid.height),
                              "must be odd and positive");
    }
    if (!(grid.pitch_deg > 0 && grid.pitch_deg < 90)) {
        throw InvalidArgument("kernel pitch", fmt::format("{}", grid.pitch_deg),
                              "must be in (0, 90) deg");
    }
}

void check_aperture(const wave::ApertureGrid& grid) {
    wave::check(grid);
    if (grid.samples < 64 || grid.samples > 16384) {
        throw InvalidArgument("aperture samples", fmt::format("{}", grid.samples),
                              "must be 64 to 16384");
    }
    if (!(grid.extent_mm >= 10 && grid.extent_mm <= 100)) {
        throw InvalidArgument("aperture extent", fmt::format("{}", grid.extent_mm),
                              "must be 10 to 100 mm");
    }
}

std::vector<double> plane_sums(const Image& image) {
    std::vector<double> sums(static_cast<std::size_t>(image.channels()));
    for (int c = 0; c < image.channels(); ++c) {
        for (int y = 0; y < image.height(); ++y) {
            const float* row = image.row(y, c);
            sums[static_cast<std::size_t>(c)] += std::accumulate(row, row + image.width(), 0.0);
        }
    }
    return sums;
}

std::array<double, 3> energy_outside(const Image& kernel) {
    std::array<double, 3> energy = {1, 1, 1};
    const auto sums = plane_sums(kernel);
    for (std::size_t c = 0; c < sums.size(); ++c) energy[c % 3] -= sums[c];
    return energy;
}

}  // namespace aureole::eye
