// Lights on a plain ground, and plates before them.
#include <algorithm>
#include <array>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/scene/studies.h"
#include "scene/camera.h"
#include "scene/coverage.h"
#include "scene/noise.h"
#include "scene/study_checks.h"

namespace aureole::scene {
namespace {

Vec3 direction_of(double x_deg, double y_deg) {
    return {static_cast<float>(std::tan(rad_from_deg(x_deg))),
            static_cast<float>(std::tan(rad_from_deg(y_deg))), 1};
}

// The share of each pixel of a row or column that a plate's material covers between two edges, and
// the share that is hole in the direction of the row or column.
struct Shares {
    std::vector<float> plate;
    std::vector<float> hole;
};

// `sign` 1 for columns, -1 for rows: angles grow to the right and upwards.
Shares shares_along(int pixels, double axis, double focal_px, double sign, double low_deg,
                    double high_deg, const Plate& plate) {
    const auto edge = [&](double deg) {
        const double bounded = std::clamp(deg, -89.0, 89.0);
        return axis + sign * focal_px * std::tan(rad_from_deg(bounded));
    };
    const double first = std::min(edge(low_deg), edge(high_deg));
    const double last = std::max(edge(low_deg), edge(high_deg));
    const double pitch = focal_px * std::tan(rad_from_deg(plate.hole_pitch_deg));
    const double width = focal_px * std::tan(rad_from_deg(plate.hole_width_deg));
    Shares shares;
    for (int i = 0; i < pixels; ++i) {
        const double covered = std::min(last, i + 1.0) - std::max(first, 1.0 * i);
        shares.plate.push_back(static_cast<float>(std::clamp(covered, 0.0, 1.0)));
        // A hole has its middle on the axis.
        const double offset = i + 0.5 - axis + width / 2;
        shares.hole.push_back(pitch > 0 ? stripe_coverage(static_cast<float>(offset),
                                                          static_cast<float>(pitch),
                                                          static_cast<float>(width), 1)
                                        : 0);
    }
    return shares;
}

}  // namespace

Image lights_on_ground(const View& view, const color::Rgb& ground_cd_m2,
                       const std::vector<DiscLight>& discs, const std::vector<PointLight>& points) {
    constexpr double kWidest = 80;
    check_light("ground_cd_m2", ground_cd_m2);
    Image picture(view.width, view.height, 3);
    const Vec3 ground = vec(ground_cd_m2);
    const std::array<float, 3> values = {ground.x, ground.y, ground.z};
    for (int c = 0; c < 3; ++c) {
        std::fill_n(picture.plane(c), picture.pixels(), values[static_cast<std::size_t>(c)]);
    }
    const Camera camera(view, {}, 0);
    for (const DiscLight& disc : discs) {
        check_range("x_deg", disc.x_deg, -kWidest, kWidest);
        check_range("y_deg", disc.y_deg, -kWidest, kWidest);
        check_range("diameter_deg", disc.diameter_deg, 1e-6, 60);
        check_light("rgb_cd_m2", disc.rgb_cd_m2);
        add_light(cone_outline(camera, direction_of(disc.x_deg, disc.y_deg), disc.diameter_deg / 2),
                  vec(disc.rgb_cd_m2) - ground, picture);
    }
    for (const PointLight& point : points) {
        check_range("x_deg", point.x_deg, -kWidest, kWidest);
        check_range("y_deg", point.y_deg, -kWidest, kWidest);
        check_light("illuminance_lx", point.illuminance_lx);
        const auto position = camera.project_direction(direction_of(point.x_deg, point.y_deg));
        if (position) add_point(*position, vec(point.illuminance_lx), view, picture);
    }
    return picture;
}

void put_before(const Plate& plate, const View& view, const ImageView& rgb_cd_m2) {
    check_range("transmission", plate.transmission, 0, 1);
    check_range("left_deg", plate.left_deg, -90, plate.right_deg);
    check_range("right_deg", plate.right_deg, plate.left_deg, 90);
    check_range("bottom_deg", plate.bottom_deg, -90, plate.top_deg);
    check_range("top_deg", plate.top_deg, plate.bottom_deg, 90);
    check_range("hole_pitch_deg", plate.hole_pitch_deg, 0, 45);
    check_range("hole_width_deg", plate.hole_width_deg, 0, plate.hole_pitch_deg);
    check_light("rgb_cd_m2", plate.rgb_cd_m2);
    if (rgb_cd_m2.width != view.width || rgb_cd_m2.height != view.height ||
        rgb_cd_m2.channels != 3) {
        throw InvalidArgument(
            "the picture behind a plate must have the view's size and 3 channels");
    }
    const double focal_px = view.focal_length_px();
    const Shares columns =
        shares_along(view.width, view.axis_x, focal_px, 1, plate.left_deg, plate.right_deg, plate);
    const Shares rows = shares_along(view.height, view.axis_y, focal_px, -1, plate.bottom_deg,
                                     plate.top_deg, plate);
    parallel_for(static_cast<std::size_t>(view.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < view.width; ++x) {
            const auto column = static_cast<std::size_t>(x);
            const float material = columns.plate[column] * rows.plate[row] *
                                   (1 - columns.hole[column] * rows.hole[row]);
            const float passes = 1 - material * static_cast<float>(1 - plate.transmission);
            for (int c = 0; c < 3; ++c) {
                float& value = rgb_cd_m2.at(x, y, c);
                value = value * passes +
                        material * static_cast<float>(plate.rgb_cd_m2[static_cast<std::size_t>(c)]);
            }
        }
    });
}

}  // namespace aureole::scene
