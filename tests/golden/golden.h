// Comparison with stored linear pictures.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "aureole/image/image.h"

namespace aureole::golden {

// Flares and glare span decades: a pixel may be off by a share of its value, and by an absolute
// amount that is a share of the picture's brightest value.
struct Tolerance {
    double relative = 0.02;
    double floor = 1e-4;  // of the brightest value of the stored picture
    double outliers = 0;  // share of the pixels that may be off by more
};

// Compares 3 channels with pictures/NAME.exr. On failure writes NAME-actual.exr,
// NAME-expected.exr and NAME-difference.exr into the build's folder of failures and names the worst
// pixel. With AUREOLE_UPDATE_GOLDENS=1 in the environment writes the stored picture instead.
testing::AssertionResult matches(const std::string& name, const ConstImageView& actual,
                                 const Tolerance& tolerance = {});

}  // namespace aureole::golden
