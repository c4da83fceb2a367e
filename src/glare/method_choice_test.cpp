#include "glare/method_choice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aureole::glare {
namespace {

constexpr double kMatters = 0.001;

TEST(CostCorrection, LeavesOutTheFirstRunAndWhatDoesNotMatter) {
    CostCorrection correction;
    correction.observe(Method::kSprites, 0.01, 0.05, kMatters);
    EXPECT_EQ(correction.of(Method::kSprites), 1);
    correction.observe(Method::kSprites, 0.0003, 0.0009, kMatters);
    EXPECT_EQ(correction.of(Method::kSprites), 1);
    correction.observe(Method::kSprites, 0.01, 0.05, kMatters);
    EXPECT_GT(correction.of(Method::kSprites), 1.5);
}

// A method whose model is wrong is found out in a few pictures; of what it costs more, half is
// taken to be the machine's pace.
TEST(CostCorrection, FindsOutAWrongModel) {
    CostCorrection correction;
    for (int i = 0; i < 12; ++i) correction.observe(Method::kSprites, 0.01, 0.02, kMatters);
    EXPECT_NEAR(correction.of(Method::kSprites), 2, 0.1);
    EXPECT_NEAR(correction.of(Method::kFft), std::sqrt(2), 0.05);
    // Transforms turn out to be as fast as predicted: all of it was the model.
    for (int i = 0; i < 12; ++i) {
        correction.observe(Method::kFft, 0.01, 0.01, kMatters);
        correction.observe(Method::kSprites, 0.01, 0.02, kMatters);
    }
    EXPECT_NEAR(correction.of(Method::kSprites) / correction.of(Method::kFft), 2, 0.4);
}

// A machine with other work slows all methods down: the order in which they are chosen stays.
TEST(CostCorrection, PaceIsOfAllMethods) {
    CostCorrection correction;
    for (int i = 0; i < 12; ++i) {
        correction.observe(Method::kFft, 0.01, 0.03, kMatters);
        correction.observe(Method::kSprites, 0.005, 0.015, kMatters);
    }
    EXPECT_NEAR(correction.of(Method::kFft), 3, 0.4);
    EXPECT_NEAR(correction.of(Method::kSprites), 3, 0.4);
    EXPECT_GT(correction.of(Method::kHybrid), 1.5);
}

}  // namespace
}  // namespace aureole::glare
