// An eye that moves through a sequence: frames do not depend on their order.
#include <gtest/gtest.h>

#include <cmath>
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
};

// Quick, and its scatter knows the pupil.
const std::string kMovingEye = kPlainEye + " --scatter ijspeert --fps 24 --blink auto --seed 3 ";

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
    const auto streaks = report(
        "glare in.exr -o out.exr --fov 40 --adaptation 10 --halo 0 "
        "--corona-contrast 0 --blink streaks --time 1.05");
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

// Light beyond the core of a light, frame by frame through a blink: it fades with what the lids let
// through, down to darkness, and its share of what is left never jumps.
TEST_F(Motion, GlareFadesWithTheLidsAndNeverJumps) {
    constexpr int kFrames = 15;
    for (int frame = 0; frame < kFrames; ++frame) {
        write(numbered("in", frame), point(48, 27, 3, 24, 13, 1e5F));
    }
    ASSERT_EQ(run("glare in.%04d.exr -o out.%04d.exr --frames 0-14 --fov 20 --pupil 6 --blink .35 "
                  "--time .41 --fps 500")
                  .exit_code,
              0);
    struct Light {
        double all = 0;
        double beyond = 0;
    };
    std::vector<Light> lights;
    for (int frame = 0; frame < kFrames; ++frame) {
        const Image out = read(numbered("out", frame)).image();
        Light& light = lights.emplace_back();
        for (int y = 0; y < out.height(); ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const double value = out.at(x, y, 1) / 1e5;
                light.all += value;
                if (std::hypot(x - 24, y - 13) > 1.5) light.beyond += value;
            }
        }
    }
    double darkest = 1;
    for (std::size_t i = 1; i < lights.size(); ++i) {
        const Light& before = lights[i - 1];
        const Light& now = lights[i];
        darkest = std::min(darkest, now.all);
        EXPECT_LE(std::abs(now.beyond - before.beyond), std::abs(now.all - before.all) + 1e-6) << i;
        if (now.all == 0 || before.all == 0) continue;
        EXPECT_NEAR(now.beyond / now.all, before.beyond / before.all, 0.02) << i;
    }
    EXPECT_LT(darkest, 0.001);
}

// Of closed lids the kernel is that of their last opening, and a note says so.
TEST_F(Motion, ClosedLidsHaveAKernel) {
    const std::string psf = "psf -o k.exr --size 9 --scatter none --pupil 6 --blink .35 --time ";
    const Outcome outcome = run(psf + ".428");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(names_all(outcome.err, {"--time 0.428", "closed", "light_share"})) << outcome.err;
    const Image closed = read("k.exr").image();
    const double share = report(psf + ".428")["parameters"]["light_share"];
    EXPECT_GT(share, 0);
    EXPECT_LT(share, 0.002);
    ASSERT_EQ(run(psf + ".43").exit_code, 0);
    EXPECT_LT(largest_difference(closed, read("k.exr").image()), 0.01 * largest(closed));
}

// With --time a picture tells its own luminance, to lids too; with --fps nothing does.
TEST_F(Motion, LidsSquintWhereTheLuminanceIsKnown) {
    write("bright.0001.exr", constant(24, 16, 3, 500));
    const auto eyelid = [&](const std::string& words) {
        const auto json = report("glare bright.0001.exr -o o.exr --fov 40 --pupil 3 --time 1 " +
                                 words + kPlainEye);
        return json["parameters"]["eyelid"].get<double>();
    };
    EXPECT_NEAR(eyelid("--squint .8"), 0.8, 1e-9);
    EXPECT_NEAR(eyelid(""), 0.5, 1e-9);
    EXPECT_EQ(eyelid("--squint 0"), 0);
    EXPECT_EQ(eyelid("--squint .8 --adaptation 100"), 0);
    const auto json = report(
        "glare bright.%04d.exr -o o.%04d.exr --frames 1 --fov 40 --pupil 3 --fps 24" + kPlainEye);
    EXPECT_EQ(json["parameters"]["squint"], 0);
    EXPECT_EQ(json["parameters"]["eyelid"], 0);
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

}  // namespace
}  // namespace aureole::cli
