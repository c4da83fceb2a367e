// The poses that a flipbook holds, and which of its frames show an eye.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "eye/flipbook_selection.h"

namespace aureole::eye {
namespace {

void require(bool good, const char* name, double value, const char* allowed) {
    if (!good) throw InvalidArgument(name, fmt::format("{}", value), allowed);
}

void require_count(const char* name, int value) {
    require(value >= 1 && value <= 100, name, value, "must be 1 to 100");
}

}  // namespace

void check(const FlipbookRange& range) {
    require(range.pupil_from_mm >= 1 && range.pupil_from_mm <= 9, "smallest pupil",
            range.pupil_from_mm, "must be 1 to 9 mm");
    require(range.pupil_to_mm >= range.pupil_from_mm && range.pupil_to_mm <= 9, "largest pupil",
            range.pupil_to_mm, "must be at least the smallest, and at most 9 mm");
    require_count("texture pupils", range.texture_pupils);
    require(range.lens_states >= 1 && range.lens_states <= 99 && range.lens_states % 2 == 1,
            "lens states", range.lens_states, "must be odd, 1 to 99");
    require(range.lens_scale_span >= 0 && range.lens_scale_span <= 0.05, "lens scale span",
            range.lens_scale_span, "must be 0 to 0.05");
    require_count("vitreous phases", range.vitreous_phases);
    require(range.vitreous_step_deg > 0 && range.vitreous_step_deg <= 10, "vitreous step",
            range.vitreous_step_deg, "must be above 0, and at most 10 deg");
    require_count("covered phases", range.covered_phases);
    require_count("halo pupils", range.halo_pupils);
    require_count("streak pupils", range.streak_pupils);
    require_count("lid states", range.lid_states);
    require(range.largest_closure > 0 && range.largest_closure <= 0.95, "largest closure",
            range.largest_closure, "must be above 0, and at most 0.95");
}

std::vector<FlipbookFrame> frames_of(const FlipbookRange& range) {
    check(range);
    const FlipbookAxes axes(range);
    std::vector<FlipbookFrame> frames;
    for (int p = 0; p < axes.texture_pupils.nodes; ++p) {
        FlipbookFrame frame{Component::kCorona, axes.texture_pupils.at(p), 0, {}};
        for (int lens = 0; lens < axes.lens.nodes; ++lens) {
            frame.pose.lens_scale = axes.lens.at(lens);
            frames.push_back(frame);
        }
        frame.pose.lens_scale = 1;
        for (int phase = 1; phase < range.vitreous_phases; ++phase) {
            frame.pose.vitreous_yaw_deg = phase * range.vitreous_step_deg;
            frames.push_back(frame);
        }
        for (int lid = 1; lid < axes.closures.nodes; ++lid) {
            frame.eyelid = axes.closures.at(lid);
            for (int phase = 0; phase < range.covered_phases; ++phase) {
                frame.pose.vitreous_yaw_deg = phase * range.vitreous_step_deg;
                frames.push_back(frame);
            }
        }
    }
    for (int p = 0; p < axes.halo_pupils.nodes; ++p) {
        for (int lid = 0; lid < axes.closures.nodes; ++lid) {
            frames.push_back({Component::kHalo, axes.halo_pupils.at(p), axes.closures.at(lid), {}});
        }
    }
    for (int p = 0; p < axes.streak_pupils.nodes; ++p) {
        FlipbookFrame frame{Component::kStreaks, axes.streak_pupils.at(p), 0, {}};
        frames.push_back(frame);
        for (const bool cover : {false, true}) {
            for (int lid = 1; lid < axes.closures.nodes; ++lid) {
                frame.pose.lash_closure = axes.closures.at(lid);
                frame.eyelid = cover ? frame.pose.lash_closure : 0;
                frames.push_back(frame);
            }
        }
    }
    return frames;
}

FlipbookAxis::Place FlipbookAxis::place(double value) const noexcept {
    if (nodes <= 1 || !(last > first)) return {0, 0};
    const double position =
        std::clamp((value - first) / (last - first), 0.0, 1.0) * static_cast<double>(nodes - 1);
    const int low = std::min(static_cast<int>(position), nodes - 2);
    return {low, position - low};
}

int FlipbookAxis::nearest(double value) const noexcept {
    const Place where = place(value);
    return where.low + (where.share > 0.5 ? 1 : 0);
}

FlipbookAxes::FlipbookAxes(const FlipbookRange& range)
    : texture_pupils{range.texture_pupils, range.pupil_from_mm, range.pupil_to_mm},
      lens{range.lens_states, 1 - range.lens_scale_span, 1 + range.lens_scale_span},
      vitreous_phases(range.vitreous_phases),
      vitreous_step_deg(range.vitreous_step_deg),
      covered_phases(range.covered_phases),
      halo_pupils{range.pupil_to_mm < kHaloFromMm ? 0 : range.halo_pupils,
                  std::max(range.pupil_from_mm, kHaloFromMm), range.pupil_to_mm},
      streak_pupils{range.streak_pupils, range.pupil_from_mm, range.pupil_to_mm},
      closures{range.lid_states, 0, range.largest_closure} {
    if (lens.nodes == 1) lens.first = 1;
    first_halo = static_cast<std::size_t>(texture_pupils.nodes * states());
    first_streaks = first_halo + static_cast<std::size_t>(halo_pupils.nodes * closures.nodes);
    frames =
        first_streaks + static_cast<std::size_t>(streak_pupils.nodes * (2 * closures.nodes - 1));
}

std::size_t texture_frame(const FlipbookAxes& axes, const Eye& eye) noexcept {
    const auto steps = [&](double angle_deg) {
        return std::llround(angle_deg / axes.vitreous_step_deg);
    };
    const Pose& pose = eye.pose;
    const long long turned = steps(pose.vitreous_yaw_deg) + 2 * steps(pose.vitreous_pitch_deg) +
                             3 * steps(pose.vitreous_roll_deg);
    const auto phase_of = [](long long steps_in_all, int loop) {
        return static_cast<int>((steps_in_all % loop + loop) % loop);
    };
    const int lens = axes.lens.nearest(pose.lens_scale);
    const int lid = axes.closures.nearest(eye.eyelid);
    int state = 0;
    if (lid > 0) {
        const int phase = phase_of(turned + lens - axes.lens.nodes / 2, axes.covered_phases);
        state = axes.open_states() + (lid - 1) * axes.covered_phases + phase;
    } else {
        const int phase = phase_of(turned, axes.vitreous_phases);
        state = phase == 0 ? lens : axes.lens.nodes + phase - 1;
    }
    const int pupil = axes.texture_pupils.nearest(eye.pupil_diameter_mm);
    return static_cast<std::size_t>(pupil * axes.states() + state);
}

FlipbookParts halo_parts(const FlipbookAxes& axes, const Eye& eye) noexcept {
    FlipbookParts parts;
    if (axes.halo_pupils.nodes == 0) return parts;
    const auto [pupil, pupil_share] = axes.halo_pupils.place(eye.pupil_diameter_mm);
    const auto [lid, lid_share] = axes.closures.place(eye.eyelid);
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            const int frame = (pupil + i) * axes.closures.nodes + lid + j;
            parts.add(
                axes.first_halo + static_cast<std::size_t>(frame),
                (i == 0 ? 1 - pupil_share : pupil_share) * (j == 0 ? 1 - lid_share : lid_share));
        }
    }
    return parts;
}

FlipbookParts streak_parts(const FlipbookAxes& axes, const Eye& eye) noexcept {
    FlipbookParts parts;
    const double closure = std::max(eye.eyelid, eye.pose.lash_closure);
    const double covering = closure > 0 ? eye.eyelid / closure : 0;
    const auto [pupil, pupil_share] = axes.streak_pupils.place(eye.pupil_diameter_mm);
    const auto [lid, lid_share] = axes.closures.place(closure);
    const int states = 2 * axes.closures.nodes - 1;
    const auto add = [&](int p, int state, double factor) {
        parts.add(axes.first_streaks + static_cast<std::size_t>(p * states + state), factor);
    };
    for (int i = 0; i < 2; ++i) {
        const double by_pupil = i == 0 ? 1 - pupil_share : pupil_share;
        for (int j = 0; j < 2; ++j) {
            const double factor = by_pupil * (j == 0 ? 1 - lid_share : lid_share);
            const int node = lid + j;
            if (node == 0) {
                add(pupil + i, 0, factor);
            } else {
                add(pupil + i, node, factor * (1 - covering));
                add(pupil + i, node + axes.closures.nodes - 1, factor * covering);
            }
        }
    }
    return parts;
}

}  // namespace aureole::eye
