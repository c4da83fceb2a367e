#include "lens/blog_look.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/lens/glass.h"
#include "aureole/lens/paraxial.h"

namespace aureole::lens {
namespace {

constexpr double kImageCircleMm = 21.65;  // radius
constexpr double kLeastRadiusPx = 0.5;    // of ghosts that linear optics brings to a focus
constexpr float kFadeFrom = 0.95F;
constexpr float kFadeTo = 0.80F;

template <class T>
T smax(T a, T b, T k) {
    const T difference = a - b;
    const T h = std::clamp(T(0.5) + T(0.5) * difference / k, T(0), T(1));
    return b + h * (difference + k * (1 - h));
}

float fade(float distance) {
    const float t = std::clamp((distance - kFadeFrom) / (kFadeTo - kFadeFrom), 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

// Of one blade: 0 in the middle, 1 on its edge.
double blade_distance(const Iris& iris, const Iris::Blade& blade, double u, double v) {
    const double nu = static_cast<double>(blade.normal_u);
    const double nv = static_cast<double>(blade.normal_v);
    if (iris.blade_radius() == 0) return nu * u + nv * v;
    const double radius = iris.blade_radius() / iris.apothem();
    const double back = radius - 1;
    return std::hypot(u + back * nu, v + back * nv) - back;
}

}  // namespace

BlogField::BlogField(const Iris& iris) {
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
            const double u = (2 * i + 1.0) / kSide - 1;
            const double v = (2 * j + 1.0) / kSide - 1;
            double distance = std::hypot(u, v);
            if (iris.shape().blades > 0) distance = blade_distance(iris, iris.blades()[0], u, v);
            for (int b = 1; b < iris.shape().blades; ++b) {
                distance = smax(distance, blade_distance(iris, iris.blades()[b], u, v), kSmoothing);
            }
            distance_[static_cast<std::size_t>(j * kSide + i)] = static_cast<float>(distance);
        }
    }
}

float BlogField::distance(float u, float v) const noexcept {
    constexpr auto kLast = static_cast<float>(kSide - 1);
    const float x = std::clamp(0.5F * kSide * (u + 1) - 0.5F, 0.0F, kLast);
    const float y = std::clamp(0.5F * kSide * (v + 1) - 0.5F, 0.0F, kLast);
    const int i = std::min(static_cast<int>(x), kSide - 2);
    const int j = std::min(static_cast<int>(y), kSide - 2);
    const float fx = x - static_cast<float>(i);
    const float fy = y - static_cast<float>(j);
    const float* row = distance_.data() + j * kSide + i;
    const float low = row[0] + fx * (row[1] - row[0]);
    const float high = row[kSide] + fx * (row[kSide + 1] - row[kSide]);
    return low + fy * (high - low);
}

float BlogField::mask_at(const MatrixGhost& ghost, float u, float v) const noexcept {
    const MatrixGhost::Clip& entrance = ghost.clips[0];
    const float iris = distance(u, v);
    const float du = u - entrance.u0;
    const float dv = v - entrance.v0;
    const float clip = std::sqrt(du * du + dv * dv) / entrance.ru;
    return fade(smax(iris, clip, static_cast<float>(kSmoothing)));
}

float BlogField::mask(const MatrixGhost& ghost, float x, float y) const noexcept {
    const float u = (x - ghost.center_x) * ghost.u_per_px;
    const float v = (y - ghost.center_y) * ghost.v_per_px;
    return std::max(std::abs(u), std::abs(v)) <= 1 ? mask_at(ghost, u, v) : 0.0F;
}

double BlogField::area(const MatrixGhost& ghost) const noexcept {
    constexpr int kSteps = 32;
    float sum = 0;
    for (int j = 0; j < kSteps; ++j) {
        for (int i = 0; i < kSteps; ++i) {
            sum += mask_at(ghost, (2 * static_cast<float>(i) + 1) / kSteps - 1,
                           (2 * static_cast<float>(j) + 1) / kSteps - 1);
        }
    }
    return static_cast<double>(sum) * 4 / (kSteps * kSteps);
}

double BlogLook::random_angle(const Lens& lens, const Bounces& bounces) {
    double densest = 1;
    for (const double index : lens.indices(kLineDNm)) densest = std::max(densest, index);
    Random random((static_cast<std::uint64_t>(bounces.far) << 32U) |
                  static_cast<std::uint64_t>(bounces.near));
    return random.uniform() * std::asin(1 / densest);
}

BlogLook::BlogLook(const Lens& lens, const Iris& iris, const Film& film,
                   std::span<const Bounces> ghosts)
    : field_(iris),
      film_(film),
      stop_height_mm_(lens.stop_radius_mm()),
      entrance_height_mm_(lens.faces().front().semi_aperture_mm) {
    const GhostMatrices image = ghost_matrices(lens, Bounces{}, kLineDNm);
    const auto at_stop = static_cast<std::size_t>(image.stop_crossings.front());
    entrance_pupil_mm_ = stop_height_mm_ / image.crossings[at_stop].matrix.x.a;
    const double unit = kImageCircleMm / lens.efl_mm();
    unit_solid_angle_sr_ = unit * unit;
    for (const Bounces& bounces : ghosts) {
        const GhostMatrices matrices = ghost_matrices(lens, bounces, kLineDNm);
        Ghost ghost;
        ghost.same_side = matrices.stop_crossings.size() == 1;
        const auto stop = static_cast<std::size_t>(matrices.stop_crossings.back());
        ghost.stop_a = matrices.crossings[stop].matrix.x.a;
        ghost.stop_b = matrices.crossings[stop].matrix.x.b;
        ghost.sensor_a = matrices.to_sensor.x.a;
        ghost.sensor_b = matrices.to_sensor.x.b;
        const double cosine = std::cos(random_angle(lens, bounces));
        for (std::size_t c = 0; c < 3; ++c) {
            const std::vector<double> index = lens.indices(kWavelengthsNm[c]);
            ghost.color[c] = 1;
            for (const int face : {bounces.far, bounces.near}) {
                const auto k = static_cast<std::size_t>(face);
                ghost.color[c] *= reflectance(index[k], index[k + 1], lens.faces()[k].coating,
                                              kWavelengthsNm[c], cosine)
                                      .mean();
            }
        }
        ghosts_.push_back(ghost);
    }
}

void BlogLook::place_one(const Ghost& blog, const sources::Light& light, MatrixGhost& ghost) const {
    ghost = MatrixGhost();
    ghost.blog = &field_;
    const double tangent = std::hypot(light.tan_x, light.tan_y);
    const double theta = std::atan(tangent);
    const double axis_x = tangent > 0 ? light.tan_x / tangent : 1;  // to the light, v upwards
    const double axis_y = tangent > 0 ? light.tan_y / tangent : 0;
    if (!blog.same_side || !std::isfinite(theta) || std::abs(blog.stop_a) < 1e-6) return;

    const double entrance_1 = (stop_height_mm_ - blog.stop_b * theta) / blog.stop_a;
    const double entrance_2 = (-stop_height_mm_ - blog.stop_b * theta) / blog.stop_a;
    const double sensor_1 = blog.sensor_a * entrance_1 + blog.sensor_b * theta;
    const double sensor_2 = blog.sensor_a * entrance_2 + blog.sensor_b * theta;
    const double center_mm = 0.5 * (sensor_1 + sensor_2);
    const double radius_mm =
        std::max(0.5 * std::abs(sensor_1 - sensor_2), kLeastRadiusPx * film_.mm_per_px);
    const double radius_px = radius_mm / film_.mm_per_px;
    const double center_px = center_mm / film_.mm_per_px;

    const double clip_1 = blog.stop_a * entrance_height_mm_ + blog.stop_b * theta;
    const double clip_2 = -blog.stop_a * entrance_height_mm_ + blog.stop_b * theta;
    const double clip_center = 0.5 * (clip_1 + clip_2) / stop_height_mm_;
    const double clip_radius = 0.5 * std::abs(clip_1 - clip_2) / stop_height_mm_;

    const double pupils = (entrance_1 - entrance_2) / (2 * entrance_pupil_mm_);
    const double diameter = 2 * radius_mm / kImageCircleMm;
    const double intensity = pupils * pupils / (diameter * diameter);

    ghost.center_x = static_cast<float>(film_.axis_x + axis_x * center_px);
    ghost.center_y = static_cast<float>(film_.axis_y - axis_y * center_px);
    ghost.u_per_px = static_cast<float>(1 / radius_px);
    ghost.v_per_px = static_cast<float>(-1 / radius_px);
    ghost.clip_count = 1;
    ghost.clips[0].u0 = static_cast<float>(clip_center * axis_x);
    ghost.clips[0].v0 = static_cast<float>(clip_center * axis_y);
    ghost.clips[0].ru = ghost.clips[0].rv = static_cast<float>(clip_radius);
    const double area_px2 = field_.area(ghost) * radius_px * radius_px;
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double source =
            static_cast<double>(light.radiance[c]) * light.solid_angle_sr / unit_solid_angle_sr_;
        const double radiance = source * intensity * blog.color[c];
        if (!std::isfinite(radiance) || radiance < 0 || area_px2 <= 0) {
            ghost = MatrixGhost();
            return;
        }
        ghost.radiance[c] = static_cast<float>(radiance);
        sum += radiance;
    }
    ghost.energy = static_cast<float>(sum * area_px2);
    ghost.radius_px = static_cast<float>(radius_px);
    ghost.open_x = ghost.center_x;
    ghost.open_y = ghost.center_y;
    ghost.open_radius_px = static_cast<float>(std::sqrt(area_px2 / kPi));
}

