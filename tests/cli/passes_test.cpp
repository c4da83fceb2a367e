// aureole glare --passes, and the preset that is made of it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "program.h"

namespace aureole::cli {
namespace {

const std::string kCamera = " --observer camera --blades 6 --f-number 16 --ghosts none";

class Passes : public CliTest {
  protected:
    void SetUp() override {
        // Lights over a dim ground; the view is narrow enough for streaks to have a shape.
        Image picture = constant(64, 48, 3, 0.2F);
        for (int c = 0; c < 3; ++c) {
            picture.at(20, 15, c) = 900;
            picture.at(47, 40, c) = 300.0F * static_cast<float>(c + 1);
            picture.at(0, 47, c) = 50;
        }
        write("in.exr", picture);
    }
    Image glare(const std::string& options) const {
        const Outcome outcome = run("glare in.exr -o glare.exr --fov 6" + options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return read("glare.exr").image();
    }
    Image glare_of(const std::string& name, const std::string& options) const {
        const Outcome outcome = run("glare " + name + " -o glare.exr --fov 6" + options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return read("glare.exr").image();
    }
};

// The bloom of the picture with streaks, not of the picture: of eye and camera.
TEST_F(Passes, BothAreBloomAfterStreaks) {
    for (const std::string& observer : {std::string(" --pupil 6"), kCamera}) {
        const Image both = glare(observer + " --passes both --threshold 1");
        write("streaks.exr", glare(observer + " --passes streaks --threshold 1"));
        const Image in_turn = glare_of("streaks.exr", observer + " --passes bloom");
        EXPECT_LT(largest_difference(both, in_turn), 1e-6 * largest(both)) << observer;
        const Image other = glare(observer + " --passes bloom");
        EXPECT_GT(largest_difference(both, other), 1e-4 * largest(both)) << observer;
    }
}

// Without a threshold both are linear, and the same in either order.
TEST_F(Passes, CommuteWithoutAThreshold) {
    const Image both = glare(" --passes both --pupil 6");
    write("bloom.exr", glare(" --passes bloom --pupil 6"));
    // Borders do not: what has left the picture does not come back.
    const Image in_turn = glare_of("bloom.exr", " --passes streaks --pupil 6");
    for (int y = 8; y < 40; ++y) {
        for (int x = 8; x < 56; ++x) {
            ASSERT_NEAR(both.at(x, y, 1), in_turn.at(x, y, 1), 0.01 * double{both.at(x, y, 1)});
        }
    }
}

// What leaves the picture in either pass is counted.
TEST_F(Passes, ConserveEnergy) {
    for (const std::string& options :
         {std::string(" --passes both"), std::string(" --passes streaks"),
          " --passes both --surround same" + kCamera, " --passes bloom" + kCamera}) {
        const auto energy = report("glare in.exr -o out.exr --fov 50" + options)["energy"];
        const double in = energy["in"].get<double>() + energy.value("from_surround", 0.0);
        EXPECT_NEAR((energy["out"].get<double>() + energy["off_picture"].get<double>()) / in, 1,
                    1e-4)
            << options;
    }
}

// Bloom is of all light, streaks of what is above the threshold: a picture below it has none.
TEST_F(Passes, ThresholdAndMethodAreOfStreaks) {
    const Image none = glare(" --passes streaks --threshold 1000");
    EXPECT_LT(largest_difference(none, read("in.exr").image()), 1e-6);
    const Image bloom = glare(" --passes bloom");
    EXPECT_LT(largest_difference(glare(" --passes both --threshold 1000"), bloom),
              1e-6 * largest(bloom));
    const auto json =
        report("glare in.exr -o out.exr --fov 6 --passes both --method sprites --threshold 1");
    EXPECT_EQ(json["method"], "sprites");
    EXPECT_EQ(json["method_choice"]["sprites"], 3);
    EXPECT_EQ(json["parameters"]["cluster_side"], 16);
    EXPECT_EQ(json["parameters"]["passes"], "both");
}

// Halation moves its share of a light, no more and no less.
TEST_F(Passes, FilmThrowsBackItsShare) {
    write("in.exr", point(161, 121, 3, 80, 60, 1000));
    const Image film = glare(kCamera + " --passes bloom --halation 0.25 --halation-backing 0");
    EXPECT_NEAR(film.at(80, 60, 0), 750, 1);
    EXPECT_GT(film.at(80 + 10, 60, 0), 0);
    const auto json =
        report("glare in.exr -o out.exr --passes bloom --halation-layer 0.5" + kCamera);
    EXPECT_EQ(json["parameters"]["halation"], 0.1);
    EXPECT_EQ(json["parameters"]["halation_layer_mm"], 0.5);
    EXPECT_EQ(json["parameters"]["starburst"], false);
}

TEST_F(Passes, WithoutGhostsThereAreNone) {
    const auto json = report("glare in.exr -o a.exr --fov 20 --observer camera --ghosts none");
    EXPECT_FALSE(json["energy"].contains("ghosts"));
    EXPECT_FALSE(json["seconds"].contains("ghosts"));
    ASSERT_EQ(run("glare in.exr -o b.exr --fov 20 --observer camera --tint 0").exit_code, 0);
    EXPECT_TRUE(identical(read("a.exr").image(), read("b.exr").image()));
}

// ---- The preset ----

TEST_F(Passes, SikachevIsItsOptions) {
    const std::string options =
        " --passes both --method sprites --cluster-error 0.001 --threshold 1 --tone-map xyz "
        "--resolution half --antialias edges";
    const auto same = [&](const std::string& preset, const std::string& bundle) {
        EXPECT_EQ(run("glare in.exr -o a.exr -o a.png --fov 6" + preset).exit_code, 0);
        EXPECT_EQ(run("glare in.exr -o b.exr -o b.png --fov 6" + bundle).exit_code, 0);
        EXPECT_TRUE(identical(read("a.exr").image(), read("b.exr").image())) << preset;
        EXPECT_TRUE(identical(read("a.png").image(), read("b.png").image())) << preset;
    };
    same(" --preset sikachev", options);
    same(" --preset sikachev --observer camera",
         options + " --observer camera --blades 6 --ghosts none");
}

TEST_F(Passes, WhatIsGivenWinsOverThePreset) {
    const auto json = report(
        "glare in.exr -o a.exr -o a.png --fov 6 --observer camera --threshold 2 --method fft "
        "--preset sikachev --blades 5 --tone-map hill --passes streaks");
    EXPECT_EQ(json["method"], "fft");
    const auto& parameters = json["parameters"];
    EXPECT_EQ(parameters["preset"], "sikachev");
    EXPECT_EQ(parameters["threshold"], 2);
    EXPECT_EQ(parameters["blades"], 5);
    EXPECT_EQ(parameters["tone_map"], "hill");
    EXPECT_EQ(parameters["antialias"], "edges");
    EXPECT_EQ(parameters["passes"], "streaks");
    EXPECT_EQ(parameters["ghosts"], "none");
    const auto eye = report("glare in.exr -o a.exr --fov 6 --preset sikachev --streaks 2");
    EXPECT_EQ(eye["parameters"]["preset"], "sikachev");
    EXPECT_EQ(eye["parameters"]["streaks"], 2);
    EXPECT_EQ(eye["parameters"]["corona_contrast"], 1);
}

TEST_F(Passes, StarsMayErrLess) {
    const auto error_of = [&](const std::string& options) {
        return report("glare in.exr -o a.exr --fov 6 --method sprites" +
                      options)["parameters"]["cluster_error"]
            .get<double>();
    };
    EXPECT_EQ(error_of(" --pupil 6"), 0.01);
    EXPECT_EQ(error_of(" --observer camera"), 0.001);
    EXPECT_EQ(error_of(" --observer camera --cluster-error 0.02"), 0.02);
}

// Of a preset's values none counts as given, so that none is refused where it has no effect.
TEST_F(Passes, ThePresetFitsEveryUse) {
    // Without bloom there is nothing for the preset's resolution.
    const auto streaks = report("glare in.exr -o a.exr --fov 6 --preset sikachev --passes streaks");
    EXPECT_EQ(streaks["parameters"]["resolution"], "full");
    EXPECT_EQ(streaks["method"], "sprites");
    EXPECT_EQ(run("glare in.exr -o a.exr --fov 6 --preset sikachev --passes bloom").exit_code, 0);
    write("iris.exr", constant(64, 64, 1, 1));
    EXPECT_EQ(run("glare in.exr -o a.exr --fov 6 --preset sikachev --observer camera "
                  "--iris iris.exr")
                  .exit_code,
              0);
}

TEST_F(Passes, RefuseWhatHasNoEffect) {
    const auto refused = [&](const std::string& options, const std::vector<std::string>& words) {
        const Outcome outcome = run("glare in.exr -o out.exr" + options);
        EXPECT_EQ(outcome.exit_code, 2) << options;
        EXPECT_TRUE(names_all(outcome.err, words)) << options;
        EXPECT_FALSE(exists("out.exr"));
    };
    refused(" --passes twice", {"--passes", "twice", "both"});
    refused(" --passes bloom --threshold 1", {"--threshold", "streaks", "--passes bloom"});
    refused(" --passes bloom --method sprites", {"--method", "streaks"});
    refused(" --passes both --field-varying on", {"--field-varying", "--passes both"});
    refused(" --passes both --psf k.exr", {"--passes both", "--psf"});
    refused(" --preset sikachev --psf k.exr", {"--psf", "--preset"});
    refused(" --preset sikachev --field-varying on", {"--field-varying", "--passes both"});
    refused(" --cluster-side 3", {"--cluster-side", "3", "16"});
    refused(" --cluster-side 4", {"--cluster-side", "4", "sprites", "fft is exact"});
    refused(" --halation .1", {"--halation", "camera"});
    refused(" --halation .1 --observer camera", {"--halation", "--passes both"});
    refused(" --halation 2 --observer camera --passes both", {"--halation", "2", "from 0 to 1"});
    refused(" --ghosts none", {"--ghosts", "camera"});
    refused(" --ghosts none --pairs all --observer camera", {"--pairs", "--ghosts none"});
    refused(" --ghosts none --light 1,1,5 --observer camera", {"--light", "--ghosts none"});
    refused(" --preset sikachev --observer camera --tint 1", {"--tint", "--ghosts none"});
    const Outcome flare = run("flare in.exr -o out.exr --lens heliar --ghosts none");
    EXPECT_EQ(flare.exit_code, 2);
    EXPECT_TRUE(names_all(flare.err, {"--ghosts", "none", "--starburst"}));
}

// ---- Recomputed only when an input changes ----

TEST_F(Passes, PsfsAreMadeOnceForPicturesThatSeeTheSame) {
    for (int frame = 1; frame <= 4; ++frame) {
        write("shot." + std::to_string(frame) + ".exr", noise(40, 30, 3, 5));
    }
    const auto made = [&](const std::string& options) {
        return report("glare shot.#.exr --frames 1-4 -o out.#.exr --fov 20" + options)["psfs_made"]
            .get<int>();
    };
    EXPECT_EQ(made(" --observer camera --preset sikachev"), 1);
    EXPECT_EQ(made(" --preset sikachev" + kPlainEye), 1);   // the eye of the first frame
    EXPECT_EQ(made(" --pupil 4 --fps 24" + kPlainEye), 4);  // an eye that moves
    // Pictures of their own: each has the pupil that its light makes, a camera has none.
    write("a.exr", constant(40, 30, 3, 1));
    write("b.exr", constant(40, 30, 3, 8));
    write("c.exr", constant(44, 30, 3, 8));
    const auto of_three = [&](const std::string& options) {
        std::filesystem::create_directory(file("out"));
        return report("glare a.exr b.exr c.exr -o out --fov 20" + options)["psfs_made"].get<int>();
    };
    EXPECT_EQ(of_three(kPlainEye), 3);
    EXPECT_EQ(of_three(" --pupil 4" + kPlainEye), 2);
    EXPECT_EQ(of_three(" --observer camera"), 2);
}

}  // namespace
}  // namespace aureole::cli
