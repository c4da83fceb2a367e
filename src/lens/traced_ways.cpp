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

}  // namespace

TracedWays::TracedWays(const Lens& lens, std::span<const Bounces> ghosts,
                       std::span<const double> wavelengths_nm)
    : faces_(lens.faces().begin(), lens.faces().end()), table_(lens, wavelengths_nm) {
    for (const double wavelength_nm : wavelengths_nm) {
        indices_.push_back(lens.indices(wavelength_nm));
    }
    sensor_distance_mm_ = static_cast<float>(lens.sensor_z_mm() - faces_.back().z_mm);
    first_.push_back(0);
    for (const Bounces& ghost : ghosts) {
        const std::vector<Step> steps = steps_of(lens, ghost);
        steps_.insert(steps_.end(), steps.begin(), steps.end());
        first_.push_back(steps_.size());
        longest_ = std::max(longest_, steps.size());
    }
}

std::vector<RayStep> TracedWays::scratch() const { return std::vector<RayStep>(longest_); }

// But for the distance and the count of stops.
RayStep TracedWays::step_at(const Step& step, std::size_t wavelength) const noexcept {
    const auto k = static_cast<std::size_t>(step.face);
    const Face& face = faces_[k];
    const std::vector<double>& index = indices_[wavelength];
    const double sign = step.backwards ? -1 : 1;
    RayStep out;
    out.shape = shape_of(face);
    out.reflects = step.reflects;
    out.curvature = static_cast<float>(sign * face.curvature_per_mm);
    out.stretch = static_cast<float>(1 + face.conic);
    out.along_x = face.profile == Profile::kCylinderY ? 0.0F : 1.0F;
    out.along_y = face.profile == Profile::kCylinderX ? 0.0F : 1.0F;
    out.index_ratio =
        static_cast<float>(step.backwards ? index[k + 1] / index[k] : index[k] / index[k + 1]);
    out.per_semi_aperture = static_cast<float>(1 / face.semi_aperture_mm);
    const std::size_t terms = std::min<std::size_t>(face.asphere.size(), kMaxAsphereTerms);
    for (std::size_t i = 0; i < terms; ++i) {
        out.asphere[i] = static_cast<float>(sign * face.asphere[i]);
    }
    if (!face.stop) {
        out.reflectance = table_.pairs(step.face, static_cast<int>(wavelength), step.backwards);
    }
    return out;
}

std::span<const RayStep> TracedWays::way(int ghost, int wavelength,
                                         std::vector<RayStep>& scratch) const noexcept {
    const auto g = static_cast<std::size_t>(ghost);
    const std::span<const Step> steps =
        std::span(steps_).subspan(first_[g], first_[g + 1] - first_[g]);
    const auto is_stop = [&](const Step& step) {
        return faces_[static_cast<std::size_t>(step.face)].stop;
    };
    auto stops_left = static_cast<int>(std::count_if(steps.begin(), steps.end(), is_stop));
    double z_mm = 0;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        RayStep& out = scratch[k];
        out = step_at(steps[k], static_cast<std::size_t>(wavelength));
        const double next_mm = faces_[static_cast<std::size_t>(steps[k].face)].z_mm;
        out.distance_mm = static_cast<float>(steps[k].backwards ? z_mm - next_mm : next_mm - z_mm);
        z_mm = next_mm;
        if (is_stop(steps[k])) out.stops_left = --stops_left;
    }
    return std::span(scratch).first(steps.size());
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
