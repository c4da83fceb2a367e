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

// T_g / T_0 of one ray; false if it does not arrive in some band.
bool color_of(const MatrixPath& path, std::span<const Band> bands, const Ray& ray,
              std::array<double, 3>& color) {
    color = {};
    for (const Band& band : bands) {
        const double share = band.tracer.throughput(path.bounces, ray) / band.axial;
        if (!(share > 0)) return false;
        for (std::size_t c = 0; c < 3; ++c) color[c] += band.rgb[c] * share;
    }
    return true;
}

// Of the ray nearest to the middle of the opening that arrives at the sensor; false if none does.
bool color_at(const MatrixPath& path, const Iris& iris, std::span<const Band> bands, bool along_y,
              double tangent, std::array<double, 3>& color) {
    const Opening open = opening(path, iris, along_y, -tangent);
    const double middle = 0.5 * (open.low + open.high);
    const double half = std::max(0.5 * (open.high - open.low), 1e-3);
    const auto arrives = [&](double away, std::array<double, 3>& result) {
        return color_of(path, bands, ray_through(path, along_y, tangent, middle + away * half),
                        result);
    };
    if (arrives(0, color)) return true;
    // Outwards by quarters, to either side; then back towards the middle by bisection.
    constexpr int kQuarters = 4;
    constexpr int kBisections = 6;
    for (int step = 1; step <= kQuarters; ++step) {
        for (const int side : {1, -1}) {
            double good = side * 0.25 * step;
            if (!arrives(good, color)) continue;
            double bad = side * 0.25 * (step - 1);
            for (int i = 0; i < kBisections; ++i) {
                const double between = 0.5 * (good + bad);
                std::array<double, 3> nearer;
                if (arrives(between, nearer)) {
                    good = between;
                    color = nearer;
                } else {
                    bad = between;
                }
            }
            return true;
        }
    }
    return false;
}

// Whether `color` is the mean of two others to 1 % of itself, in its strongest component.
bool is_between(const std::array<float, 3>& color, const std::array<float, 3>& a,
                const std::array<float, 3>& b) {
    float off = 0;
    float scale = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        off = std::max(off, std::abs(color[c] - 0.5F * (a[c] + b[c])));
        scale = std::max(scale, std::abs(color[c]));
    }
    return off <= 0.01F * scale;
}

// Fills the nodes between two known ones: looks at the middle, and goes on on both sides of it
// unless a straight line does.
template <class Look>
void fill_between(std::array<float, 3>* nodes, int low, int high, const Look& look) {
    if (high - low < 2) return;
    const int middle = (low + high) / 2;
    nodes[middle] = look(middle);
    if (!is_between(nodes[middle], nodes[low], nodes[high])) {
        fill_between(nodes, low, middle, look);
        fill_between(nodes, middle, high, look);
        return;
    }
    for (int i = low + 1; i < high; ++i) {
        const int from = i < middle ? low : middle;
        const int to = i < middle ? middle : high;
        const float t = static_cast<float>(i - from) / static_cast<float>(to - from);
        for (std::size_t c = 0; c < 3 && i != middle; ++c) {
            nodes[i][c] = (1 - t) * nodes[from][c] + t * nodes[to][c];
        }
    }
}

}  // namespace

MatrixColors::MatrixColors(const Lens& lens, const Iris& iris, std::span<const MatrixPath> paths)
    : tables_(paths.size()) {
    std::vector<Band> bands;
    for (const color::SpectralBand& band : color::sample_spectrum(kBands)) {
        Tracer tracer(lens, band.wavelength_nm);
        const double axial = tracer.throughput(Bounces{}, ray_from_light(0, 0, 0, 0));
        for (std::size_t c = 0; c < 3; ++c) axial_[c] += band.rgb[c] * axial;
        bands.push_back({std::move(tracer), axial, band.rgb});
    }
    parallel_for(paths.size(), [&](std::size_t i, int) {
        const MatrixPath& path = paths[i];
        Table& table = tables_[i];
        const double step = std::atan(path.largest_slope) / (kNodes - 1);
        table.nodes_per_rad = 1 / step;
        std::array<float, 3> latest = {};
        const auto look = [&](int node) {
            // Just inside the end, where nothing is open.
            const double tangent = std::tan(std::min<double>(node, kNodes - 1.01) * step);
            const int meridians = path.round ? 1 : 2;
            std::array<double, 3> sum = {};
            int arrived = 0;
            for (int m = 0; m < meridians; ++m) {
                std::array<double, 3> color;
                if (!color_at(path, iris, bands, m == 0, tangent, color)) continue;
                for (std::size_t c = 0; c < 3; ++c) sum[c] += color[c];
                ++arrived;
            }
            // Where linear optics sees light pass but no exact ray does: as at the angle nearby at
            // which one did.
            for (std::size_t c = 0; c < 3 && arrived > 0; ++c) {
                latest[c] = static_cast<float>(sum[c] / arrived);
            }
            return latest;
        };
        constexpr int kCoarsest = 16;
        table.rgb[0] = look(0);
        for (int node = 0; node + kCoarsest < kNodes; node += kCoarsest) {
            table.rgb[node + kCoarsest] = look(node + kCoarsest);
            fill_between(table.rgb, node, node + kCoarsest, look);
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
