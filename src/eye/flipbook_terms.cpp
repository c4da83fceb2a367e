#include "eye/flipbook_terms.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/wave/aperture.h"
#include "eye/diffracted_share.h"
#include "eye/kernel_checks.h"
#include "eye/smoothstep.h"

namespace aureole::eye {
namespace {

// Patterns that the raster cuts before they end fade out over this share of its half width.
constexpr double kFadeShare = 0.125;
// Red still counts there; what longer wavelengths carry farther is a few thousandths.
constexpr double kReachNm = 650;
// Radius within which the envelope is flat.
constexpr int kFlatPx = 4;

double reach_px(const wave::KernelGrid& raster, const wave::ApertureGrid& aperture) {
    const double sine = std::min(mm_from_nm(kReachNm) / (2 * aperture.spacing_mm()), 0.999);
    const double angle = std::asin(sine);
    return raster.view().focal_length_px() *
           (raster.projection == Projection::kPerspective ? std::tan(angle) : angle);
}

// w_e: the share of the pupil's area that lashes block.
double blocked_share(const Eye& eye, const wave::ApertureGrid& aperture) {
    const wave::Mask pupil = draw_pupil(eye, aperture);
    const wave::Mask lashes = draw_lashes(eye, aperture);
    const auto samples = static_cast<std::size_t>(aperture.samples);
    struct Sums {
        double open = 0, blocked = 0;
    };
    std::vector<Sums> rows(samples);
    parallel_for(samples, [&](std::size_t j, int) {
        const float* open = pupil.values.data() + j * samples;
        const float* lash = lashes.values.data() + j * samples;
        for (std::size_t i = 0; i < samples; ++i) {
            rows[j].open += static_cast<double>(open[i]);
            rows[j].blocked += static_cast<double>(open[i] * lash[i]);
        }
    });
    Sums total;
    for (const Sums& row : rows) {
        total.open += row.open;
        total.blocked += row.blocked;
    }
    return total.open > 0 ? total.blocked / total.open : 0;
}

double weight_of(Component component, const Eye& eye, const wave::ApertureGrid& aperture) {
    switch (component) {
        case Component::kCorona:
            return eye.corona_contrast > 0 ? 1 : 0;
        case Component::kHalo:
            return shows_fibres(eye) ? 1 : 0;
        case Component::kStreaks:
            return eye.eyelashes > 0 ? blocked_share(eye, aperture) : 0;
        case Component::kBloom:
            break;
    }
    return 0;
}

}  // namespace

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
    FlipbookTerm term;
    term.weight = weight_of(component, eye, options.aperture);
    if (term.weight == 0) return term;
    term.relative = eye_component(component, eye, raster, options).kernel;
    Image scatter;
    if (component == Component::kCorona) {
        scatter = ScatterPixels(ScatterPsf(eye.scatter, eye.age_years, eye.pigmentation,
                                           eye.pupil_diameter_mm),
                                raster)
                      .image(raster.width, raster.height);
    }
    const int half = raster.width / 2;
    const bool fades = reach_px(raster, options.aperture) > half;
    const auto weight = static_cast<float>(term.weight);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < raster.height; ++y) {
            float* value = term.relative.row(y, c);
            for (int x = 0; x < raster.width; ++x) {
                value[x] *= weight;
                if (!scatter.empty()) value[x] -= scatter.at(x, y);
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
