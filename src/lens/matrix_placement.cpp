#include "lens/matrix_placement.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::lens {
namespace {

// A light whose image is so much blurred that no edge of a ghost is left of full height is drawn as
// a spot: half the width of the edge over the radius of what is open.
constexpr double kWidestEdge = 0.5;

std::vector<MatrixPath> paths_of(const Lens& lens, const Iris& iris, const Film& film,
                                 std::span<const Bounces> ghosts) {
    std::vector<MatrixPath> paths;
    for (const Bounces& bounces : ghosts) {
        paths.push_back(matrix_path(lens, iris, film, bounces));
    }
    return paths;
}

void block(MatrixGhost& ghost) {
    ghost.u_per_px = ghost.v_per_px = 0;
    ghost.clip_count = 0;
    ghost.energy = ghost.radius_px = ghost.open_radius_px = 0;
    std::fill(ghost.radiance, ghost.radiance + 3, 0.0F);
}

// The half width of a box of the same second moment.
double half_width(double moment) { return std::sqrt(3 * std::max(moment, 0.0)); }

}  // namespace

MatrixPlacement::MatrixPlacement(const Lens& lens, const Film& film, const Pupil& pupil,
                                 std::span<const Bounces> ghosts)
    : pupil_(pupil),
      film_(film),
      paths_(paths_of(lens, *pupil.iris, film, ghosts)),
      colors_(lens, *pupil.iris, paths_),
      whole_(whole_area(pupil)) {
    if (!pupil.iris->is_image() && pupil.iris->shape().blades > 0) chords_.emplace(*pupil.iris);
    const Iris& iris = *pupil.iris;
    iris_reach_ = pupil.texture != nullptr ? pupil.outer_radius(0) : iris.outer_radius();
    std::size_t most = 0;
    first_disc_.push_back(0);
    for (const MatrixPath& path : paths_) {
        for (std::size_t k = 0; k < path.clips.size(); ++k) {
            const ClipPath& clip = path.clips[k];
            unit_discs_.push_back({clip.gamma_x, clip.outer(iris), static_cast<int>(k)});
        }
        unit_discs_.push_back({0, iris_reach_, -1});
        std::stable_sort(unit_discs_.begin() + static_cast<std::ptrdiff_t>(first_disc_.back()),
                         unit_discs_.end(),
                         [](const LineDisc& a, const LineDisc& b) { return a.center < b.center; });
        first_disc_.push_back(unit_discs_.size());
        most = std::max(most, path.clips.size() + 1);
    }
    discs_.resize(most);
    scratch_.resize(most);
}

void MatrixPlacement::place(const sources::Light& light, std::span<MatrixGhost> placements,
                            std::span<Entrance> entrances) noexcept {
    Source source = {};
    source.slope_x = -light.tan_x;
    source.slope_y = -light.tan_y;
    source.slope = std::hypot(light.tan_x, light.tan_y);
    source.angle_rad = std::atan(source.slope);
    source.along_u = source.slope > 0 ? source.slope_x / source.slope : 1;
    source.along_v = source.slope > 0 ? source.slope_y / source.slope : 0;
    if (chords_) chords_->turn_to(source.along_u, source.along_v);
    const double cosine = 1 / std::sqrt(1 + source.slope * source.slope);
    bool seen = source.slope <= kLargestSlope;
    bool bright = false;
    for (std::size_t c = 0; c < 3; ++c) {
        source.irradiance[c] = light.solid_angle_sr * cosine *
                               static_cast<double>(light.radiance[c]) /
                               film_.irradiance_per_radiance;
        seen = seen && std::isfinite(source.irradiance[c]) && source.irradiance[c] >= 0;
        bright = bright || source.irradiance[c] > 0;
    }
    source.moment_xx = light.moment_xx;
    source.moment_xy = light.moment_xy;
    source.moment_yy = light.moment_yy;
    source.extended = light.moment_xx > 0 || light.moment_yy > 0;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        if (seen && bright) {
            place_one(source, i, placements[i], entrances[i]);
        } else {
            block(placements[i]);
        }
    }
}

