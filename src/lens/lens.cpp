#include "aureole/lens/lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "aureole/base/error.h"
#include "aureole/lens/glass.h"
#include "aureole/lens/paraxial.h"
#include "aureole/lens/trace.h"

namespace aureole::lens {
namespace {

std::string shown(double value) { return fmt::format("{:.6g}", value); }

// Beyond this height a conic has no surface: |radius| for a sphere. Infinite if it has.
double widest_mm(const Surface& surface) {
    const double stretch = 1 + surface.conic;
    if (surface.radius_mm == 0 || stretch <= 0) return HUGE_VAL;
    return std::abs(surface.radius_mm) / std::sqrt(stretch);
}

// Height at which the ray that enters parallel to the axis at `height_mm` crosses the stop.
std::optional<double> height_at_stop(const Tracer& tracer, int stop, double height_mm) {
    const TracedRay ray = tracer.trace(Bounces{}, ray_from_light(0, 0, height_mm, 0));
    if (ray.fate != Fate::kArrived && ray.failed_face <= stop) return std::nullopt;
    return std::abs(ray.stop_x_mm);
}

// The largest height of entrance that still crosses the stop within `radius_mm`; found by
// bisection, since rays far out may miss a surface.
double entrance_height(const Tracer& tracer, int stop, double radius_mm, double paraxial_mm) {
    const auto inside = [&](double height_mm) {
        const auto at_stop = height_at_stop(tracer, stop, height_mm);
        return at_stop && *at_stop <= radius_mm;
    };
    double low = 0;
    double high = paraxial_mm;
    for (int i = 0; i < 8 && inside(high); ++i) {
        low = high;
        high *= 1.5;
    }
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (inside(middle) ? low : high) = middle;
    }
    return low;
}

// Distance from the last vertex to the image of an object `distance_mm` in front of that image,
// through a system with matrix `m` from first to last vertex, `length_mm` apart. With b that
// distance and k = distance - length, the object is k - b in front of the first vertex, and
// imaging, (a + b c)(k - b) + b0 + b d = 0, is quadratic in b:
//     c b^2 - (c k + d - a) b - (a k + b0) = 0.
// Of its two solutions, enlarged and reduced image, the reduced one, which tends to the rear focus
// for far objects. (Upright, it would belong to an object behind the front vertex.)
double image_distance(const Matrix& m, double length_mm, double distance_mm) {
    const double k = distance_mm - length_mm;
    const double p = m.c * k + m.d - m.a;
    const double under_root = p * p + 4 * m.c * (m.a * k + m.b);
    if (under_root >= 0) {
        const double q = 0.5 * (p + std::copysign(std::sqrt(under_root), p));
        const double back = -(m.a * k + m.b) / q;
        const bool in_front = k - back > 0;
        if (in_front) return back;
    }
    // Nearest: life-size, where the discriminant (c k + a + d)^2 - 4 is zero.
    const double nearest = length_mm - (2 + m.a + m.d) / m.c;
    throw InvalidArgument("focus_distance_m", shown(distance_mm / 1000),
                          fmt::format("must be 0 (infinity) or at least {:.4g}, where this lens "
                                      "images at life size, with the object in front of it",
                                      nearest / 1000));
}

}  // namespace

