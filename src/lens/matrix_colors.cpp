#include "lens/matrix_colors.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/parallel.h"
#include "lens/matrix_efficiency.h"
#include "lens/ray_colors.h"

namespace aureole::lens {
namespace {

// Ghosts of less than this share of the energy of all on the axis are left as linear optics has
// them: most are, and together they hold little.
constexpr double kLeastShare = 2e-3;
constexpr double kMostEfficient = 20;  // else the ghost is nothing like its picture

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

// The ray of a ghost that light from `tangent` (to the right, or up) sends through `u`.
Ray ray_through(const MatrixPath& path, bool along_y, double tangent, double u) {
    return along_y ? ray_from_light(0, tangent, 0,
                                    path.entrance_y * u - path.entrance_shift_y * tangent)
                   : ray_from_light(tangent, 0,
                                    path.entrance_x * u - path.entrance_shift_x * tangent, 0);
}

// The ray nearest to the middle of the opening that arrives at the sensor; false if none does.
bool nearest_ray(const MatrixPath& path, const Iris& iris, const RayColors& rays, bool along_y,
                 double tangent, Ray& ray) {
    const Opening open = opening(path, iris, along_y, -tangent);
    const double middle = 0.5 * (open.low + open.high);
    const double half = std::max(0.5 * (open.high - open.low), 1e-3);
    const auto arrives = [&](double away) {
        const Ray candidate = ray_through(path, along_y, tangent, middle + away * half);
        if (!rays.arrives(path.bounces, candidate)) return false;
        ray = candidate;
        return true;
    };
    if (arrives(0)) return true;
    // Outwards by quarters, to either side; then back towards the middle by bisection.
    constexpr int kQuarters = 4;
    constexpr int kBisections = 6;
    for (int step = 1; step <= kQuarters; ++step) {
        for (const int side : {1, -1}) {
            double good = side * 0.25 * step;
            if (!arrives(good)) continue;
            double bad = side * 0.25 * (step - 1);
            for (int i = 0; i < kBisections; ++i) {
                const double between = 0.5 * (good + bad);
                (arrives(between) ? good : bad) = between;
            }
            return true;
        }
    }
    return false;
}

// Whether a node is the mean of two others, to `tolerance` of its strongest component.
template <std::size_t N>
bool is_between(const std::array<float, N>& node, const std::array<float, N>& a,
                const std::array<float, N>& b, float tolerance) {
    float off = 0;
    float scale = 0;
    for (std::size_t c = 0; c < N; ++c) {
        off = std::max(off, std::abs(node[c] - 0.5F * (a[c] + b[c])));
        scale = std::max(scale, std::abs(node[c]));
    }
    return off <= tolerance * scale;
}

constexpr int kNodes = MatrixColors::kNodes;

// A table over nodes, known at `step` apart from each other: at first, and then wherever a straight
// line is off by more than the tolerance, down to `least_step`.
template <std::size_t N>
struct Sampler {
    std::array<float, N>* nodes;
    int least_step;
    float tolerance;

    template <class Look>
    void fill(int step, const Look& look) const {
        nodes[0] = look(0);
        for (int node = 0; node + step < kNodes; node += step) {
            nodes[node + step] = look(node + step);
            fill_between(node, node + step, look);
        }
    }

