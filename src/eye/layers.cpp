// Drawing the pupil and the fibres of the lens, each layer from its own random stream.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/eye/anatomy.h"
#include "aureole/wave/mask_shapes.h"
#include "aureole/wave/radial_grating.h"
#include "eye/before_pupil.h"

namespace aureole::eye {
namespace {

// Lowest harmonic of the pupil's edge; order 1 would be a shift.
constexpr int kFirstEdgeHarmonic = 2;

// Fibres wander: their displacement is noise whose amplitude falls as 1 / order round the lens, so
// that neighbours stay nearly parallel.
constexpr int kJitterHarmonics = 400;
constexpr int kJitterNodes = 8192;

// Displacement of the fibres over one turn, in radians of the fibres' own phase.
std::vector<float> fibre_jitter(const Eye& eye) {
    if (eye.anatomy.gratings.jitter_fibres == 0) return {};
    Random random(eye.seed, kGratingStream);
    std::vector<double> sum(kJitterNodes);
    for (int order = 1; order < kJitterHarmonics; ++order) {
        const double cosine = random.normal() / order;
        const double sine = random.normal() / order;
        const std::complex<double> turn = std::polar(1.0, 2 * kPi * order / kJitterNodes);
        std::complex<double> phasor(cosine, sine);
        for (auto& value : sum) {
            value += phasor.real();
            phasor *= turn;
        }
    }
    double square = 0;
    for (const double value : sum) square += value * value;
    const double scale =
        2 * kPi * eye.anatomy.gratings.jitter_fibres / std::sqrt(square / kJitterNodes);
    std::vector<float> jitter(kJitterNodes);
    std::transform(sum.begin(), sum.end(), jitter.begin(),
                   [&](double value) { return static_cast<float>(value * scale); });
    return jitter;
}

}  // namespace

wave::Mask draw_pupil(const Eye& eye, const wave::ApertureGrid& grid, const FieldPosition& field) {
    check(eye);
    const Oblique view = oblique(eye, field);
    Random random(eye.seed, kPupilStream);
    std::vector<wave::RadiusHarmonic> harmonics;
    for (int order = kFirstEdgeHarmonic; order <= kLastEdgeHarmonic; ++order) {
        const double amplitude = eye.anatomy.pupil_irregularity * random.normal() / order;
        harmonics.push_back({order, amplitude, random.uniform(0, 2 * kPi)});
    }
    const PupilOutline outline(eye);
    wave::Mask pupil(grid);
    wave::draw(pupil,
               seen(outline.round() ? wave::irregular_disc(outline.longest_radius_mm(), harmonics)
                                    : wave::with_harmonics(outline.shape(), harmonics),
                    Layer::kPupil, view));
    if (eye.eyelid > 0) {
        const auto keep = [&](wave::LidSide side, double edge_y_mm) {
            wave::draw(pupil, seen(wave::lid_opening(side, edge_y_mm), Layer::kBeforePupil, view),
                       wave::Blend::kKeep);
        };
        const Lids lids(eye, outline, eye.eyelid);
        keep(wave::LidSide::kUpper, lids.upper_mm);
        keep(wave::LidSide::kLower, lids.lower_mm);
        if (view.shortening == 0 && !(wave::area_mm2(pupil) > 0)) {
            throw InvalidArgument("eyelid", fmt::format("{}", eye.eyelid),
                                  "leaves no opening; must be smaller");
        }
    }
    return pupil;
}

void multiply_gratings(const Eye& eye, wave::Field& field) {
    check(eye);
    const Gratings& gratings = eye.anatomy.gratings;
    wave::RadialGrating grating;
    grating.fibres = gratings.fibres;
    grating.phase_rad = gratings.phase_rad;
    grating.inner_radius_mm = gratings.inner_radius_mm * eye.pose.lens_scale;
    grating.full_radius_mm = gratings.full_radius_mm * eye.pose.lens_scale;
    grating.jitter_rad = fibre_jitter(eye);
    wave::multiply_radial_grating(field, grating);
}

std::string grating_resolution_note(const Eye& eye, const wave::ApertureGrid& grid) {
    const Gratings& gratings = eye.anatomy.gratings;
    const double smallest_period_mm = 2 * grid.spacing_mm();
    const double resolved_from_mm = smallest_period_mm * gratings.fibres / (2 * kPi);
    if (resolved_from_mm <= gratings.inner_radius_mm) return {};
    return fmt::format(
        "{} lens fibres are finer than two samples of the {} x {} raster within {:.2f} mm of the "
        "axis: that part of the halo, outside {:.2f} deg at 568 nm, is missing",
        gratings.fibres, grid.samples, grid.samples, resolved_from_mm,
        deg_from_rad(std::asin(mm_from_nm(568) / smallest_period_mm)));
}

}  // namespace aureole::eye
