#include "lens/matrix_path.h"

#include <algorithm>
#include <cmath>

#include "aureole/lens/glass.h"
#include "aureole/lens/paraxial.h"

namespace aureole::lens {
namespace {

// Iris and housings are kept within these ratios of each other, so that single precision can draw
// them: a stop at which the light comes to a focus is drawn as one a hundred times wider than the
// beam, a housing at a focus as one 1000 times wider than the iris. Within the beam that moves the
// image of their edges by 1 % and .1 % of its width.
constexpr double kWidestIris = 100;
constexpr double kWidestHousing = 1000;
// Ghosts in focus are drawn with this radius at least; their energy stays.
constexpr double kLeastRadiusPx = 0.25;

double away_from_zero(double value, double least) {
    return std::abs(value) >= least ? value : std::copysign(least, value);
}

struct Meridian {
    double shift_mm = 0;  // on the sensor per slope
    double iris_mm = 0;   // on the sensor per iris unit, signed
    double entrance = 0;
    double entrance_shift = 0;
    struct Clip {
        double gamma = 0;
        double radius = 0;    // signed
        double shift_mm = 0;  // on the sensor per slope
    };
    std::vector<Clip> clips;
};

// One meridian; `matrix_of` picks it.
template <class MatrixOf>
Meridian meridian(const Lens& lens, const GhostMatrices& ghost, const MatrixOf& matrix_of) {
    const auto faces = lens.faces();
    const auto reference = static_cast<std::size_t>(ghost.stop_crossings.back());
    const double stop_mm = lens.stop_radius_mm();
    const Matrix sensor = matrix_of(ghost.to_sensor);
    Matrix stop = matrix_of(ghost.crossings[reference].matrix);
    double tightest = 0;  // the largest |a_k| / r_k
    for (const CrossingMatrix& crossing : ghost.crossings) {
        const Face& face = faces[static_cast<std::size_t>(crossing.face)];
        tightest =
            std::max(tightest, std::abs(matrix_of(crossing.matrix).a) / face.semi_aperture_mm);
    }
    stop.a = away_from_zero(stop.a, tightest * stop_mm / kWidestIris);

    Meridian result;
    result.iris_mm = sensor.a * stop_mm / stop.a;
    result.shift_mm = sensor.b - sensor.a * stop.b / stop.a;
    result.entrance = stop_mm / stop.a;
    result.entrance_shift = -stop.b / stop.a;
    for (std::size_t k = 0; k < ghost.crossings.size(); ++k) {
        if (k == reference) continue;
        const Face& face = faces[static_cast<std::size_t>(ghost.crossings[k].face)];
        Matrix m = matrix_of(ghost.crossings[k].matrix);
        m.a = away_from_zero(m.a,
                             face.semi_aperture_mm * std::abs(stop.a) / (kWidestHousing * stop_mm));
        result.clips.push_back({(stop.b - stop.a * m.b / m.a) / stop_mm,
                                face.semi_aperture_mm * stop.a / (m.a * stop_mm),
                                sensor.b - sensor.a * m.b / m.a});
    }
    return result;
}

// Leaves of circles along a line those that matter, and finds the slopes between which they do.
void simplify(MatrixPath& path, const Iris& iris) {
    const double iris_outer = iris.outer_radius();
    // Two circles part at the slope at which their centres are as far apart as their radii reach.
    path.largest_slope = kLargestSlope;
    const auto part = [&](double gamma, double reach) {
        if (std::abs(gamma) * path.largest_slope > reach) {
            path.largest_slope = reach / std::abs(gamma);
        }
    };
    for (const ClipPath& a : path.clips) {
        part(a.gamma_x, a.outer(iris) + iris_outer);
        for (const ClipPath& b : path.clips) {
            part(a.gamma_x - b.gamma_x, a.outer(iris) + b.outer(iris));
        }
    }
    // The distance of centres grows with the slope: what is inside another at the largest one is
    // so at every one.
    std::vector<ClipPath> kept;
    for (std::size_t k = 0; k < path.clips.size(); ++k) {
        const ClipPath& clip = path.clips[k];
        const double inner = clip.inner(iris);
        const auto holds = [&](double gamma, double outer) {
            return std::abs(clip.gamma_x - gamma) * path.largest_slope + outer <= inner;
        };
        bool needed = !holds(0, iris_outer);
        for (std::size_t j = 0; needed && j < path.clips.size(); ++j) {
            if (j == k) continue;
            const ClipPath& other = path.clips[j];
            if (!holds(other.gamma_x, other.outer(iris))) continue;
            // Of two equal ones the first stays.
            const bool equal =
                other.gamma_x == clip.gamma_x && clip.outer(iris) <= other.inner(iris);
            needed = equal && k < j;
        }
        if (needed) kept.push_back(clip);
    }
    std::stable_sort(kept.begin(), kept.end(),
                     [](const ClipPath& a, const ClipPath& b) { return a.gamma_x < b.gamma_x; });
    path.clips = std::move(kept);
    path.free_slope = path.largest_slope;
    for (const ClipPath& clip : path.clips) {
        const double room = clip.inner(iris) - iris_outer;
        if (room <= 0) path.free_slope = 0;
        if (std::abs(clip.gamma_x) * path.free_slope > room) {
            path.free_slope = room / std::abs(clip.gamma_x);
        }
    }
}

}  // namespace

double ClipPath::inner(const Iris& shape) const {
    return std::min(std::abs(radius_u), std::abs(radius_v)) * (iris ? shape.inner_radius() : 1);
}

double ClipPath::outer(const Iris& shape) const {
    return std::max(std::abs(radius_u), std::abs(radius_v)) * (iris ? shape.outer_radius() : 1);
}

MatrixPath matrix_path(const Lens& lens, const Iris& iris, const Film& film,
                       const Bounces& bounces) {
    const GhostMatrices ghost = ghost_matrices(lens, bounces, kLineDNm);
    const Meridian x = meridian(lens, ghost, [](const Meridians& m) { return m.x; });
    const Meridian y = meridian(lens, ghost, [](const Meridians& m) { return m.y; });

    MatrixPath path;
    path.bounces = bounces;
    // Sensor +X is picture left, sensor +Y is picture down.
    path.shift_x = -x.shift_mm / film.mm_per_px;
    path.shift_y = y.shift_mm / film.mm_per_px;
    path.u_per_px = 1 / away_from_zero(-x.iris_mm / film.mm_per_px, kLeastRadiusPx);
    path.v_per_px = 1 / away_from_zero(y.iris_mm / film.mm_per_px, kLeastRadiusPx);
    path.entrance_x = x.entrance;
    path.entrance_y = y.entrance;
    path.entrance_shift_x = x.entrance_shift;
    path.entrance_shift_y = y.entrance_shift;
    path.round = true;
    std::size_t clip = 0;
    for (std::size_t k = 0; k < ghost.crossings.size(); ++k) {
        const Matrix& mx = ghost.crossings[k].matrix.x;
        const Matrix& my = ghost.crossings[k].matrix.y;
        path.round = path.round && mx.a == my.a && mx.b == my.b;
        if (static_cast<int>(k) == ghost.stop_crossings.back()) continue;
        const bool stop = ghost.crossings[k].face == lens.stop();
        const Meridian::Clip& in_x = x.clips[clip];
        const Meridian::Clip& in_y = y.clips[clip++];
        path.clips.push_back({in_x.gamma, in_y.gamma, stop ? in_x.radius : std::abs(in_x.radius),
                              stop ? in_y.radius : std::abs(in_y.radius), stop,
                              -in_x.shift_mm / film.mm_per_px, in_y.shift_mm / film.mm_per_px});
    }
    const Meridians& sensor = ghost.to_sensor;
    path.round = path.round && sensor.x.a == sensor.y.a && sensor.x.b == sensor.y.b;
    path.largest_slope = kLargestSlope;
    if (path.round) simplify(path, iris);
    return path;
}

}  // namespace aureole::lens
