// What a flipbook differs by from direct computation.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/eye/flipbook_bake.h"
#include "aureole/eye/flipbook_player.h"
#include "eye/flipbook_selection.h"
#include "eye/flipbook_terms.h"

namespace aureole::eye {
namespace {

constexpr double kRingDeg = 0.1;

// Sums of squares of differences and of what should be.
struct Squares {
    double difference = 0;
    double wanted = 0;
    double root() const { return wanted > 0 ? std::sqrt(difference / wanted) : 0; }
};

class Measurement {
  public:
    Measurement(const Flipbook& book, const Eye& eye, const EyePsfOptions& options)
        : book_(book),
          options_(options),
          player_(book, eye, options.spectral, book.grid()),
          angle_deg_(book.grid().width, book.grid().height, 1),
          played_(book.grid().width, book.grid().height, 3) {
        if (options.aperture != book.aperture()) {
            throw InvalidArgument("the flipbook was baked with another aperture raster");
        }
        errors_.to_deg =
            std::min(errors_.to_deg, flipbook_whole_to_deg(book.grid(), book.aperture()));
        psf_.kernel = played_;
        const View view = book.grid().view();
        for (int y = 0; y < angle_deg_.height(); ++y) {
            for (int x = 0; x < angle_deg_.width(); ++x) {
                angle_deg_.at(x, y) =
                    static_cast<float>(view.angle_from_axis_deg(x + 0.5, y + 0.5));
            }
        }
    }

    bool has_annulus() const { return errors_.to_deg > errors_.from_deg; }

    void add(const Eye& now) {
        add_term(Component::kCorona, now, texture_);
        add_term(Component::kHalo, now, halo_);
        add_term(Component::kStreaks, now, streaks_);
        add_psf(now);
        ++errors_.poses;
    }

    FlipbookErrors errors() const {
        FlipbookErrors errors = errors_;
        errors.texture = texture_.root();
        errors.halo = halo_.root();
        errors.streaks = streaks_.root();
        errors.psf = all_.root();
        return errors;
    }

  private:
    template <class Visit>
    void over_annulus(const Visit& visit) const {
        for (int y = 0; y < angle_deg_.height(); ++y) {
            for (int x = 0; x < angle_deg_.width(); ++x) {
                const auto angle = static_cast<double>(angle_deg_.at(x, y));
                if (angle >= errors_.from_deg && angle < errors_.to_deg) visit(x, y, angle);
            }
        }
    }

    void add_term(Component component, const Eye& now, Squares& squares) {
        const FlipbookTerm term =
            flipbook_term(component, now, player_.envelope(), book_.grid(), options_);
        if (term.weight == 0) return;
        player_.write_term(component, now, played_);
        over_annulus([&](int x, int y, double) {
            for (int c = 0; c < 3; ++c) {
                const auto wanted = static_cast<double>(term.relative.at(x, y, c));
                squares.difference +=
                    std::pow(static_cast<double>(played_.at(x, y, c)) - wanted, 2);
                squares.wanted += wanted * wanted;
            }
        });
    }

    void add_psf(const Eye& now) {
        player_.write(now, psf_);
        const wave::Psf direct = eye_psf(now, book_.grid(), options_);
        struct Ring {
            double difference = 0, sum = 0;
            int count = 0;
        };
        std::vector<Ring> rings(
            static_cast<std::size_t>((errors_.to_deg - errors_.from_deg) / kRingDeg) + 1);
        over_annulus([&](int x, int y, double angle) {
            Ring& ring = rings[static_cast<std::size_t>((angle - errors_.from_deg) / kRingDeg)];
            const auto e = static_cast<double>(player_.envelope().at(x, y));
            for (int c = 0; c < 3; ++c) {
                const auto wanted = static_cast<double>(direct.kernel.at(x, y, c));
                const double difference = static_cast<double>(psf_.kernel.at(x, y, c)) - wanted;
                all_.difference += std::pow(difference / e, 2);
                all_.wanted += std::pow(wanted / e, 2);
                ring.difference += difference * difference;
                ring.sum += wanted;
                ++ring.count;
            }
        });
        for (const Ring& ring : rings) {
            if (ring.count == 0) continue;
            errors_.worst_ring =
                std::max(errors_.worst_ring,
                         std::sqrt(ring.difference / ring.count) / (ring.sum / ring.count));
        }
    }

