#include "aureole/wave/aperture.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/fourier/sizes.h"

namespace aureole::wave {
namespace {

Buffer filled(const ApertureGrid& grid, float value) {
    check(grid);
    Buffer buffer(grid.size());
    const auto n = static_cast<std::size_t>(grid.samples);
    parallel_for(n, [&](std::size_t j, int) { std::fill_n(buffer.data() + j * n, n, value); });
    return buffer;
}

}  // namespace

void check(const ApertureGrid& grid) {
    if (grid.samples < 2 || grid.samples % 2 != 0 || !fourier::is_smooth(grid.samples)) {
        throw InvalidArgument("aperture samples", std::to_string(grid.samples),
                              "must be even and a product of 2, 3, 5 and 7");
    }
    if (!(grid.extent_mm > 0) || !std::isfinite(grid.extent_mm)) {
        throw InvalidArgument("aperture extent (mm)", std::to_string(grid.extent_mm),
                              "must be positive and finite");
    }
}

Mask::Mask(const ApertureGrid& of, float value) : grid(of), values(filled(of, value)) {}

Field::Field(const ApertureGrid& of) : grid(of), re(filled(of, 0)), im(filled(of, 0)) {}

Field field_from(const Mask& mask) {
    Field field(mask.grid);
    const auto n = static_cast<std::size_t>(mask.grid.samples);
    parallel_for(n, [&](std::size_t j, int) {
        std::copy_n(mask.row(static_cast<int>(j)), n, field.re.data() + j * n);
    });
    return field;
}

void multiply(Field& field, const Mask& mask) {
    if (field.grid != mask.grid) {
        throw InvalidArgument("mask of " + std::to_string(mask.grid.samples) +
                              " samples: must have the grid of the field, " +
                              std::to_string(field.grid.samples) + " samples over " +
                              std::to_string(field.grid.extent_mm) + " mm");
    }
    const auto n = static_cast<std::size_t>(mask.grid.samples);
    parallel_for(n, [&](std::size_t j, int) {
        const float* factor = mask.row(static_cast<int>(j));
        float* re = field.re.data() + j * n;
        float* im = field.im.data() + j * n;
        for (std::size_t i = 0; i < n; ++i) {
            re[i] *= factor[i];
            im[i] *= factor[i];
        }
    });
}

double area_mm2(const Mask& mask) {
    const auto n = static_cast<std::size_t>(mask.grid.samples);
    std::vector<double> rows(n);
    parallel_for(n, [&](std::size_t j, int) {
        const float* row = mask.row(static_cast<int>(j));
        double sums[4] = {};  // independent, so that the additions overlap
        for (std::size_t i = 0; i < n; ++i) sums[i & 3U] += static_cast<double>(row[i]);
        rows[j] = sums[0] + sums[1] + sums[2] + sums[3];
    });
    double sum = 0;
    for (const double row : rows) sum += row;
    return sum * mask.grid.spacing_mm() * mask.grid.spacing_mm();
}

}  // namespace aureole::wave
