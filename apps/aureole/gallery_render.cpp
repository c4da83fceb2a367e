#include "gallery_render.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "aureole/eye/eye_psf.h"
#include "display_options.h"
#include "layers.h"

namespace aureole::app {
namespace {

constexpr std::size_t kKeptEyes = 6;  // some 20 MB each for panels of 480x270

// What a preset makes of an eye that looks at a view.
eye::Eye eye_of(const Panel& panel) {
    eye::Eye eye = panel.eye;
    eye::apply_look(eye, eye::look_from_name(panel.preset), panel.view.horizontal_field_deg());
    return eye;
}

nlohmann::ordered_json parameters_of(const Panel& panel, const eye::Eye& eye,
                                     const DisplayOptions& display) {
    nlohmann::ordered_json json = {{"fov_deg", panel.view.horizontal_field_deg()},
                                   {"width", panel.view.width},
                                   {"height", panel.view.height},
                                   {"white_cd_m2", panel.white_cd_m2},
                                   {"tone_map", display.tone_map()},
                                   {"glare", panel.glare}};
    json.update(panel.scene);
    if (!panel.glare) return json;
    json.update({{"preset", panel.preset},
                 {"source_spectrum", std::string(color::name_of(panel.spectrum))},
                 {"pupil_mm", eye.pupil_diameter_mm},
                 {"age_years", eye.age_years},
                 {"corona_contrast", eye.corona_contrast},
                 {"halo", eye.halo},
                 {"streaks", eye.streaks},
                 {"eyelid", eye.eyelid},
                 {"eyelashes", eye.eyelashes},
                 {"lens_scale", eye.pose.lens_scale},
                 {"vitreous_yaw_deg", eye.pose.vitreous_yaw_deg},
                 {"vitreous_pitch_deg", eye.pose.vitreous_pitch_deg},
                 {"light_share", panel.light_share},
                 {"seed", eye.seed}});
    return json;
}

}  // namespace

PanelRenderer::Prepared& PanelRenderer::prepared_for(const eye::Eye& eye, const Panel& panel) {
    const View& view = panel.view;
    const auto found = std::find_if(prepared_.begin(), prepared_.end(), [&](const Prepared& one) {
        return one.eye == eye && one.view == view && one.spectrum == panel.spectrum;
    });
    if (found != prepared_.end()) {
        prepared_.splice(prepared_.begin(), prepared_, found);
        return prepared_.front();
    }
    if (prepared_.size() == kKeptEyes) prepared_.pop_back();
    eye::EyePsfOptions of_light;
    of_light.spectral.illuminant = panel.spectrum;
    const wave::Psf psf = eye::eye_psf(eye, wave::KernelGrid::full_reach(view), of_light);
    std::array<double, 3> spread{};
    for (std::size_t c = 0; c < 3; ++c) {
        spread[c] = 1 - double{psf.kernel.at(psf.kernel.width() / 2, psf.kernel.height() / 2,
                                             static_cast<int>(c))};
    }
    ++psfs_computed_;
    glare::GlareOptions options;
    options.surround = glare::Surround::kSame;  // scenes go on beyond the border
    prepared_.push_front({eye, view, panel.spectrum, spread, glare::Glare(view, 3, psf, options)});
    return prepared_.front();
}

RenderedPanel PanelRenderer::render(const Panel& panel) {
    const DisplayOptions display;  // as PNGs look by default
    const eye::Eye eye = eye_of(panel);
    const Image in = panel.draw();
    const Image solid_angles = relative_solid_angles(panel.view);
    RenderedPanel rendered;
    rendered.parameters = parameters_of(panel, eye, display);
    PanelEnergy& energy = rendered.energy;
    energy.in = energy_of(in, panel.view, solid_angles);
    Image out = in;
    if (panel.glare) {
        Prepared& prepared = prepared_for(eye, panel);
        prepared.glare.apply(in, out);
        const glare::Energy sums = prepared.glare.energy(in, out);
        energy.from_surround = sums.from_surround;
        energy.off_picture = panel.light_share * sums.off_picture;
        for (int c = 0; c < 3; ++c) {
            energy.spread += panel.light_share * prepared.spread[static_cast<std::size_t>(c)] *
                             energy_of(in.view().channel_range(c, 1), panel.view, solid_angles);
        }
        const auto share = static_cast<float>(panel.light_share);
        const std::size_t values = 3 * out.pixels();
        std::for_each_n(out.plane(0), values, [&](float& value) { value *= share; });
        energy.blocked = (1 - panel.light_share) * (energy.in + energy.from_surround);
    }
    energy.out = energy_of(out, panel.view, solid_angles);
    rendered.display = display.encode(out, -std::log2(panel.white_cd_m2));
    return rendered;
}

}  // namespace aureole::app
