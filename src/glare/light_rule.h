// Which light of a picture makes glare: glare.h has the formula.
#pragma once

#include "aureole/glare/glare.h"
#include "aureole/image/image.h"

namespace aureole::glare {

class LightRule {
  public:
    explicit LightRule(const GlareOptions& options) : options_(options) {}

    // Whether the light is the picture.
    bool everything() const noexcept {
        return options_.threshold == 0 && !options_.matte && !options_.source_curve;
    }

    // Row y of a picture of 1 or 3 channels, into row `to_y` of `to`. `matte`: of the whole
    // picture; nullptr: 1 everywhere.
    void row(const ConstImageView& in, int y, const float* matte, const ImageView& to,
             int to_y) const noexcept;

  private:
    const GlareOptions options_;
};

}  // namespace aureole::glare