MatrixGhost::Clip MatrixPlacement::clip_of(const Source& source, const MatrixPath& path,
                                           const ClipPath& clip) {
    MatrixGhost::Clip result;
    result.u0 = static_cast<float>(clip.gamma_x * source.slope_x);
    result.v0 = static_cast<float>(clip.gamma_y * source.slope_y);
    result.ru = static_cast<float>(clip.radius_u);
    result.rv = static_cast<float>(clip.radius_v);
    result.iris = clip.iris;
    result.edge = 0;
    if (source.extended) {
        const double moment = 0.5 * (clip.shift_x * clip.shift_x * source.moment_xx +
                                     clip.shift_y * clip.shift_y * source.moment_yy);
        const double per_px =
            std::sqrt(std::abs(path.u_per_px * path.v_per_px / (clip.radius_u * clip.radius_v)));
        result.edge = static_cast<float>(half_width(moment) * per_px);
    }
    return result;
}

// In a system that is the same in both meridians all centres lie on the line through the iris along
// the light's slope. False: nothing is open. `open` has the pupil's area unless it is left < 0.
bool MatrixPlacement::open_round(const Source& source, std::size_t index, MatrixGhost& ghost,
                                 OpenArea& open) noexcept {
    const MatrixPath& path = paths_[index];
    if (source.slope >= path.largest_slope) return false;
    if (source.slope <= path.free_slope) {
        if (pupil_.occluder == nullptr) open = whole_;
        return true;
    }
    std::size_t size = 0;
    std::size_t iris_at = 0;
    for (const LineDisc& at_unit_slope : discs_of(index)) {
        LineDisc disc = at_unit_slope;
        disc.center *= source.slope;
        if (disc.clip < 0) {
            iris_at = size;
        } else if (std::abs(disc.center) + iris_reach_ <= disc.radius) {
            continue;  // cuts nothing
        }
        discs_[size++] = disc;
    }
    BoundingDiscs bounds = bounding_discs({discs_.data(), size}, scratch_);
    if (bounds.discs.empty()) return false;
    // Of more clips than there is room for, the nearest to the axis of the iris are kept.
    const auto reach_of = [](const LineDisc& disc) { return disc.radius - std::abs(disc.center); };
    const LineDisc* nearest[MatrixGhost::kMaxClips];
    bool iris_cuts = false;
    for (const LineDisc& disc : bounds.discs) {
        iris_cuts =
            iris_cuts || disc.clip < 0 || path.clips[static_cast<std::size_t>(disc.clip)].iris;
        if (disc.clip < 0) continue;
        int at = ghost.clip_count;
        while (at > 0 && reach_of(*nearest[at - 1]) > reach_of(disc)) --at;
        if (at == MatrixGhost::kMaxClips) continue;
        ghost.clip_count = std::min(ghost.clip_count + 1, MatrixGhost::kMaxClips);
        for (int j = ghost.clip_count - 1; j > at; --j) nearest[j] = nearest[j - 1];
        nearest[at] = &disc;
    }
    const auto count = static_cast<std::size_t>(ghost.clip_count);
    LineClip lines[MatrixGhost::kMaxClips];
    for (std::size_t j = 0; j < count; ++j) {
        const ClipPath& clip = path.clips[static_cast<std::size_t>(nearest[j]->clip)];
        ghost.clips[j] = clip_of(source, path, clip);
        lines[j] = {nearest[j]->center, clip.radius_u, clip.iris};
    }
    if (count == 0) {
        if (pupil_.occluder == nullptr) open = whole_;
        return true;
    }
    if (pupil_.has_pictures()) return true;
    double along = 0;
    double across = 0;
    bool round_edges = !chords_;
    const double inner = pupil_.iris->inner_radius();
    if (!round_edges && !iris_cuts && bounds.discs.front().from >= -inner && bounds.high <= inner) {
        // Housings alone are left if what they leave lies within the blades.
        discs_[iris_at].radius = inner;
        bounds = bounding_discs({discs_.data(), size}, scratch_);
        round_edges = std::none_of(bounds.discs.begin(), bounds.discs.end(),
                                   [](const LineDisc& disc) { return disc.clip < 0; });
    }
    if (round_edges) {
        const CommonArea common = common_area(bounds);
        open.area = common.area;
        along = common.middle;
    } else {
        const OpenChords chords = chords_->open({lines, count});
        open.area = chords.area;
        along = chords.middle_along;
        across = chords.middle_across;
    }
    open.middle_u = along * source.along_u - across * source.along_v;
    open.middle_v = along * source.along_v + across * source.along_u;
    return true;
}