  private:
    template <class Look>
    void fill_between(int low, int high, const Look& look) const {
        if (high - low <= least_step) return straight(low, high);
        const int middle = (low + high) / 2;
        nodes[middle] = look(middle);
        if (is_between(nodes[middle], nodes[low], nodes[high], tolerance)) {
            straight(low, middle);
            straight(middle, high);
        } else {
            fill_between(low, middle, look);
            fill_between(middle, high, look);
        }
    }
    void straight(int low, int high) const {
        for (int i = low + 1; i < high; ++i) {
            const float t = static_cast<float>(i - low) / static_cast<float>(high - low);
            for (std::size_t c = 0; c < N; ++c) {
                nodes[i][c] = (1 - t) * nodes[low][c] + t * nodes[high][c];
            }
        }
    }
};

// Just inside the end, where nothing is open.
double tangent_at(double step_rad, int node) {
    return std::tan(std::min<double>(node, kNodes - 1.01) * step_rad);
}

// T_g / T_0 at all angles of one ghost.
void fill_colors(std::array<float, 3>* nodes, const MatrixPath& path, const Iris& iris,
                 const RayColors& rays, double step_rad) {
    std::array<float, 3> latest = {};
    std::vector<Incidence> scratch;
    const Sampler<3> sampler = {nodes, 1, 0.01F};
    sampler.fill(16, [&](int node) {
        const int meridians = path.round ? 1 : 2;
        std::array<double, 3> sum = {};
        int arrived = 0;
        for (int m = 0; m < meridians; ++m) {
            std::array<double, 3> color;
            Ray ray;
            const double tangent = tangent_at(step_rad, node);
            if (!nearest_ray(path, iris, rays, m == 0, tangent, ray)) continue;
            rays.color_of(path.bounces, ray, scratch, color);
            for (std::size_t c = 0; c < 3; ++c) sum[c] += color[c];
            ++arrived;
        }
        // Where linear optics sees light pass but no exact ray does: as at the angle nearby at
        // which one did.
        for (std::size_t c = 0; c < 3 && arrived > 0; ++c) {
            latest[c] = static_cast<float>(sum[c] / arrived);
        }
        return latest;
    });
}

double energy(const std::array<float, 3>& color, double beam_mm2) {
    return static_cast<double>(color[0] + color[1] + color[2]) * beam_mm2;
}

// Replaces the colours by those that give a ghost the energy of exact rays, at the angles at which
// linear optics gives it as much as `least_energy`.
void correct_by_beams(std::array<float, 3>* nodes, const MatrixPath& path, const RayColors& rays,
                      const ExactBeams& beams, std::size_t ghost, double step_rad,
                      double least_energy) {
    std::vector<Incidence> scratch;
    constexpr int kStep = 8;
    double linear_mm2[kNodes] = {};
    bool matters = false;
    for (int node = 0; node < kNodes; node += kStep) {
        linear_mm2[node] = linear_beam(path, tangent_at(step_rad, node));
        matters = matters || energy(nodes[node], linear_mm2[node]) > least_energy;
    }
    if (!matters) return;
    std::array<float, 3> corrected[kNodes];
    // Differences below the accuracy of the beams are not followed.
    const Sampler<3> sampler = {corrected, kStep, 0.03F};
    sampler.fill(16, [&](int node) {
        if (!(energy(nodes[node], linear_mm2[node]) > least_energy)) return nodes[node];
        const ExactBeam beam = beams.find(ghost, path, tangent_at(step_rad, node));
        std::array<double, 3> sum = {};
        for (int r = 0; r < beam.ray_count; ++r) {
            std::array<double, 3> color;
            if (!rays.color_of(path.bounces, beam.rays[r], scratch, color)) continue;
            for (std::size_t c = 0; c < 3; ++c) sum[c] += color[c] / beam.ray_count;
        }
        std::array<float, 3> result = {};
        const double efficiency = std::min(beam.area_mm2 / linear_mm2[node], kMostEfficient);
        for (std::size_t c = 0; c < 3; ++c) result[c] = static_cast<float>(sum[c] * efficiency);
        return result;
    });
    std::copy(corrected, corrected + kNodes, nodes);
}

}  // namespace

MatrixColors::MatrixColors(const Lens& lens, const Iris& iris, std::span<const MatrixPath> paths)
    : tables_(paths.size()) {
    const RayColors rays(lens);
    axial_ = rays.axial_transmission();
    const auto step_of = [&](std::size_t i) {
        return std::atan(paths[i].largest_slope) / (kNodes - 1);
    };
    parallel_for(paths.size(), [&](std::size_t i, int) {
        tables_[i].nodes_per_rad = 1 / step_of(i);
        fill_colors(tables_[i].rgb, paths[i], iris, rays, step_of(i));
    });
    double on_axis = 0;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        on_axis += energy(tables_[i].rgb[0], linear_beam(paths[i], 0));
    }
    const ExactBeams beams(lens, paths);
    parallel_for(paths.size(), [&](std::size_t i, int) {
        correct_by_beams(tables_[i].rgb, paths[i], rays, beams, i, step_of(i),
                         kLeastShare * on_axis);
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
