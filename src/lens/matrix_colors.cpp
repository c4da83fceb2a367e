#include "lens/matrix_colors.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/parallel.h"
#include "aureole/color/spectrum.h"
#include "aureole/lens/trace.h"

namespace aureole::lens {
namespace {

constexpr int kBands = 16;

// The part of a ghost's pupil that is open to light of one slope along the line through its axis,
// in iris units.
struct Opening {
    double low, high;
};
Opening opening(const MatrixPath& path, const Iris& iris, bool along_y, double slope) {
    Opening open = {-iris.outer_radius(), iris.outer_radius()};
    for (const ClipPath& clip : path.clips) {
        const double center = (along_y ? clip.gamma_y : clip.gamma_x) * slope;
        const double radius = std::abs(along_y ? clip.radius_v : clip.radius_u) *
                              (clip.iris ? iris.outer_radius() : 1);
        open.low = std::max(open.low, center - radius);
        open.high = std::min(open.high, center + radius);
    }
    return open;
}

struct Band {
    Tracer tracer;
    double axial;  // T_0
    std::array<double, 3> rgb;
};

// The ray of a ghost that light from `tangent` (to the right, or up) sends through `u`.
Ray ray_through(const MatrixPath& path, bool along_y, double tangent, double u) {
    return along_y ? ray_from_light(0, tangent, 0,
                                    path.entrance_y * u - path.entrance_shift_y * tangent)
                   : ray_from_light(tangent, 0,
                                    path.entrance_x * u - path.entrance_shift_x * tangent, 0);
}

// Of the ray nearest to the middle of the opening that arrives at the sensor; false if none does.
bool color_at(const MatrixPath& path, const Iris& iris, std::span<const Band> bands, bool along_y,
              double tangent, std::array<double, 3>& color) {
    const Opening open = opening(path, iris, along_y, -tangent);
    const double middle = 0.5 * (open.low + open.high);
    const double half = std::max(0.5 * (open.high - open.low), 1e-3);
    // Outwards by eighths, to either side.
    constexpr int kTries = 17;
    for (int attempt = 0; attempt < kTries; ++attempt) {
        const double away = (attempt + 1) / 2 * 0.125 * (attempt % 2 == 0 ? 1 : -1);
        const Ray ray = ray_through(path, along_y, tangent, middle + away * half);
        color = {};
        bool arrives = true;
        for (const Band& band : bands) {
            const double share = band.tracer.throughput(path.bounces, ray) / band.axial;
            arrives = share > 0;
            if (!arrives) break;
            for (std::size_t c = 0; c < 3; ++c) color[c] += band.rgb[c] * share;
        }
        if (arrives) return true;
    }
    return false;
}

}  // namespace

MatrixColors::MatrixColors(const Lens& lens, const Iris& iris, std::span<const MatrixPath> paths)
    : tables_(paths.size()) {
    std::vector<Band> bands;
    for (const color::SpectralBand& band : color::sample_spectrum(kBands)) {
        Tracer tracer(lens, band.wavelength_nm);
        const double axial = tracer.throughput(Bounces{}, ray_from_light(0, 0, 0, 0));
        for (std::size_t c = 0; c < 3; ++c) axial_[c] += band.rgb[c] * axial;
        bands.push_back({std::move(tracer), axial, {band.rgb[0], band.rgb[1], band.rgb[2]}});
    }
    parallel_for(paths.size(), [&](std::size_t i, int) {
        const MatrixPath& path = paths[i];
        Table& table = tables_[i];
        const double step = std::atan(path.largest_slope) / (kNodes - 1);
        table.nodes_per_rad = 1 / step;
        for (int node = 0; node < kNodes; ++node) {
            // Just inside the end, where nothing is open.
            const double angle = std::min<double>(node, kNodes - 1.01) * step;
            const int meridians = path.round ? 1 : 2;
            std::array<double, 3> sum = {};
            int arrived = 0;
            for (int m = 0; m < meridians; ++m) {
                std::array<double, 3> color;
                if (!color_at(path, iris, bands, m == 0, std::tan(angle), color)) continue;
                for (std::size_t c = 0; c < 3; ++c) sum[c] += color[c];
                ++arrived;
            }
            // Where linear optics sees light pass but no exact ray does, as at the last angle at
            // which one did.
            for (std::size_t c = 0; c < 3; ++c) {
                table.rgb[node][c] = arrived > 0 ? static_cast<float>(sum[c] / arrived)
                                     : node > 0  ? table.rgb[node - 1][c]
                                                 : 0.0F;
            }
        }
    });
}

std::array<double, 3> MatrixColors::at(std::size_t ghost, double angle_rad) const noexcept {
    const Table& table = tables_[ghost];
    const double position = std::clamp(angle_rad * table.nodes_per_rad, 0.0, kNodes - 1.0);
    const int node = std::min(static_cast<int>(position), kNodes - 2);
    const double between = position - node;
    std::array<double, 3> color;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto low = static_cast<double>(table.rgb[node][c]);
        color[c] = low + between * (static_cast<double>(table.rgb[node + 1][c]) - low);
    }
    return color;
}

}  // namespace aureole::lens