    const Flipbook& book_;
    const EyePsfOptions& options_;
    FlipbookPlayer player_;
    Image angle_deg_;
    Image played_;
    wave::Psf psf_;
    Squares texture_, halo_, streaks_, all_;
    FlipbookErrors errors_;
};

// Whether a pupil is a node of an axis.
bool is_node(const FlipbookAxis& axis, double pupil_mm) {
    const auto [low, share] = axis.place(pupil_mm);
    return std::abs(axis.at(share > 0.5 ? low + 1 : low) - pupil_mm) < 1e-9;
}

// The poses of the texture's frames that are frames of the other terms too.
std::vector<Eye> poses_of_frames(const FlipbookRange& range, const Eye& eye, FlipbookLids lids) {
    const FlipbookAxes axes(range);
    std::vector<Eye> all;
    for (const FlipbookFrame& frame : frames_of(range)) {
        if (frame.component != Component::kCorona) break;
        if ((frame.eyelid > 0) != (lids == FlipbookLids::kCovering)) continue;
        if (!is_node(axes.streak_pupils, frame.pupil_mm)) continue;
        Eye now = eye_at(eye, frame);
        const bool halo_stored = axes.halo_pupils.nodes > 0
                                     ? is_node(axes.halo_pupils, frame.pupil_mm)
                                     : frame.pupil_mm < kHaloFromMm;
        if (!halo_stored && halo_weight(now) > 0) continue;
        if (lids == FlipbookLids::kOpen) {
            now.pose.lash_closure =
                axes.closures.at(static_cast<int>(all.size()) % axes.closures.nodes);
        }
        all.push_back(now);
    }
    return all;
}

FlipbookErrors measure(const Flipbook& book, const Eye& eye, const EyePsfOptions& options,
                       const std::vector<Eye>& poses, Progress* progress) {
    Measurement measurement(book, eye, options);
    for (std::size_t i = 0; measurement.has_annulus() && i < poses.size(); ++i) {
        if (progress != nullptr) {
            progress->report("measuring",
                             static_cast<double>(i) / static_cast<double>(poses.size()));
            if (progress->cancelled()) throw Cancelled();
        }
        measurement.add(poses[i]);
    }
    if (progress != nullptr) progress->report("measuring", 1);
    return measurement.errors();
}

}  // namespace

FlipbookErrors errors_at_frames(const Flipbook& book, const Eye& eye, const EyePsfOptions& options,
                                FlipbookLids lids, int poses, Progress* progress) {
    const std::vector<Eye> all = poses_of_frames(book.range(), eye, lids);
    // In steps that share no factor with their number, so that pupils and states mix.
    const std::size_t count = all.size();
    std::size_t step = std::max<std::size_t>(count * 3 / 8, 1);
    while (std::gcd(step, count) > 1) ++step;
    std::vector<Eye> chosen;
    for (std::size_t i = 0; i < std::min(static_cast<std::size_t>(poses), count); ++i) {
        chosen.push_back(all[(count / 2 + i * step) % count]);
    }
    return measure(book, eye, options, chosen, progress);
}

FlipbookErrors errors_between_frames(const Flipbook& book, const Eye& eye,
                                     const EyePsfOptions& options, FlipbookLids lids, int poses,
                                     Progress* progress) {
    constexpr double kMostTurnDeg = 1;
    const FlipbookRange& range = book.range();
    const bool covering = lids == FlipbookLids::kCovering;
    Random random(1, covering ? 1 : 0);
    std::vector<Eye> chosen;
    for (int i = 0; i < poses && !(covering && range.lid_states == 1); ++i) {
        Eye now = eye;
        now.pupil_diameter_mm = random.uniform(range.pupil_from_mm, range.pupil_to_mm);
        now.pose.lens_scale = 1 + random.uniform(-range.lens_scale_span, range.lens_scale_span);
        now.pose.vitreous_yaw_deg = random.uniform(-kMostTurnDeg, kMostTurnDeg);
        now.pose.vitreous_pitch_deg = random.uniform(-kMostTurnDeg, kMostTurnDeg);
        (covering ? now.eyelid : now.pose.lash_closure) = random.uniform(0, range.largest_closure);
        chosen.push_back(now);
    }
    return measure(book, eye, options, chosen, progress);
}

}  // namespace aureole::eye