Lens::Lens(const Prescription& prescription, const LensSettings& settings)
    : prescription_((validate(prescription), at_position(prescription, settings.position))) {
    const auto& rows = prescription_.surfaces;
    double z = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Surface& row = rows[k];
        Face face;
        face.z_mm = z;
        face.curvature_per_mm = row.radius_mm == 0 ? 0 : 1 / row.radius_mm;
        face.conic = row.conic;
        face.asphere = row.asphere;
        face.profile = row.profile;
        face.stop = row.stop;
        face.semi_aperture_mm = std::min(row.semi_aperture_mm, widest_mm(row));
        if (face.semi_aperture_mm < row.semi_aperture_mm) {
            warnings_.push_back(fmt::format(
                "surface {}: semi-aperture {} mm clipped to {} mm, where the surface of radius {} "
                "mm ends",
                k + 1, shown(row.semi_aperture_mm), shown(face.semi_aperture_mm),
                shown(row.radius_mm)));
        }
        face.coating = coating_from_name(row.coating.empty() ? settings.coating : row.coating,
                                         index(static_cast<int>(k), kLineDNm),
                                         index(static_cast<int>(k) + 1, kLineDNm));
        if (row.stop) stop_ = static_cast<int>(k);
        faces_.push_back(std::move(face));
        if (k + 1 < rows.size()) z += row.thickness_mm;
    }

    // Seen from the last vertex.
    sensor_z_mm_ = z;
    const Matrix system = ghost_matrices(*this, Bounces{}, kLineDNm).to_sensor.x;
    efl_mm_ = -1 / system.c;
    if (!std::isfinite(efl_mm_) || efl_mm_ <= 0) {
        throw InvalidArgument("focal length", shown(efl_mm_) + " mm",
                              "must be positive: the lens forms no image");
    }
    const double back = settings.focus_distance_m == 0
                            ? -system.a / system.c
                            : image_distance(system, z, settings.focus_distance_m * 1000);
    sensor_z_mm_ = z + back;

    const Tracer tracer(*this, kLineDNm);
    Face& stop_face = faces_[static_cast<std::size_t>(stop_)];
    f_number_ = settings.f_number != 0 ? settings.f_number : prescription_.f_number;
    if (f_number_ == 0) {
        const double paraxial = cardinal_points(*this, kLineDNm).entrance_pupil_diameter_mm / 2;
        f_number_ =
            efl_mm_ / (2 * entrance_height(tracer, stop_, stop_face.semi_aperture_mm, paraxial));
        return;
    }
    if (!(f_number_ > 0) || !std::isfinite(f_number_)) {
        throw InvalidArgument("f_number", shown(f_number_), "must be positive");
    }
    const double entrance = efl_mm_ / (2 * f_number_);
    const auto solved = height_at_stop(tracer, stop_, entrance);
    if (!solved || *solved == 0) {
        throw InvalidArgument(
            "f_number", shown(f_number_),
            fmt::format("too small: a ray that enters {} mm from the axis misses the lens",
                        shown(entrance)));
    }
    // Printed f-numbers are rounded ones.
    constexpr double kRounding = 1.01;
    if (*solved > kRounding * stop_face.semi_aperture_mm) {
        warnings_.push_back(fmt::format(
            "surface {}: the stop's radius for f/{} is {} mm, more than the printed {} mm",
            stop_ + 1, shown(f_number_), shown(*solved), shown(stop_face.semi_aperture_mm)));
    }
    stop_face.semi_aperture_mm = *solved;
}

double Lens::index(int medium, double wavelength_nm) const {
    if (medium == 0) return 1;
    const Surface& row = prescription_.surfaces[static_cast<std::size_t>(medium) - 1];
    const Glass* glass = row.glass.empty() ? nullptr : find_glass(row.glass);
    // The catalogue's curve through the index of the table, which is that of one melt.
    const double n = glass ? row.index + glass->index(wavelength_nm) - glass->index_d()
                           : cauchy_index(row.index, row.abbe, wavelength_nm);
    if (!(n >= 1) || n > 10) {
        throw InvalidArgument(
            "wavelength_nm", shown(wavelength_nm),
            fmt::format("the glass behind surface {} is not defined there", medium));
    }
    return n;
}

std::vector<double> Lens::indices(double wavelength_nm) const {
    std::vector<double> indices;
    for (int k = 0; k <= static_cast<int>(prescription_.surfaces.size()); ++k) {
        indices.push_back(index(k, wavelength_nm));
    }
    return indices;
}

std::optional<double> printed_f_number(const Lens& lens) {
    Prescription table = lens.prescription();
    table.f_number = 0;
    const Lens printed(table);
    const auto at_stop = height_at_stop(Tracer(printed, kLineDNm), printed.stop(),
                                        printed.efl_mm() / (2 * printed.f_number()));
    constexpr double kFilled = 1 - 1e-6;
    if (!at_stop || *at_stop < kFilled * printed.stop_radius_mm()) return std::nullopt;
    return printed.f_number();
}

double paraxial_printed_f_number(const Lens& lens) {
    const auto stop = static_cast<std::size_t>(lens.stop());
    return cardinal_points(lens, kLineDNm).f_number * lens.stop_radius_mm() /
           lens.prescription().surfaces[stop].semi_aperture_mm;
}

}  // namespace aureole::lens
