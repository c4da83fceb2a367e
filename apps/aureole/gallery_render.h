// From panels to pictures.
#pragma once

#include <array>
#include <list>
#include <nlohmann/json.hpp>

#include "aureole/glare/glare.h"
#include "gallery.h"

namespace aureole::app {

// Sums over pixels and colours of value times solid angle (cd/m2 sr).
// in + from_surround = out + off_picture + blocked, up to rounding.
struct PanelEnergy {
    double in = 0;
    double from_surround = 0;  // scattered in from beyond the border (glare::Surround::kSame)
    double out = 0;
    double off_picture = 0;
    double blocked = 0;  // by lids
    double spread = 0;   // of in: what glare takes from the pixels it comes from, to other ones or
                         // off the picture. A sum over lights, whatever they are seen against
};

struct RenderedPanel {
    Image display;  // sRGB values, 3 channels
    PanelEnergy energy;
    nlohmann::ordered_json parameters;  // every one, of scene, eye and exposure
};

// Renders panels one after another. PSFs of the last few eyes are kept, so that panels that share
// an eye and a view share its PSF.
class PanelRenderer {
  public:
    RenderedPanel render(const Panel& panel);
    int psfs_computed() const { return psfs_computed_; }

  private:
    struct Prepared {
        eye::Eye eye;
        View view;
        color::Illuminant spectrum;
        std::array<double, 3> spread;  // 1 - the share that stays in the light's own pixel
        glare::Glare glare;
    };
    Prepared& prepared_for(const eye::Eye& eye, const Panel& panel);

    std::list<Prepared> prepared_;  // the latest first
    int psfs_computed_ = 0;
};

}  // namespace aureole::app