// Behind cylinders housings are ellipses anywhere; those that may cut are found one by one.
bool MatrixPlacement::open_stretched(const Source& source, const MatrixPath& path,
                                     MatrixGhost& ghost) noexcept {
    const double reach = static_cast<double>(pupil_.outer_radius(0));
    double farthest[MatrixGhost::kMaxClips];
    for (const ClipPath& path_clip : path.clips) {
        const MatrixGhost::Clip clip = clip_of(source, path, path_clip);
        const double far =
            (std::hypot(clip.u0 / clip.ru, clip.v0 / clip.rv) +
             reach / static_cast<double>(std::min(std::abs(clip.ru), std::abs(clip.rv)))) /
            (clip.iris ? std::max(pupil_.iris->inner_radius(), 1e-3) : 1);
        if (far <= 1) continue;
        int at = ghost.clip_count;
        while (at > 0 && farthest[at - 1] < far) --at;
        if (at == MatrixGhost::kMaxClips) continue;
        ghost.clip_count = std::min(ghost.clip_count + 1, MatrixGhost::kMaxClips);
        for (int j = ghost.clip_count - 1; j > at; --j) {
            farthest[j] = farthest[j - 1];
            ghost.clips[j] = ghost.clips[j - 1];
        }
        farthest[at] = far;
        ghost.clips[at] = clip;
    }
    return true;
}

void MatrixPlacement::blur(const Source& source, const MatrixPath& path, MatrixGhost& ghost) {
    const double xx = path.shift_x * path.shift_x * source.moment_xx;
    const double yy = path.shift_y * path.shift_y * source.moment_yy;
    const double half = half_width(0.5 * (xx + yy));
    ghost.edge = static_cast<float>(half * std::sqrt(std::abs(path.u_per_px * path.v_per_px)));
    const auto radius = static_cast<double>(ghost.open_radius_px);
    ghost.spot = half > kWidestEdge * radius;
    if (!ghost.spot) return;
    // Light and ghost are convolved, so their second moments add up.
    ghost.spot_xx = static_cast<float>(xx + radius * radius / 4);
    ghost.spot_yy = static_cast<float>(yy + radius * radius / 4);
    // Both shifts are of slopes, whose signs are those of the light's tangents turned.
    ghost.spot_xy = static_cast<float>(path.shift_x * path.shift_y * source.moment_xy);
}

void MatrixPlacement::place_one(const Source& source, std::size_t index, MatrixGhost& ghost,
                                Entrance& entrance) noexcept {
    const MatrixPath& path = paths_[index];
    const double center_x = film_.axis_x + path.shift_x * source.slope_x;
    const double center_y = film_.axis_y + path.shift_y * source.slope_y;
    ghost.center_x = static_cast<float>(center_x);
    ghost.center_y = static_cast<float>(center_y);
    ghost.u_per_px = static_cast<float>(path.u_per_px);
    ghost.v_per_px = static_cast<float>(path.v_per_px);
    ghost.clip_count = 0;
    ghost.edge = 0;
    ghost.spot = false;
    entrance = {static_cast<float>(path.entrance_shift_x * source.slope_x),
                static_cast<float>(path.entrance_x),
                static_cast<float>(path.entrance_shift_y * source.slope_y),
                static_cast<float>(path.entrance_y)};
    OpenArea open = {-1, 0, 0};
    const bool passes =
        path.round ? open_round(source, index, ghost, open) : open_stretched(source, path, ghost);
    if (!passes) return block(ghost);
    if (open.area < 0) {
        open =
            open_area(pupil_, entrance, {ghost.clips, static_cast<std::size_t>(ghost.clip_count)});
    }
    if (!(open.area > 0)) return block(ghost);

    // Light that enters through an area of the front arrives on one of the picture.
    const double unit_px2 = 1 / std::abs(path.u_per_px * path.v_per_px);
    const double unit_mm2 = std::abs(path.entrance_x * path.entrance_y);
    const double concentration = unit_mm2 / (unit_px2 * film_.mm_per_px * film_.mm_per_px);
    const std::array<double, 3> color = colors_.at(index, source.angle_rad);
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double radiance = source.irradiance[c] * color[c] * concentration;
        ghost.radiance[c] = static_cast<float>(radiance);
        sum += radiance;
    }
    const double area_px2 = open.area * unit_px2;
    ghost.energy = static_cast<float>(sum * area_px2);
    ghost.radius_px = static_cast<float>(std::sqrt(unit_px2));
    ghost.open_x = static_cast<float>(center_x + open.middle_u / path.u_per_px);
    ghost.open_y = static_cast<float>(center_y + open.middle_v / path.v_per_px);
    ghost.open_radius_px = static_cast<float>(std::sqrt(area_px2 / kPi));
    if (source.extended) blur(source, path, ghost);
}

}  // namespace aureole::lens
