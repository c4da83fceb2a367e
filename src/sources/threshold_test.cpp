#include "aureole/sources/threshold.h"

#include <gtest/gtest.h>

namespace aureole::sources {
namespace {

TEST(Ramp, OfZeroPassesEverything) {
    for (const float value : {-3.0F, 0.0F, 0.25F, 1e6F}) EXPECT_EQ(ramp(value, 0), value);
}

TEST(Ramp, IsContinuousAtTheThreshold) {
    EXPECT_EQ(ramp(0.9F, 0.9F), 0);
    EXPECT_EQ(ramp(0.5F, 0.9F), 0);
    EXPECT_NEAR(ramp(0.901F, 0.9F), 0.001F, 1e-6);
}

TEST(Ramp, KeepsRatiosOfBrightColours) {
    EXPECT_NEAR(ramp(2000.9F, 0.9F) / ramp(1000.9F, 0.9F), 2, 1e-5);
}

}  // namespace
}  // namespace aureole::sources
