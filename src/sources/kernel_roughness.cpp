#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/sources/clusters.h"

namespace aureole::sources {
namespace {

// One row of the kernel with two zeros on either side; rows beyond the kernel are all zero.
void padded_row(const ConstImageView& kernel, int y, int c, std::vector<double>& row) {
    row.assign(static_cast<std::size_t>(kernel.width) + 4, 0.0);
    if (y < 0 || y >= kernel.height) return;
    for (int x = 0; x < kernel.width; ++x) {
        row[static_cast<std::size_t>(x) + 2] = static_cast<double>(kernel.at(x, y, c));
    }
}

// What row y adds, with rows y - 1 and y + 1 around it.
KernelRoughness row_roughness(const std::vector<double>& above, const std::vector<double>& row,
                              const std::vector<double>& below) {
    KernelRoughness r;
    r.sum = 0;
    for (std::size_t x = 1; x + 1 < row.size(); ++x) {
        const double k = row[x];
        r.sum += std::abs(k);
        r.variation_x += std::abs(row[x + 1] - k);
        r.variation_y += std::abs(below[x] - k);
        r.curvature_xx += std::abs(row[x + 1] - 2 * k + row[x - 1]);
        r.curvature_yy += std::abs(below[x] - 2 * k + above[x]);
        r.curvature_xy += std::abs(below[x + 1] - below[x] - row[x + 1] + k);
    }
    return r;
}

KernelRoughness channel_roughness(const ConstImageView& kernel, int c) {
    // Rows -1 to height: differences across the border are in.
    std::vector<KernelRoughness> rows(static_cast<std::size_t>(kernel.height) + 2);
    parallel_for(rows.size(), [&](std::size_t i, int) {
        const int y = static_cast<int>(i) - 1;
        std::vector<double> above;
        std::vector<double> row;
        std::vector<double> below;
        padded_row(kernel, y - 1, c, above);
        padded_row(kernel, y, c, row);
        padded_row(kernel, y + 1, c, below);
        rows[i] = row_roughness(above, row, below);
    });
    KernelRoughness total;
    total.sum = 0;
    for (const KernelRoughness& r : rows) {
        total.sum += r.sum;
        total.variation_x += r.variation_x;
        total.variation_y += r.variation_y;
        total.curvature_xx += r.curvature_xx;
        total.curvature_yy += r.curvature_yy;
        total.curvature_xy += r.curvature_xy;
    }
    return total;
}

}  // namespace

KernelRoughness roughness_of(const ConstImageView& kernel) {
    if (kernel.data == nullptr || kernel.width < 1 || kernel.height < 1 || kernel.channels < 1) {
        throw InvalidArgument("kernel",
                              std::to_string(kernel.width) + "x" + std::to_string(kernel.height),
                              "must have pixels");
    }
    KernelRoughness most;
    most.sum = 0;
    for (int c = 0; c < kernel.channels; ++c) {
        const KernelRoughness r = channel_roughness(kernel, c);
        most.sum = std::max(most.sum, r.sum);
        most.variation_x = std::max(most.variation_x, r.variation_x);
        most.variation_y = std::max(most.variation_y, r.variation_y);
        most.curvature_xx = std::max(most.curvature_xx, r.curvature_xx);
        most.curvature_yy = std::max(most.curvature_yy, r.curvature_yy);
        most.curvature_xy = std::max(most.curvature_xy, r.curvature_xy);
    }
    return most;
}

}  // namespace aureole::sources
