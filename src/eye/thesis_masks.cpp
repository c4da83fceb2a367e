#include "eye/thesis_masks.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/base/smoothstep.h"
#include "aureole/base/units.h"
#include "aureole/wave/mask_shapes.h"
#include "aureole/wave/radial_grating.h"

namespace aureole::eye {
namespace {

enum Stream : std::uint64_t { kParticleStream = 1, kLashStream };

// The thesis gives numbers and no sizes. These were chosen by eye, for patterns that reach the
// ends of the texture under the thresholds of its table.
constexpr double kGratingsFromMm = 3.5;  // nothing up to here ...
constexpr double kGratingsFullMm = 4.2;  // ... everything here, and nothing again ...
constexpr double kLensRadiusMm = 4.7;    // ... at the edge of the lens
constexpr double kParticleDiscMm = 4.2;
constexpr double kSmallestParticleMm = 0.03;
constexpr double kLargestParticleMm = 0.1;
constexpr float kParticleGrey = 0.3F;  // of white; brighter ones pass the threshold everywhere
constexpr double kParticleOrbitMm = 0.15;
// Lashes, within a window that fades out.
constexpr double kLashWindowMm = 4.5;
constexpr double kLashWindowFadeMm = 1.5;
constexpr double kLashWidthMm = 0.09;
constexpr double kLashAngleDeg = 15;  // section 2.4: 10 to 30, about the vertical

// Nothing beyond the outer radius; an edge would make a pattern of its own.
void fade_out(wave::Mask& mask, double inner_mm, double outer_mm) {
    const int n = mask.grid.samples;
    parallel_for(static_cast<std::size_t>(n), [&](std::size_t j, int) {
        float* row = mask.row(static_cast<int>(j));
        const double y_mm = mask.grid.y_mm(static_cast<int>(j));
        for (int i = 0; i < n; ++i) {
            const double r_mm = std::hypot(mask.grid.x_mm(i), y_mm);
            row[i] *= static_cast<float>(1 - smoothstep(inner_mm, outer_mm, r_mm));
        }
    });
}

wave::Mask pupil(const ThesisFrames& frames) {
    wave::Mask mask(kThesisAperture);
    wave::draw(mask, wave::disc(0.5 * thesis_pupil_mm(frames.pupil)));
    return mask;
}

wave::Mask gratings(const ThesisLook& look, const ThesisFrames& frames) {
    const double scale = thesis_lens_scale(frames.gratings);
    wave::Mask mask(kThesisAperture);
    wave::draw(mask, wave::disc(scale * kLensRadiusMm));
    wave::RadialGrating lines;
    lines.fibres = look.gratings;
    lines.phase_rad = 0;
    lines.opacity = 1;
    lines.inner_radius_mm = scale * kGratingsFromMm;
    lines.full_radius_mm = scale * kGratingsFullMm;
    wave::Field lens = wave::field_from(mask);
    wave::multiply_radial_grating(lens, lines);
    // Inverted: white lines.
    std::transform(mask.values.data(), mask.values.data() + mask.values.size(), lens.re.data(),
                   mask.values.data(), [](float open, float lined) { return open - lined; });
    fade_out(mask, scale * kGratingsFullMm, scale * kLensRadiusMm);
    return mask;
}

// Each particle goes round a small circle of its own, once in a loop.
wave::Mask particles(const ThesisLook& look, const ThesisFrames& frames) {
    Random random(look.seed, kParticleStream);
    std::vector<wave::Particle> discs(static_cast<std::size_t>(look.particles));
    const double turn = 2 * kPi * frames.particles / kThesisFrames;
    for (auto& disc : discs) {
        const double distance = kParticleDiscMm * std::sqrt(random.uniform());
        const double direction = random.uniform(0, 2 * kPi);
        disc.radius_mm = random.log_uniform(kSmallestParticleMm, kLargestParticleMm);
        const double orbit = kParticleOrbitMm * random.uniform();
        const double phase = random.uniform(0, 2 * kPi);
        disc.x_mm = distance * std::cos(direction) + orbit * std::cos(phase + turn);
        disc.y_mm = distance * std::sin(direction) + orbit * std::sin(phase + turn);
    }
    wave::Mask mask(kThesisAperture);
    wave::draw_particles(mask, discs, wave::Blend::kAdd, kParticleGrey);
    return mask;
}

// Upper lashes hang into the window and come down with the lid; half as many stand below and come
// up a little.
wave::Mask lashes(const ThesisLook& look, const ThesisFrames& frames) {
    Random random(look.seed, kLashStream);
    const double closure = thesis_lid_closure(frames.lids);
    wave::Mask mask(kThesisAperture);
    const auto draw = [&](int count, double side, double open_tip_mm, double closed_tip_mm) {
        const double spacing_mm = 2 * 0.8 * kLashWindowMm / std::max(count, 1);
        for (int i = 0; i < count; ++i) {
            wave::Lash lash;
            lash.tip.x_mm = -0.8 * kLashWindowMm + (i + 0.5 + 0.25 * random.normal()) * spacing_mm;
            lash.tip.y_mm =
                side * (std::lerp(open_tip_mm, closed_tip_mm, closure) + 0.6 * random.normal());
            lash.direction_deg = side * (90 + kLashAngleDeg * random.normal());
            lash.width_mm = kLashWidthMm * random.uniform(0.75, 1.25);
            lash.length_mm = 16;
            wave::draw(mask, wave::lash(lash), wave::Blend::kMax);
        }
    };
    draw(look.eyelashes, 1, 0.5, -3);
    draw(look.eyelashes / 2, -1, 3, 1.5);
    fade_out(mask, kLashWindowMm - kLashWindowFadeMm, kLashWindowMm);
    return mask;
}

}  // namespace

wave::Mask thesis_mask(Component component, const ThesisLook& look, const ThesisFrames& frames) {
    switch (component) {
        case Component::kBloom:
            return pupil(frames);
        case Component::kHalo:
            return gratings(look, frames);
        case Component::kCorona:
            return particles(look, frames);
        case Component::kStreaks:
            break;
    }
    return lashes(look, frames);
}

}  // namespace aureole::eye
