// aureole scene with an environment.
#include <gtest/gtest.h>

#include <cmath>

#include "program.h"

namespace aureole::cli {
namespace {

using Environment = CliTest;

TEST_F(Environment, IsTwiceAsWideAsHigh) {
    const auto out = report("scene studio -o studio.exr --width 64");
    EXPECT_EQ(out["parameters"]["width"], 64);
    EXPECT_EQ(out["parameters"]["height"], 32);
    EXPECT_FALSE(out["parameters"].contains("fov_deg"));
    const io::Picture picture = read("studio.exr");
    EXPECT_EQ(picture.color().width, 64);
    EXPECT_EQ(picture.color().height, 32);
    EXPECT_FALSE(picture.float_attribute("aureole:fov_deg").has_value());
    EXPECT_TRUE(picture.float_attribute("whiteLuminance").has_value());
}

TEST_F(Environment, IsInUnitsOfTheWhiteLuminance) {
    report("scene overcast -o a.exr --width 32");
    report("scene overcast -o b.exr --width 32 --white-luminance 1");
    EXPECT_NEAR(read("b.exr").color().at(5, 2, 1) / read("a.exr").color().at(5, 2, 1), 100, 1e-3);
    EXPECT_NEAR(read("b.exr").color().at(5, 0, 1), 7000, 2000);
}

TEST_F(Environment, OfAllNamesInTheHelp) {
    EXPECT_TRUE(names_all(run("scene --help").out, {"studio", "interior", "overcast", "sunny"}));
    for (const char* name : {"studio", "interior", "overcast", "sunny"}) {
        EXPECT_EQ(run(std::string("scene ") + name + " -o e.png --width 16").exit_code, 0) << name;
    }
}

// Half of an odd width is no height: what was written could not be read as an environment again.
TEST_F(Environment, OddWidthsNeedAHeight) {
    const Outcome outcome = run("scene studio -o a.exr --width 33");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(names_all(outcome.err, {"--width", "33", "even", "--height"}));
    EXPECT_FALSE(exists("a.exr"));
    EXPECT_EQ(run("scene studio -o a.exr --width 33 --height 17").exit_code, 0);
}

TEST_F(Environment, HasNoFieldOfView) {
    const Outcome outcome = run("scene sunny -o a.exr --width 16 --fov 60");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(names_all(outcome.err, {"--fov", "60", "sunny", "whole sphere"}));
    EXPECT_FALSE(exists("a.exr"));
}

}  // namespace
}  // namespace aureole::cli
