#include "lens/traced_ways.h"

#include <algorithm>

namespace aureole::lens {
namespace {

RayStep::Shape shape_of(const Face& face) {
    if (!face.asphere.empty()) return RayStep::Shape::kAsphere;
    if (face.curvature_per_mm == 0) return RayStep::Shape::kPlane;
    if (face.conic != 0 || face.profile != Profile::kRotational) return RayStep::Shape::kConic;
    return RayStep::Shape::kSphere;
}

RayStep step_at(const Face& face, const Step& step, std::span<const double> index) {
    const double sign = step.backwards ? -1 : 1;
    RayStep out;
    out.shape = shape_of(face);
    out.reflects = step.reflects;
    out.curvature = static_cast<float>(sign * face.curvature_per_mm);
    out.stretch = static_cast<float>(1 + face.conic);
    out.along_x = face.profile == Profile::kCylinderY ? 0.0F : 1.0F;
    out.along_y = face.profile == Profile::kCylinderX ? 0.0F : 1.0F;
    const auto k = static_cast<std::size_t>(step.face);
    out.index_ratio =
        static_cast<float>(step.backwards ? index[k + 1] / index[k] : index[k] / index[k + 1]);
    out.per_semi_aperture = static_cast<float>(1 / face.semi_aperture_mm);
    for (std::size_t i = 0; i < std::min<std::size_t>(face.asphere.size(), kMaxAsphereTerms); ++i) {
        out.asphere[i] = static_cast<float>(sign * face.asphere[i]);
    }
    return out;
}

}  // namespace

TracedWays::TracedWays(const Lens& lens, std::span<const Bounces> ghosts,
                       std::span<const double> wavelengths_nm)
    : bands_(static_cast<int>(wavelengths_nm.size())), table_(lens, wavelengths_nm) {
    const auto faces = lens.faces();
    std::vector<std::vector<double>> indices;
    for (const double wavelength_nm : wavelengths_nm) {
        indices.push_back(lens.indices(wavelength_nm));
    }
    sensor_distance_mm_ = static_cast<float>(lens.sensor_z_mm() - faces.back().z_mm);
    first_.push_back(0);
    for (const Bounces& ghost : ghosts) {
        const std::vector<Step> steps = steps_of(lens, ghost);
        for (int band = 0; band < bands_; ++band) {
            int stops_left = static_cast<int>(std::count_if(
                steps.begin(), steps.end(), [&](const Step& s) { return s.face == lens.stop(); }));
            double z_mm = 0;
            for (const Step& step : steps) {
                const Face& face = faces[static_cast<std::size_t>(step.face)];
                RayStep out = step_at(face, step, indices[static_cast<std::size_t>(band)]);
                // Only the way back runs towards the scene: `backwards` tells how light arrives.
                out.distance_mm =
                    static_cast<float>(step.backwards ? z_mm - face.z_mm : face.z_mm - z_mm);
                z_mm = face.z_mm;
                if (face.stop) {
                    out.stops_left = --stops_left;
                } else {
                    out.reflectance = table_.pairs(step.face, band, step.backwards);
                }
                steps_.push_back(out);
            }
            first_.push_back(steps_.size());
        }
    }
}

std::span<const RayStep> TracedWays::way(int ghost, int band) const {
    const auto at = static_cast<std::size_t>(ghost * bands_ + band);
    return std::span(steps_).subspan(first_[at], first_[at + 1] - first_[at]);
}

IrisField iris_field(const Iris& iris) {
    static_assert(sizeof(Iris::Blade) == 2 * sizeof(float));
    IrisField field;
    field.blades = iris.is_image() ? 0 : iris.shape().blades;
    field.normals = &iris.blades()->normal_u;
    field.apothem = static_cast<float>(iris.apothem());
    field.blade_radius = static_cast<float>(iris.blade_radius());
    field.smoothing = static_cast<float>(iris.shape().smoothing);
    field.offset = iris.is_image() ? static_cast<float>(iris.outer_radius()) - 1 : 0.0F;
    return field;
}

}  // namespace aureole::lens
