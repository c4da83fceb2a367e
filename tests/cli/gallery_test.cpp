// The gallery: whole folders or none, every panel accounted for.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "program.h"

namespace aureole::cli {
namespace {

using Gallery = CliTest;

TEST_F(Gallery, WritesSheetsAPageAndNumbersThatBalance) {
    const nlohmann::json json = report("gallery -o out --only sizes,brightness --width 96");
    ASSERT_EQ(json["cases"].size(), 2U);
    const std::string page = bytes("out/index.html");
    for (const auto& one : json["cases"]) {
        const auto name = one["name"].get<std::string>();
        EXPECT_TRUE(exists("out/" + name + ".png")) << name;
        EXPECT_TRUE(exists("out/" + name + ".0000.png")) << name;
        EXPECT_TRUE(names_all(page, {name + ".png"}));
        EXPECT_TRUE(names_all(page, {one["frames"].back()["label"].get<std::string>()}));
        for (const auto& panel : one["panels"]) {
            const auto& energy = panel["energy"];
            const double in = energy["in"].get<double>() + energy["from_surround"].get<double>();
            const double out = energy["out"].get<double>() + energy["off_picture"].get<double>() +
                               energy["blocked"].get<double>();
            EXPECT_NEAR(out, in, 1e-4 * in) << name;
            EXPECT_GT(energy["spread"], 0);
            EXPECT_LT(energy["spread"], energy["in"]);
            EXPECT_TRUE(names_all(page, {panel["label"].get<std::string>()}));
        }
    }
}

TEST_F(Gallery, RefusesWhatItDoesNotKnowAndLeavesOtherFilesAlone) {
    const Outcome unknown = run("gallery -o out --only comets");
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_TRUE(names_all(unknown.err, {"--only", "comets", "candle"}));
    EXPECT_FALSE(exists("out"));
    ASSERT_EQ(run("gallery -o out --only sizes --width 64").exit_code, 0);
    write_bytes("out/mine.txt", "notes");
    EXPECT_EQ(run("gallery -o out --only sizes --width 64").exit_code, 0);
    EXPECT_EQ(bytes("out/mine.txt"), "notes");
}

}  // namespace
}  // namespace aureole::cli
