#include "eye/flipbook_terms.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "aureole/base/smoothstep.h"
#include "aureole/base/units.h"
#include "aureole/wave/aperture.h"
#include "eye/components.h"

namespace aureole::eye {
namespace {

// Patterns that the raster cuts before they end fade out over this share of its half width.
constexpr double kFadeShare = 0.125;
// Red still counts there; what longer wavelengths carry farther is a few thousandths.
constexpr double kReachNm = 650;
// Radius within which the envelope is flat.
constexpr int kFlatPx = 2;

bool patterns_fade(const wave::KernelGrid& raster, const wave::ApertureGrid& aperture) {
    const double sine = std::min(mm_from_nm(kReachNm) / (2 * aperture.spacing_mm()), 0.999);
    const double angle = std::asin(sine);
    const double reach_px =
        raster.view().focal_length_px() *
        (raster.projection == Projection::kPerspective ? std::tan(angle) : angle);
    const int half = raster.width / 2;
    return reach_px > half;
}

// H, or w_e E with its weight, on the whole raster.
FlipbookTerm diffracted(Component component, const Eye& eye, const wave::KernelGrid& raster,
                        const EyePsfOptions& options) {
    Components components(eye, raster, options, nullptr, nullptr);
    FlipbookTerm term;
    std::optional<Image> pattern;
    if (component == Component::kHalo) {
        pattern = components.halo();
        term.weight = pattern ? 1 : 0;
    } else if (eye.eyelashes > 0) {
        auto parts = components.corona_and_streaks(false, true);
        pattern = std::move(parts.streaks);
        term.weight = pattern ? parts.blocked_share : 0;
    }
    if (!pattern) return term;
    term.relative = Image(raster.width, raster.height, 3);
    const int margin_x = (raster.width - pattern->width()) / 2;
    const int margin_y = (raster.height - pattern->height()) / 2;
    const auto weight = static_cast<float>(term.weight);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < pattern->height(); ++y) {
            const float* from = pattern->row(y, c);
            std::transform(from, from + pattern->width(),
                           term.relative.row(margin_y + y, c) + margin_x,
                           [weight](float value) { return weight * value; });
        }
    }
    return term;
}

// S (T' - 1).
FlipbookTerm texture(const Eye& eye, const wave::KernelGrid& raster, const EyePsfOptions& options) {
    FlipbookTerm term;
    if (!(eye.corona_contrast > 0)) return term;
    term.weight = 1;
    term.relative = eye_component(Component::kCorona, eye, raster, options).kernel;
    const ScatterPsf model(eye.scatter, eye.age_years, eye.pigmentation, eye.pupil_diameter_mm);
    const Image scatter = ScatterPixels(model, raster).image(raster.width, raster.height);
    for (int c = 0; c < 3; ++c) {
        std::transform(term.relative.plane(c), term.relative.plane(c) + scatter.pixels(),
                       scatter.plane(0), term.relative.plane(c), std::minus<>());
    }
    return term;
}

}  // namespace

double flipbook_whole_to_deg(const wave::KernelGrid& raster, const wave::ApertureGrid& aperture) {
    const int half = raster.width / 2;
    const double whole_px = patterns_fade(raster, aperture) ? (half + 1) * (1 - kFadeShare) : half;
    const View view = raster.view();
    return view.angle_from_axis_deg(view.axis_x + whole_px, view.axis_y);
}

Eye eye_at(const Eye& eye, const FlipbookFrame& frame) {
    Eye at = eye;
    at.pupil_diameter_mm = frame.pupil_mm;
    at.eyelid = frame.eyelid;
    at.pose = frame.pose;
    return at;
}

Image flipbook_envelope(const Eye& eye, const FlipbookRange& range,
                        const wave::KernelGrid& raster) {
    const ScatterPsf scatter(eye.scatter, eye.age_years, eye.pigmentation,
                             (range.pupil_from_mm + range.pupil_to_mm) / 2);
    Image envelope = ScatterPixels(scatter, raster).image(raster.width, raster.height);
    const int centre = raster.width / 2;
    const float level = envelope.at(centre + kFlatPx, centre);
    for (int y = -kFlatPx; y <= kFlatPx; ++y) {
        for (int x = -kFlatPx; x <= kFlatPx; ++x) {
            if (x * x + y * y < kFlatPx * kFlatPx) envelope.at(centre + x, centre + y) = level;
        }
    }
    return envelope;
}

FlipbookTerm flipbook_term(Component component, const Eye& eye, const Image& envelope,
                           const wave::KernelGrid& raster, const EyePsfOptions& options) {
    FlipbookTerm term = component == Component::kCorona
                            ? texture(eye, raster, options)
                            : diffracted(component, eye, raster, options);
    if (term.weight == 0) return term;
    const int half = raster.width / 2;
    const bool fades = patterns_fade(raster, options.aperture);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < raster.height; ++y) {
            float* value = term.relative.row(y, c);
            for (int x = 0; x < raster.width; ++x) {
                if (fades) {
                    const double edge = 1 - std::hypot(x - half, y - half) / (half + 1);
                    value[x] *= static_cast<float>(smoothstep(0, kFadeShare, edge));
                }
                value[x] /= envelope.at(x, y);
            }
        }
    }
    return term;
}

}  // namespace aureole::eye
