// --preset thesis: what it sets, what of it may be changed, and its frames.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "program.h"

namespace aureole::cli {
namespace {

class Thesis : public CliTest {
  protected:
    void write_lamp(const std::string& name) const {
        Image picture = constant(96, 54, 3, 0.02F);
        for (int c = 0; c < 3; ++c) {
            for (int x = 40; x < 44; ++x) picture.at(x, 20, c) = 30;
        }
        write(name, picture);
    }
};

const std::string kThesis = " --preset thesis --fov 60 ";

TEST_F(Thesis, ReportsEveryNumberOfTheDocument) {
    write_lamp("in.exr");
    const auto json = report("glare in.exr -o out.exr" + kThesis);
    const auto& parameters = json["parameters"];
    EXPECT_EQ(parameters["preset"], "thesis");
    EXPECT_EQ(parameters["threshold"], 0.9);
    EXPECT_EQ(parameters["gain"], 10);
    EXPECT_EQ(parameters["source_factor"], 10000);
    EXPECT_EQ(parameters["source_tone_map"], "unity");
    EXPECT_EQ(parameters["composite"], "added");
    EXPECT_EQ(parameters["bloom"]["power"], 0.45);
    EXPECT_EQ(parameters["halo"]["weight"], 0.75);
    EXPECT_EQ(parameters["corona"]["threshold"], 0.00017);
    EXPECT_EQ(parameters["streaks"]["factor"], 500);
    EXPECT_EQ(parameters["gratings"], 200);
    EXPECT_EQ(parameters["particles"], 750);
    EXPECT_EQ(parameters["pages"]["pupil"], 30);
    EXPECT_EQ(parameters["pages"]["lids"], 0);
    const auto& energy = json["energy"];
    const double in = energy["in"];
    const double added = energy["added"];
    EXPECT_GT(added, 0);
    EXPECT_NEAR((in + added) / (energy["out"].get<double>() + energy["off_picture"].get<double>()),
                1, 1e-4);
    EXPECT_EQ(report("glare in.exr -o out.exr --fov 60")["parameters"]["composite"], "conserving");
}

TEST_F(Thesis, WhatIsAskedForWins) {
    write_lamp("in.exr");
    report("glare in.exr -o ten.exr --output-layers glare" + kThesis);
    const auto json = report(
        "glare in.exr -o five.exr --output-layers glare --gain 5 --pupil 7.9 --eyelid 0.5 "
        "--eyelashes 4 --halo 2 --streaks 0" +
        kThesis);
    const auto& parameters = json["parameters"];
    EXPECT_EQ(parameters["gain"], 5);
    EXPECT_EQ(parameters["pages"]["pupil"], 59);
    EXPECT_NEAR(parameters["eyelid"].get<double>(), 0.5, 0.03);
    EXPECT_EQ(parameters["eyelashes"], 4);
    EXPECT_EQ(parameters["halo"]["weight"], 1.5);
    EXPECT_EQ(parameters["streaks"]["weight"], 0);
    report("glare in.exr -o half.exr --output-layers glare --gain 5" + kThesis);
    const io::Picture ten = read("ten.exr");
    const io::Picture half = read("half.exr");
    EXPECT_NEAR(half.image().at(42, 24, 1) / ten.image().at(42, 24, 1), 0.5, 1e-4);
    // A threshold that no pixel passes.
    report("glare in.exr -o none.exr --threshold 0.99" + kThesis);
    EXPECT_LT(largest_difference(read("none.exr").image().view(), read("in.exr").image().view()),
              1e-6);
    EXPECT_EQ(
        report("glare in.exr -o o.exr --adaptation 1" + kThesis)["parameters"]["pages"]["pupil"],
        22)
        << "4.9 - 3 tanh(.4) mm, eq. 2.14";
}

TEST_F(Thesis, OptionsWithoutEffectAreRefused) {
    write_lamp("in.exr");
    const std::vector<std::pair<std::string, std::string>> refused = {
        {"--scatter ijspeert", "--scatter"},
        {"--age 60", "--age"},
        {"--pigmentation blue", "--pigmentation"},
        {"--corona-contrast 2", "--corona-contrast"},
        {"--source-spectrum led", "--source-spectrum"},
        {"--field-varying on", "--field-varying"},
        {"--surround same", "--surround"},
        {"--time 1 --squint 0.2", "--squint"},
        {"--time 1 --motion saccades", "--motion"},
        {"--time 1 --blink 1,2", "--blink"},
        {"--time 1 --blink auto --eyelid 0.3", "--eyelid"},
        {"--blink auto", "--time"},
        {"--observer camera", "--observer eye"},
    };
    for (const auto& [option, name] : refused) {
        const Outcome outcome = run("glare in.exr -o out.exr " + option + kThesis);
        EXPECT_NE(outcome.exit_code, 0) << option;
        EXPECT_TRUE(names_all(outcome.err, {name})) << option;
        EXPECT_FALSE(exists("out.exr")) << option;
    }
}

TEST_F(Thesis, FramesTurnThePages) {
    for (const char* name : {"in.0000.exr", "in.0001.exr", "in.0063.exr"}) write_lamp(name);
    ASSERT_EQ(run("glare in.%04d.exr --frames 0,1,63 -o a.%04d.exr" + kThesis).exit_code, 0);
    // Backwards, one by one, and by time.
    ASSERT_EQ(run("glare in.%04d.exr --frames 63,0 -o b.%04d.exr" + kThesis).exit_code, 0);
    const auto json = report("glare in.%04d.exr --frames 63 -o c.%04d.exr --fps 30" + kThesis);
    EXPECT_EQ(bytes("a.0000.exr"), bytes("b.0000.exr"));
    EXPECT_EQ(bytes("a.0063.exr"), bytes("b.0063.exr"));
    EXPECT_EQ(bytes("a.0063.exr"), bytes("c.0063.exr"));
    EXPECT_NE(bytes("a.0001.exr"), bytes("a.0000.exr"));
    const auto& pages = json["parameters"]["pages"];
    EXPECT_EQ(pages["pupil"], 55);     // 118 - 63
    EXPECT_EQ(pages["gratings"], 50);  // 5 frames later
    EXPECT_EQ(pages["particles"], 3);  // 63 - 60
    EXPECT_EQ(pages["lids"], 31);      // half as fast
    const auto open = report("glare in.0001.exr -o d.exr --time 2.1 --blink off" + kThesis);
    EXPECT_EQ(open["parameters"]["pages"]["lids"], 0);
    EXPECT_EQ(open["parameters"]["pages"]["pupil"], 55);
}

}  // namespace
}  // namespace aureole::cli
