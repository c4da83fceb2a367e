#include "aureole/lens/cross_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/lens/glass.h"
#include "lens/cross_section_parts.h"

namespace aureole::lens {
namespace {

constexpr double kMarginMm = 8;       // of the sheet
constexpr double kImageLabelMm = 16;  // behind the image plane
constexpr double kNumbersMm = 12;     // below the glass
constexpr double kTallest = 0.62;     // height of the frame over the width of the sheet

void validate(const Lens& lens, const CrossSectionOptions& options) {
    constexpr double kLeastWidthMm = 120;
    constexpr double kMostWidthMm = 2000;
    constexpr std::size_t kMostFields = 32;
    constexpr int kMostRays = 1000;
    if (!(options.sheet_width_mm >= kLeastWidthMm && options.sheet_width_mm <= kMostWidthMm)) {
        throw InvalidArgument("sheet_width_mm", fmt::format("{}", options.sheet_width_mm),
                              fmt::format("must be in [{}, {}]", kLeastWidthMm, kMostWidthMm));
    }
    if (options.field_angles_deg.size() > kMostFields) {
        throw InvalidArgument("field angles", std::to_string(options.field_angles_deg.size()),
                              fmt::format("must be {} at most", kMostFields));
    }
    for (const double angle : options.field_angles_deg) {
        if (!(angle > -90 && angle < 90)) {
            throw InvalidArgument("field angle", fmt::format("{}", angle), "must be in (-90, 90)");
        }
    }
    if (options.rays_per_field < 0 || options.rays_per_field > kMostRays) {
        throw InvalidArgument("rays_per_field", std::to_string(options.rays_per_field),
                              fmt::format("must be in [0, {}]", kMostRays));
    }
    if (!options.ghost) return;
    const auto ghosts = enumerate_ghosts(lens, GhostSet::kAll);
    if (std::find(ghosts.begin(), ghosts.end(), *options.ghost) == ghosts.end()) {
        throw InvalidArgument(
            "ghost", fmt::format("{},{}", options.ghost->far + 1, options.ghost->near + 1),
            fmt::format("must be two different surfaces of 1 to {} that reflect, the farther "
                        "first; the stop (surface {}) and faces between equal media do not",
                        lens.faces().size(), lens.stop() + 1));
    }
}

// What must be seen: glass, stop, image.
struct Extent {
    double front_z_mm = 0;
    double back_z_mm = 0;
    double half_height_mm = 0;
    double glass_half_height_mm = 0;
};

Extent extent_of(const Lens& lens, const CrossSectionOptions& options) {
    Extent extent;
    extent.back_z_mm = lens.sensor_z_mm();
    double& glass_mm = extent.glass_half_height_mm;
    for (const Face& face : lens.faces()) {
        for (const SectionPoint& point : face_curve(face, face.semi_aperture_mm)) {
            extent.front_z_mm = std::min(extent.front_z_mm, point.z_mm);
            extent.back_z_mm = std::max(extent.back_z_mm, point.z_mm);
        }
        glass_mm = std::max(glass_mm, face.semi_aperture_mm);
    }
    // The image may be much larger than the lens: then only what the rays reach, so that the lens
    // does not become small.
    constexpr double kSteepestDeg = 60;
    double reached_mm = 0;
    for (const double angle : options.field_angles_deg) {
        const double steep = std::min(std::abs(angle), kSteepestDeg);
        reached_mm = std::max(reached_mm, lens.efl_mm() * std::tan(rad_from_deg(steep)));
    }
    const double image_mm = std::max(image_half_height_mm(lens), reached_mm);
    extent.half_height_mm =
        std::max(glass_mm, std::min(image_mm, std::max(1.5 * glass_mm, 1.1 * reached_mm)));
    return extent;
}

Plate lay_out(const Lens& lens, const CrossSectionOptions& options, Drawing& drawing) {
    const Extent extent = extent_of(lens, options);
    // Room for light to come in, at least.
    constexpr double kRunIn = 0.13;
    const double length = extent.back_z_mm - extent.front_z_mm;
    const double left = kMarginMm;
    const double width = options.sheet_width_mm - kMarginMm - kImageLabelMm - left;
    const double half = 1.06 * extent.half_height_mm;
    Plate plate;
    plate.scale =
        std::min(width / ((1 + kRunIn) * length), kTallest * options.sheet_width_mm / (2 * half));
    plate.half_height_mm = half;
    plate.glass_half_height_mm = extent.glass_half_height_mm;
    plate.back_z_mm = extent.back_z_mm;
    plate.front_z_mm = extent.back_z_mm - width / plate.scale;
    plate.origin_x_mm = left - plate.scale * plate.front_z_mm;
    const double above = options.legend ? kTitleHeightMm : kMarginMm;
    plate.axis_y_mm = above + plate.scale * half;
    drawing.width_mm = options.sheet_width_mm;
    drawing.height_mm =
        plate.axis_y_mm +
        std::max(plate.scale * half + 2, plate.scale * plate.glass_half_height_mm + kNumbersMm) +
        (options.legend ? kScalesHeightMm : kMarginMm / 2);
    return plate;
}

}  // namespace

Drawing cross_section(const Lens& lens, const CrossSectionOptions& options) {
    validate(lens, options);
    Drawing drawing;
    drawing.title = options.title.empty() ? lens.prescription().name : options.title;
    const Plate plate = lay_out(lens, options, drawing);
    draw_elements(lens, plate, drawing);
    draw_axis_and_image_plane(lens, plate, drawing);
    draw_rays(lens, options, plate, drawing);
    draw_stop(lens, plate, drawing);
    draw_face_numbers(lens, options, plate, drawing);
    if (options.legend) {
        draw_title(lens, options, drawing);
        draw_scales(options, plate, drawing);
    }
    return drawing;
}

}  // namespace aureole::lens
