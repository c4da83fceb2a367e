// Metering a sequence, and an eye that moves through it: frames do not depend on their order.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "program.h"

namespace aureole::cli {
namespace {

class Motion : public CliTest {
  protected:
    static std::string numbered(const std::string& before, int frame) {
        const std::string number = std::to_string(frame);
        return before + "." + std::string(4 - number.size(), '0') + number + ".exr";
    }
    // A lamp that lights up at frame 16.
    void write_frames(int count) const {
        for (int frame = 0; frame < count; ++frame) {
            Image picture = constant(24, 16, 3, 0.02F);
            for (int c = 0; c < 3; ++c) picture.at(7, 5, c) = frame < 16 ? 1.0F : 4000.0F;
            write(numbered("in", frame), picture);
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

// Quick, and its scatter knows the pupil.
const std::string kMovingEye = kPlainEye + " --scatter ijspeert --fps 24 --blink auto --seed 3 ";

TEST_F(Motion, MeterWritesLuminancesAndTheirDampedAdaptation) {
    write_frames(48);
    ASSERT_EQ(run("meter in.%04d.exr --frames 0-47 -o a.csv --fps 24 --fov 40").exit_code, 0);
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
    ASSERT_EQ(run("meter in.%04d.exr --frames 0-47 -o b.csv --fov 40 --adapt-to central").exit_code,
              0);
    EXPECT_NEAR(table("b.csv")[47][5], 2, 1e-4);
}

TEST_F(Motion, FramesAreTheSameForwardsBackwardsAndInTwoHalves) {
    write_frames(48);
    ASSERT_EQ(run("meter in.%04d.exr --frames 0-47 -o a.csv --fov 40").exit_code, 0);
    const std::string common = "glare in.%04d.exr --adaptation a.csv --fov 40" + kMovingEye;
    std::string backwards;
    for (int frame = 47; frame >= 0; --frame) {
        backwards += std::to_string(frame) + (frame > 0 ? "," : "");
    }
    const std::vector<std::string> runs = {
        " -o one.%04d.exr --frames 0-47", " -o two.%04d.exr --frames " + backwards,
        " -o three.%04d.exr --frames 24-47", " -o three.%04d.exr --frames 0-23"};
    for (const std::string& words : runs) {
        const Outcome outcome = run(common + words);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    int changed = 0;
    for (int frame = 0; frame < 48; ++frame) {
        const Image one = read(numbered("one", frame)).image();
        EXPECT_TRUE(identical(one, read(numbered("two", frame)).image())) << frame;
        EXPECT_TRUE(identical(one, read(numbered("three", frame)).image())) << frame;
        if (frame > 16) {
            changed += identical(one, read(numbered("one", frame - 1)).image()) ? 0 : 1;
        }
    }
    EXPECT_EQ(changed, 31);
}

TEST_F(Motion, FramesOfAWholeEyeDoNotDependOnTheOneBefore) {
    write_frames(2);
    const std::string common =
        "glare in.%04d.exr --pupil 6 --fov 20 --fps 24 --motion saccades --time 3 ";
    ASSERT_EQ(run(common + "--frames 0-1 -o one.%04d.exr").exit_code, 0);
    ASSERT_EQ(run(common + "--frames 1 -o two.%04d.exr").exit_code, 0);
    EXPECT_TRUE(identical(read("one.0001.exr").image(), read("two.0001.exr").image()));
    EXPECT_FALSE(identical(read("one.0000.exr").image(), read("one.0001.exr").image()));
}

TEST_F(Motion, LidsDimAndTheLightTheyBlockIsCounted) {
    write("in.exr", point(24, 16, 3, 12, 8, 1000));
    const std::string common = "glare in.exr -o out.exr --fov 40 --adaptation 10" + kPlainEye;
    double darkest = 1;
    for (const std::string time : {"0.9", "1.05", "1.08", "1.2"}) {
        const auto json = report(common + "--blink 1 --time " + time);
        const double share = json["parameters"]["light_share"].get<double>();
        const auto& energy = json["energy"];
        const double blocked = energy.value("blocked", 0.0);
        const double in = energy["in"].get<double>();
        EXPECT_NEAR(blocked / in, 1 - share, 1e-6) << time;
        EXPECT_NEAR(
            (energy["out"].get<double>() + energy["off_picture"].get<double>() + blocked) / in, 1,
            1e-4)
            << time;
        darkest = std::min(darkest, share);
    }
    EXPECT_LT(darkest, 0.3);
    const auto streaks = report(common + "--blink streaks --time 1.05");
    EXPECT_EQ(streaks["parameters"]["light_share"], 1);
}

TEST_F(Motion, ClosedLidsLeaveABlackPicture) {
    write("in.exr", point(24, 16, 3, 12, 8, 1000));
    // A blink closes within 63 to 121 ms; somewhere in between nothing of the pupil is left.
    double least = 1e30;
    for (int ms = 1060; ms <= 1125; ms += 5) {
        ASSERT_EQ(run("glare in.exr -o out.exr --fov 40 --adaptation 10 --blink 1 --time " +
                      std::to_string(ms / 1000.0) + kPlainEye)
                      .exit_code,
                  0);
        least = std::min(least, largest(read("out.exr").image()));
    }
    EXPECT_LT(least, 0.002 * 1000);
}

TEST_F(Motion, FollowsTheHeadThroughATable) {
    write("in.exr", point(24, 16, 3, 12, 8, 1000));
    write_bytes(
        "head.csv",
        "# a turn to the right\ntime_s, yaw_deg, pitch_deg, roll_deg\n0,0,0,0\n.1,20,5,0\n");
    const std::string common = "glare in.exr -o out.exr --fov 40 --adaptation 10" + kPlainEye;
    const auto turned = report(common + "--motion head.csv --time .1");
    EXPECT_LT(turned["parameters"]["vitreous_yaw_deg"].get<double>(), -8);
    EXPECT_LT(turned["parameters"]["vitreous_pitch_deg"].get<double>(), -2);
    const auto rest = report(common + "--motion head.csv --time 60");
    EXPECT_NEAR(rest["parameters"]["vitreous_yaw_deg"].get<double>(), 0, 1e-6);
}

// The kernel of a moment is the one that glare would make then; the light that the lids leave is
// reported beside it.
TEST_F(Motion, PsfOfAMomentIsTheEyeOfThatMoment) {
    write("in.exr", point(24, 16, 3, 12, 8, 1000));
    write_bytes("adaptation.csv", "time_s,adaptation_cd_m2\n0,1000\n1,1\n");
    const std::string eye =
        " --fov 40 --adaptation adaptation.csv --motion saccades --blink 1 --time 1.03 --scatter "
        "none";
    const auto seen = report("glare in.exr -o eye.exr" + eye);
    const auto made = report("psf -o k.exr --width 24 --height 16 --size 47" + eye);
    for (const std::string key :
         {"pupil_mm", "vitreous_yaw_deg", "light_share", "eyelid", "time_s", "motion", "blink"}) {
        EXPECT_EQ(seen["parameters"][key], made["parameters"][key]) << key;
    }
    EXPECT_LT(made["parameters"]["light_share"], 0.999);
    const double share = made["parameters"]["light_share"];
    ASSERT_EQ(run("glare in.exr -o file.exr --psf k.exr --fov 40").exit_code, 0);
    const Image with_eye = read("eye.exr").image();
    Image with_file = read("file.exr").image();
    for (std::size_t i = 0; i < 3 * with_file.pixels(); ++i) {
        with_file.plane(0)[i] *= static_cast<float>(share);
    }
    EXPECT_LT(largest_difference(with_eye, with_file), 1e-5 * largest(with_eye));
    // Another moment is another kernel; the same one, the same.
    const std::string other = "psf -o b.exr --size 9 --pupil 5 --motion saccades --time ";
    ASSERT_EQ(run("psf -o a.exr --size 9 --pupil 5 --motion saccades --time 2").exit_code, 0);
    ASSERT_EQ(run(other + "2").exit_code, 0);
    EXPECT_TRUE(identical(read("a.exr").image(), read("b.exr").image()));
    ASSERT_EQ(run(other + "3").exit_code, 0);
    EXPECT_FALSE(identical(read("a.exr").image(), read("b.exr").image()));
}

TEST_F(Motion, SaysWhatIsMissingOrWrong) {
    write_frames(2);
    const auto fails = [&](const std::string& words, int code,
                           const std::vector<std::string>& named) {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exit_code, code) << words;
        EXPECT_TRUE(names_all(outcome.err, named)) << outcome.err;
        EXPECT_FALSE(exists("out.exr"));
    };
    const std::string one = "glare in.0000.exr -o out.exr --fov 40 ";
    fails(one + "--blink auto", 2, {"--blink", "--time"});
    fails(one + "--adaptation a.csv", 2, {"a.csv", "--time"});
    fails(one + "--adaptation a.csv --time 1", 1, {"a.csv"});
    fails("glare in.%04d.exr --frames 0-1 -o out.%04d.exr --fps 24", 2,
          {"--fps", "--adaptation", "meter"});
    fails(one + "--time 1 --squint 2", 2, {"--squint", "0.8"});
    fails(one + "--time 1 --fps 0", 2, {"--fps", "above 0"});
    fails(one + "--time 1 --observer camera", 2, {"--time", "--observer"});
    fails(one + "--time 1 --blink 3,1", 2, {"time", "later"});
    write_bytes("bad.csv", "time_s,adaptation_cd_m2\n0,1\n1,bright\n");
    fails(one + "--time 1 --adaptation bad.csv", 1, {"bad.csv", "line 3", "bright", "number"});
    write_bytes("bad.csv", "time_s,luminance\n0,1\n");
    fails(one + "--time 1 --adaptation bad.csv", 1, {"bad.csv", "adaptation_cd_m2", "luminance"});
    write_bytes("bad.csv", "time_s,adaptation_cd_m2\n0,1\n0,1\n");
    fails(one + "--time 1 --adaptation bad.csv", 1, {"bad.csv", "later"});
    write_bytes("bad.csv", "");
    fails(one + "--time 1 --adaptation bad.csv", 1, {"bad.csv", "no numbers"});
    const std::string psf = "psf -o out.exr --size 9 ";
    fails(psf + "--blink auto", 2, {"--blink", "--time"});
    fails(psf + "--adaptation a.csv", 2, {"a.csv", "--time"});
    fails(psf + "--time 1 --fps 24", 2, {"--fps"});
    fails(psf + "--time 1 --observer camera", 2, {"--time", "--observer"});
    fails("meter in.%04d.exr -o a.csv", 2, {"--frames"});
    fails("meter missing.exr -o a.csv", 1, {"missing.exr"});
}

}  // namespace
}  // namespace aureole::cli
