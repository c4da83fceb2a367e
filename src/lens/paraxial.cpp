#include "aureole/lens/paraxial.h"

#include <cmath>
#include <utility>

#include "aureole/base/error.h"
#include "lens/steps.h"

namespace aureole::lens {
namespace {

// Of one step, in the meridian in which the face has this curvature.
Matrix act(const Step& step, double curvature, double index_before, double index_after) {
    const double seen = step.backwards ? -curvature : curvature;
    return step.reflects ? reflection(seen) : refraction(seen, index_before, index_after);
}

Meridians act(const Face& face, const Step& step, double index_before, double index_after) {
    const double c = face.curvature_per_mm;
    const double in_x = face.profile == Profile::kCylinderY ? 0 : c;
    const double in_y = face.profile == Profile::kCylinderX ? 0 : c;
    return {act(step, in_x, index_before, index_after), act(step, in_y, index_before, index_after)};
}

Meridians operator*(const Meridians& left, const Meridians& right) {
    return {left.x * right.x, left.y * right.y};
}

Meridians gap(double distance_mm) { return {translation(distance_mm), translation(distance_mm)}; }

// From behind face `first` (or from the first vertex, -1) to before face `end`, or to the last
// vertex when `end` is the number of faces; straight through, x meridian.
Matrix section(const Lens& lens, const std::vector<double>& index, int first, int end) {
    const auto faces = lens.faces();
    Matrix m;
    double z = first < 0 ? 0 : faces[static_cast<std::size_t>(first)].z_mm;
    for (auto k = static_cast<std::size_t>(first + 1); k < static_cast<std::size_t>(end); ++k) {
        m = translation(faces[k].z_mm - z) * m;
        m = act(faces[k], Step{}, index[k], index[k + 1]).x * m;
        z = faces[k].z_mm;
    }
    if (end < static_cast<int>(faces.size())) {
        m = translation(faces[static_cast<std::size_t>(end)].z_mm - z) * m;
    }
    return m;
}

}  // namespace

Matrix operator*(const Matrix& left, const Matrix& right) {
    return {left.a * right.a + left.b * right.c, left.a * right.b + left.b * right.d,
            left.c * right.a + left.d * right.c, left.c * right.b + left.d * right.d};
}

Matrix translation(double distance_mm) { return {1, distance_mm, 0, 1}; }

Matrix refraction(double curvature_per_mm, double index_before, double index_after) {
    return {1, 0, (index_before - index_after) / index_after * curvature_per_mm,
            index_before / index_after};
}

Matrix reflection(double curvature_per_mm) { return {1, 0, 2 * curvature_per_mm, 1}; }

GhostMatrices ghost_matrices(const Lens& lens, const Bounces& bounces, double wavelength_nm) {
    const auto faces = lens.faces();
    const int count = static_cast<int>(faces.size());
    validate_bounces(count, bounces);
    const std::vector<double> index = lens.indices(wavelength_nm);
    GhostMatrices result;
    Meridians m;
    double z = 0;
    visit_steps(count, bounces, [&](const Step& step) {
        const auto k = static_cast<std::size_t>(step.face);
        const Face& face = faces[k];
        m = gap(std::abs(face.z_mm - z)) * m;
        z = face.z_mm;
        if (face.stop) result.stop_crossings.push_back(static_cast<int>(result.crossings.size()));
        result.crossings.push_back({step.face, m});
        const double before = index[step.backwards ? k + 1 : k];
        const double after = index[step.backwards ? k : k + 1];
        m = act(face, step, before, after) * m;
        return true;
    });
    // A sensor in front of the last vertex is reached by going back: a virtual image.
    result.to_sensor = gap(lens.sensor_z_mm() - z) * m;
    return result;
}

CardinalPoints cardinal_points(const Lens& lens, double wavelength_nm) {
    const std::vector<double> index = lens.indices(wavelength_nm);
    const int faces = static_cast<int>(lens.faces().size());
    const double last_z = lens.faces().back().z_mm;
    const Matrix system = section(lens, index, -1, faces);
    if (system.c == 0) throw InvalidArgument("the lens is afocal: it has no focal length");
    const Matrix front = section(lens, index, -1, lens.stop());
    const Matrix rear = section(lens, index, lens.stop(), faces);
    CardinalPoints points;
    points.efl_mm = -1 / system.c;
    points.bfd_mm = -system.a / system.c;
    points.front_principal_z_mm = (system.d - 1) / system.c;
    points.rear_principal_z_mm = last_z + (1 - system.a) / system.c;
    points.entrance_pupil_z_mm = front.b / front.a;
    points.entrance_pupil_diameter_mm = 2 * lens.stop_radius_mm() / std::abs(front.a);
    points.exit_pupil_z_mm = last_z - rear.b / rear.d;
    points.exit_pupil_diameter_mm = 2 * lens.stop_radius_mm() / std::abs(rear.d);
    points.f_number = points.efl_mm / points.entrance_pupil_diameter_mm;
    return points;
}

}  // namespace aureole::lens
