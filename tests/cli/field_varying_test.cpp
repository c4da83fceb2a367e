// --field-varying and --needles-by-position.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "program.h"

namespace aureole::cli {
namespace {

using FieldVarying = CliTest;

void expect_conserved(const nlohmann::json& json) {
    const auto& energy = json["energy"];
    const double ghosts = energy.contains("ghosts") ? energy["ghosts"].get<double>() : 0.0;
    EXPECT_NEAR((energy["out"].get<double>() - ghosts + energy["off_picture"].get<double>()) /
                    energy["in"].get<double>(),
                1, 1e-4);
}

TEST_F(FieldVarying, ConservesEnergyAndReportsItsError) {
    write("in.exr", noise(48, 27, 3));
    const Outcome outcome =
        run("glare in.exr -o out.exr --fov 50 --pupil 5 --field-varying 30 --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    expect_conserved(json);
    const auto& field = json["field_varying"];
    EXPECT_GT(field["error"].get<double>(), 0);
    EXPECT_LT(field["error"].get<double>(), 1);
    EXPECT_GT(field["kernels"].get<int>(), 1);
    EXPECT_EQ(json["method"], "nodes");
    EXPECT_EQ(json["parameters"]["field_varying"], "30");
}

TEST_F(FieldVarying, FewComponentsTakeLessMemoryAndHaveLargerErrors) {
    write("in.exr", noise(48, 27, 3));
    const auto field = [&](const std::string& value) {
        const Outcome outcome =
            run("glare in.exr -o out.exr --fov 20 --pupil 5 "
                "--field-varying " +
                value + " --json");
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out)["field_varying"];
    };
    const auto all = field("on");
    const auto few = field("rank=3");
    EXPECT_EQ(few["rank"], 3);
    EXPECT_LT(few["bytes"].get<double>(), 0.5 * all["bytes"].get<double>());
    EXPECT_GT(few["error"].get<double>(), all["error"].get<double>());
}

TEST_F(FieldVarying, ACameraKeepsItsEnergy) {
    write("in.exr", noise(48, 27, 3));
    const Outcome outcome =
        run("glare in.exr -o out.exr --observer camera --lens biotar "
            "--f-number 1.4 --fov 20 --field-varying 10 --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    expect_conserved(json);
    EXPECT_EQ(json["method"], "nodes");
    EXPECT_GT(json["field_varying"]["kernels"].get<int>(), 1);
    EXPECT_GT(json["field_varying"]["error"].get<double>(), 0);
}

TEST_F(FieldVarying, NeedlesDifferAndKeepTheEnergy) {
    write("in.exr", noise(48, 27, 3));
    for (const char* more : {"", " --field-varying 30"}) {
        const Outcome outcome = run(
            std::string("glare in.exr -o out.exr --fov 20 --pupil 5 --needles-by-position --json") +
            more);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const auto json = nlohmann::json::parse(outcome.out);
        expect_conserved(json);
        EXPECT_EQ(json["method"], "nodes");
        EXPECT_EQ(json["parameters"]["needles_by_position"], true);
    }
    const Outcome plain = run("glare in.exr -o plain.exr --fov 20 --pupil 5");
    ASSERT_EQ(plain.exit_code, 0) << plain.err;
    EXPECT_NE(bytes("out.exr"), bytes("plain.exr"));
}

TEST_F(FieldVarying, NeedlesAreAnEyes) {
    write("in.exr", noise(8, 8, 3));
    for (const char* options : {"--observer camera", "--threshold 1", "--corona-contrast 0",
                                "--scatter none", "--preset thesis", "--passes both"}) {
        const Outcome outcome =
            run(std::string("glare in.exr -o out.exr --needles-by-position ") + options);
        EXPECT_EQ(outcome.exit_code, 2) << options;
        EXPECT_NE(outcome.err.find("--needles-by-position"), std::string::npos) << outcome.err;
    }
}

TEST_F(FieldVarying, RefusesWhatItDoesNotKnow) {
    write("in.exr", noise(8, 8, 3));
    for (const char* options :
         {"0.1", "maybe", "on --streaks 0", "on --threshold 1", "on --gain 2", "on --surround same",
          "on --method direct", "on --resolution half", "rank=0", "rank=2x", "rank="}) {
        const Outcome outcome =
            run(std::string("glare in.exr -o out.exr --field-varying ") + options);
        EXPECT_EQ(outcome.exit_code, 2) << options;
        EXPECT_NE(outcome.err.find("--field-varying"), std::string::npos) << outcome.err;
    }
}

}  // namespace
}  // namespace aureole::cli
