// Metering a sequence, and the tables that come of it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "program.h"

namespace aureole::cli {
namespace {

class Meter : public CliTest {
  protected:
    // A lamp that lights up at frame 16.
    void write_frames(int count) const {
        for (int frame = 0; frame < count; ++frame) {
            Image picture = constant(24, 16, 3, 0.02F);
            for (int c = 0; c < 3; ++c) picture.at(7, 5, c) = frame < 16 ? 1.0F : 4000.0F;
            write("in." + std::to_string(frame) + ".exr", picture);
        }
    }
    std::vector<std::vector<double>> table(const std::string& name) const {
        std::istringstream stream(bytes(name));
        std::string line;
        std::getline(stream, line);
        std::vector<std::vector<double>> rows;
        while (std::getline(stream, line)) {
            std::istringstream cells(line);
            rows.emplace_back();
            for (std::string cell; std::getline(cells, cell, ',');) {
                rows.back().push_back(std::stod(cell));
            }
        }
        return rows;
    }
};

TEST_F(Meter, WritesLuminancesAndTheirDampedAdaptation) {
    write_frames(48);
    ASSERT_EQ(run("meter in.%d.exr --frames 0-47 -o a.csv --fps 24 --fov 40").exit_code, 0);
    EXPECT_EQ(bytes("a.csv").substr(0, 79),
              "frame,time_s,mean_cd_m2,log_mean_cd_m2,central_cd_m2,adaptation_cd_m2\n0,0,2.255");
    const auto rows = table("a.csv");
    ASSERT_EQ(rows.size(), 48U);
    const double dark = 2 + 0.98 * 100 / 384;
    const double lit = 2 + (4000 - 0.02) * 100 / 384;
    for (std::size_t i = 0; i < 48; ++i) {
        EXPECT_EQ(rows[i][0], static_cast<double>(i));
        EXPECT_NEAR(rows[i][1], static_cast<double>(i) / 24, 1e-12);
        EXPECT_NEAR(rows[i][2] / (i < 16 ? dark : lit), 1, 1e-5);
        EXPECT_NEAR(rows[i][3], 2 * std::pow(i < 16 ? 50 : 200000, 1.0 / 384), 1e-3);
        EXPECT_NEAR(rows[i][4], 2, 1e-4);  // the lamp is off the axis
        EXPECT_GE(rows[i][5], dark * 0.999);
        EXPECT_LE(rows[i][5], lit * 1.001);
        if (i > 0) {
            EXPECT_GE(rows[i][5], rows[i - 1][5] * 0.999999);
        }
    }
    // Nothing within the delay of .2 s; most of it after a second.
    EXPECT_NEAR(rows[19][5] / dark, 1, 1e-5);
    EXPECT_LT(rows[21][5], lit / 10);
    EXPECT_GT(rows[47][5], lit / 2);
    ASSERT_EQ(run("meter in.%d.exr --frames 0-47 -o b.csv --fov 40 --adapt-to central").exit_code,
              0);
    EXPECT_NEAR(table("b.csv")[47][5], 2, 1e-4);
}

TEST_F(Meter, PutsFramesInTheOrderOfTheirTimes) {
    write_frames(4);
    ASSERT_EQ(run("meter in.%d.exr --frames 0-3 -o a.csv --fov 40").exit_code, 0);
    ASSERT_EQ(run("meter in.%d.exr --frames 3,0,2,1 -o b.csv --fov 40").exit_code, 0);
    EXPECT_EQ(bytes("a.csv"), bytes("b.csv"));
}

TEST_F(Meter, LeavesPicturesAlone) {
    write_frames(1);
    const std::string before = bytes("in.0.exr");
    const auto fails = [&](const std::string& output, const std::string& why) {
        const Outcome outcome = run("meter in.0.exr --fov 40 -o " + output);
        EXPECT_EQ(outcome.exit_code, 2) << output;
        EXPECT_TRUE(names_all(outcome.err, {"--output", output, why})) << outcome.err;
    };
    fails("in.0.exr", "CSV");
    fails("a.exr", "CSV");
    fails("a.PNG", "CSV");
    // Under a name that is none of a picture.
    write_bytes("picture", before);
    const Outcome same = run("meter picture --fov 40 -o ./picture");
    EXPECT_EQ(same.exit_code, 2);
    EXPECT_TRUE(names_all(same.err, {"--output", "INPUT"})) << same.err;
    EXPECT_EQ(bytes("picture"), before);
    EXPECT_EQ(bytes("in.0.exr"), before);
    EXPECT_FALSE(exists("a.exr"));
}

TEST_F(Meter, CountsWhatIsNotFinite) {
    Image picture = constant(8, 8, 3, 1);
    picture.at(2, 3, 1) = std::numeric_limits<float>::quiet_NaN();
    picture.at(5, 5, 0) = std::numeric_limits<float>::infinity();
    write("in.exr", picture);
    const Outcome outcome = run("meter in.exr --fov 40 -o a.csv");
    EXPECT_TRUE(names_all(outcome.err, {"in.exr", "2 pixels", "NaN"})) << outcome.err;
    EXPECT_EQ(report("meter in.exr --fov 40 -o a.csv")["nonfinite_pixels"], 2);
}

// Brighter than any eye has ranges for, and finite.
TEST_F(Meter, MetersPicturesBeyondAllLight) {
    write("in.exr", constant(8, 8, 3, 3e38F));
    const std::string common = " in.exr --fov 40 --white-luminance 1e6 -o ";
    ASSERT_EQ(run("meter" + common + "a.csv").exit_code, 0);
    EXPECT_NEAR(table("a.csv")[0][5], 1e12, 1);
    EXPECT_EQ(run("glare" + common + "out.exr --time 0" + kPlainEye).exit_code, 0);
    const Outcome outcome = run("meter in.exr --fps 1e-300 --frames 7 -o a.csv");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(names_all(outcome.err, {"--fps", "frame 7"})) << outcome.err;
}

}  // namespace
}  // namespace aureole::cli
