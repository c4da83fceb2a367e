// --field-varying: streaks by position.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "program.h"

namespace aureole::cli {
namespace {

using FieldVarying = CliTest;

TEST_F(FieldVarying, ConservesEnergyAndReportsItsError) {
    write("in.exr", noise(48, 27, 3));
    const Outcome outcome =
        run("glare in.exr -o out.exr --fov 50 --pupil 5 --field-varying 30 --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    const auto& energy = json["energy"];
    EXPECT_NEAR((energy["out"].get<double>() + energy["off_picture"].get<double>()) /
                    energy["in"].get<double>(),
                1, 1e-4);
    const auto& field = json["field_varying"];
    EXPECT_GT(field["error"].get<double>(), 0);
    EXPECT_LT(field["error"].get<double>(), 1);
    EXPECT_GT(field["kernels"].get<int>(), 1);
    EXPECT_EQ(json["method"], "nodes");
    EXPECT_EQ(json["parameters"]["field_varying"], true);
}

TEST_F(FieldVarying, RefusesWhatItDoesNotKnow) {
    write("in.exr", noise(8, 8, 3));
    for (const char* options :
         {"0.1", "maybe", "on --threshold 1", "on --gain 2", "on --surround same",
          "on --method direct", "on --resolution half", "on --observer camera"}) {
        const Outcome outcome =
            run(std::string("glare in.exr -o out.exr --field-varying ") + options);
        EXPECT_EQ(outcome.exit_code, 2) << options;
        EXPECT_NE(outcome.err.find("--field-varying"), std::string::npos) << outcome.err;
    }
}

}  // namespace
}  // namespace aureole::cli
