// A picture with one light in it, and the runs that the tests of lens flares share.
#pragma once

#include <string>

#include "program.h"

namespace aureole::cli {

inline constexpr int kWidth = 96;
inline constexpr int kHeight = 64;
inline constexpr double kFovDeg = 30;
inline const std::string kLens = " --lens heliar --f-number 8 ";
// The same picture for both renderers, in a fraction of the time.
inline const std::string kFast = kLens + "--ghosts matrix ";

// Dim, with one light of 3x3 pixels.
inline Image lit_picture(int channels = 3) {
    Image image = constant(kWidth, kHeight, channels, 0.25F);
    for (int c = 0; c < channels; ++c) {
        for (int y = 19; y < 22; ++y) {
            for (int x = 69; x < 72; ++x) image.at(x, y, c) = 2e5F / static_cast<float>(1 + c);
        }
    }
    return image;
}

class Flare : public CliTest {
  protected:
    void SetUp() override {
        io::Picture picture(lit_picture());
        picture.set_attribute("aureole:fov_deg", static_cast<float>(kFovDeg));
        write("in.exr", picture);
    }
    // Energy of the ghosts that a run adds.
    double ghosts(const std::string& words) const {
        return report("flare in.exr -o ghosts.exr" + words)["energy"]["ghosts"];
    }
};

}  // namespace aureole::cli