void BlogLook::place(const sources::Light& light,
                     std::span<MatrixGhost> placements) const noexcept {
    for (std::size_t i = 0; i < ghosts_.size(); ++i) place_one(ghosts_[i], light, placements[i]);
}

MatrixDrawing BlogLook::outline(const MatrixGhost& ghost, int level) const noexcept {
    MatrixDrawing drawing;
    drawing.level = level;
    drawing.ghost = &ghost;
    const double scale = 1 << level;
    const double center = static_cast<double>(ghost.center_y) / scale - 0.5;
    const double radius = static_cast<double>(ghost.radius_px) / scale;
    constexpr double kFar = 1e8;
    drawing.row_begin = static_cast<int>(std::clamp(std::ceil(center - radius), -kFar, kFar));
    drawing.row_end = static_cast<int>(std::clamp(std::floor(center + radius) + 1, -kFar, kFar));
    return drawing;
}

void BlogLook::draw_rows(const MatrixDrawing& drawing, const CanvasLevel& level, int begin,
                         int end) const noexcept {
    const MatrixGhost& ghost = *drawing.ghost;
    const float scale = level.scale();
    const float center = ghost.center_x / scale - 0.5F;
    const float radius = ghost.radius_px / scale;
    const auto left = static_cast<float>(-level.margin);
    const auto right = static_cast<float>(level.width + level.margin - 1);
    if (center + radius < left || center - radius > right) return;
    const int first = static_cast<int>(std::ceil(std::max(center - radius, left)));
    const int last = static_cast<int>(std::floor(std::min(center + radius, right)));
    if (first > last) return;
    for (int y = std::max(begin, drawing.row_begin); y < std::min(end, drawing.row_end); ++y) {
        level.mark_used(y, first, last + 1);
        for (int x = first; x <= last; ++x) {
            const float share = field_.mask(ghost, (static_cast<float>(x) + 0.5F) * scale,
                                            (static_cast<float>(y) + 0.5F) * scale);
            for (int p = 0; p < 3; ++p) {
                level.planes[p][y * level.stride + x] += share * drawing.rgb[p];
            }
        }
    }
}

}  // namespace aureole::lens
