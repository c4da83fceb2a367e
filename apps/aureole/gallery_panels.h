// What the cases of the gallery share: eyes, lights and words.
#pragma once

#include <string>
#include <vector>

#include "aureole/color/rgb.h"
#include "aureole/eye/motion.h"
#include "aureole/scene/scene.h"
#include "aureole/scene/studies.h"
#include "gallery.h"

namespace aureole::app {

View panel_view(const PanelSize& size, double fov_deg);

// An average eye adapted to a luminance (both eyes, a field of 60 deg).
eye::Eye adapted_eye(double adaptation_cd_m2);
// The same eye, alive, with the settings' pupil following the luminance.
eye::LivingEye living_eye(double adaptation_cd_m2, eye::MotionSettings settings);

// Lights on a plain ground as a panel; `white_cd_m2` and the eye are the caller's to choose.
Panel lights_panel(const std::string& label, const View& view, const color::Rgb& ground_cd_m2,
                   const std::vector<scene::DiscLight>& discs,
                   const std::vector<scene::PointLight>& points = {});

// The panel without glare, with other lids or at a moment of a living eye.
Panel without_glare(Panel panel, const std::string& label);
Panel with_preset(Panel panel, const std::string& preset, const std::string& label);
Panel with_lids(Panel panel, double closure, const std::string& label);
Panel at_moment(Panel panel, const eye::Moment& moment, const std::string& label);

// Grey of a luminance, and colours by name or hue (deg, full saturation on a display) by their
// largest component, cd/m2 as linear sRGB.
color::Rgb grey(double cd_m2);
color::Rgb azure(double largest);
color::Rgb orange(double largest);
color::Rgb apple_green(double largest);
color::Rgb hue(double degrees, double largest);

}  // namespace aureole::app
