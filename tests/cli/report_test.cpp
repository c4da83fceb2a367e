// What the program tells about its work: --json, --quiet, and the account of the energy.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "aureole/image/view.h"
#include "program.h"

namespace aureole::cli {
namespace {

using Report = CliTest;

TEST_F(Report, OfGlareHasTheDocumentedKeys) {
    write("in.exr", noise(16, 12, 3));
    write("k.exr", soft_kernel(9));
    for (const std::string& kernel : {std::string(""), std::string(" --psf k.exr")}) {
        const Outcome outcome = run("glare in.exr -o out.exr --json" + kernel);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const auto json =
            nlohmann::json::parse(outcome.out);  // throws unless it is JSON and only that
        for (const char* stage : {"read", "psf", "plan", "apply", "write"}) {
            EXPECT_GE(json["seconds"][stage].get<double>(), 0) << stage;
        }
        for (const char* key : {"in", "out", "off_picture"}) {
            EXPECT_TRUE(json["energy"][key].is_number()) << key;
        }
        EXPECT_EQ(json["method"], "fft");
        EXPECT_EQ(json["nonfinite_pixels"], 0);
        EXPECT_EQ(json["outputs"], nlohmann::json::array({"out.exr"}));
        const auto& parameters = json["parameters"];
        EXPECT_EQ(parameters["gain"], 1);
        EXPECT_EQ(parameters["threshold"], 0);
        EXPECT_EQ(parameters["output_layers"], "composite");
        EXPECT_EQ(parameters["white_luminance_cd_m2"], 100);
        EXPECT_EQ(parameters["depth"], "float");
        EXPECT_EQ(parameters["perspective"], true);
        EXPECT_NEAR(parameters["fov_deg"].get<double>(), 60, 1e-6);
        EXPECT_GE(parameters["threads"].get<int>(), 1);
        if (!kernel.empty()) {
            EXPECT_EQ(parameters["psf"], "k.exr");
            continue;
        }
        EXPECT_EQ(parameters["preset"], "physical");
        EXPECT_EQ(parameters["age_years"], 30);
        EXPECT_EQ(parameters["pigmentation"], "brown");
        EXPECT_EQ(parameters["scatter"], "cie");
        EXPECT_EQ(parameters["pupil_model"], "watson-yellott");
        EXPECT_EQ(parameters["corona_contrast"], 1);
        EXPECT_EQ(parameters["eyelashes"], 7);
        EXPECT_EQ(parameters["seed"], 1);
        EXPECT_GT(parameters["pupil_mm"].get<double>(), 1);
        EXPECT_GT(parameters["adaptation_cd_m2"].get<double>(), 0);
    }
}

TEST_F(Report, OfPsfAndSceneAreJson) {
    const auto psf = report("psf --size 33 --pupil 4 -o k.exr");
    EXPECT_GT(psf["seconds"]["psf"].get<double>(), 0);
    EXPECT_EQ(psf["parameters"]["pupil_mm"], 4);
    EXPECT_EQ(psf["parameters"]["size"], 33);
    EXPECT_EQ(psf["energy"]["off_kernel"].size(), 3U);
    const auto scene = report("scene point --width 16 --height 12 -o p.exr");
    EXPECT_EQ(scene["scene"], "point");
    EXPECT_EQ(scene["parameters"]["width"], 16);
    EXPECT_EQ(scene["outputs"], nlohmann::json::array({"p.exr"}));
}

TEST_F(Report, SummaryNamesTheFiles) {
    write("in.exr", noise(16, 12, 3));
    write("k.exr", soft_kernel(9));
    const Outcome outcome = run("glare in.exr -o out.exr -o out.png --psf k.exr");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(names_all(outcome.out, {"out.exr\n", "out.png\n"}));
}

TEST_F(Report, QuietPrintsNothing) {
    Image image = noise(16, 12, 3);
    image.at(0, 0) = std::nanf("");
    write("in.exr", image);
    write("k.exr", soft_kernel(9));
    for (const char* words :
         {"glare in.exr -o out.exr --psf k.exr --quiet", "psf --size 9 -o k2.exr --quiet",
          "scene point --width 8 --height 8 -o p.exr --quiet"}) {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exit_code, 0) << words;
        EXPECT_EQ(outcome.out, "") << words;
        EXPECT_EQ(outcome.err, "") << words;
    }
}

// Errors are no chatter.
TEST_F(Report, QuietStillSaysWhatWentWrong) {
    EXPECT_TRUE(names_all(run("glare missing.exr -o out.exr --quiet").err, {"missing.exr"}));
}

TEST_F(Report, PupilFollowsTheLuminanceOfThePicture) {
    write("dark.exr", constant(16, 12, 3, 0.01F));
    write("bright.exr", constant(16, 12, 3, 10));
    const auto pupil = [&](const std::string& words) {
        return report("glare " + words + " -o out.exr" + kPlainEye)["parameters"]["pupil_mm"]
            .get<double>();
    };
    const double dark = pupil("dark.exr");
    const double bright = pupil("bright.exr");
    EXPECT_GT(dark, 5);
    EXPECT_LT(bright, 4);
    EXPECT_NEAR(pupil("bright.exr --white-luminance 0.1"), dark, 1e-6);
    EXPECT_NEAR(pupil("dark.exr --adaptation 1000"), bright, 1e-4);
    EXPECT_NEAR(pupil("dark.exr --pupil 3.5"), 3.5, 1e-9);
    io::Picture labelled(constant(16, 12, 3, 0.01F));
    labelled.set_attribute("aureole:adaptation_cd_m2", 1000.0F);
    write("labelled.exr", labelled);
    EXPECT_NEAR(pupil("labelled.exr"), bright, 1e-4);
}

struct EnergyCase {
    std::string name;
    std::string scene;
    std::string options;
    double fov_deg;
    Projection projection;
};

class Energy : public CliTest, public testing::WithParamInterface<EnergyCase> {};

// Sum over pixels and colours, weighted by solid angle in perspective.
double energy_of(const Image& image, const EnergyCase& c) {
    const View view = View::from_fov(image.width(), image.height(), c.fov_deg, c.projection);
    double sum = 0;
    for (int channel = 0; channel < 3; ++channel) {
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const double weight = c.projection == Projection::kPerspective
                                          ? view.pixel_solid_angle_sr(x, y)
                                          : 1.0;
                sum += weight * image.at(x, y, channel);
            }
        }
    }
    return sum;
}

// The account adds up, and is that of the files.
TEST_P(Energy, IsConserved) {
    const EnergyCase& c = GetParam();
    ASSERT_EQ(run("scene " + c.scene + " -o in.exr").exit_code, 0);
    const auto energy = report("glare in.exr -o out.exr " + c.options)["energy"];
    const double in = energy["in"];
    const double out = energy["out"];
    const double off = energy["off_picture"];
    EXPECT_GT(off, 0);
    EXPECT_NEAR((out + off) / in, 1, 1e-4);
    EXPECT_NEAR(energy_of(read("in.exr").image(), c) / in, 1, 1e-5);
    EXPECT_NEAR(energy_of(read("out.exr").image(), c) / out, 1, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(
    Scene, Energy,
    testing::Values(EnergyCase{"point_in_perspective", "point --width 97 --height 54",
                               "--pupil 6 --fov 60", 60, Projection::kPerspective},
                    EnergyCase{"point_in_the_corner",
                               "point --width 96 --height 54 --point-x 95 --point-y 0",
                               "--pupil 3 --fov 90 --preset vivid", 90, Projection::kPerspective},
                    EnergyCase{"point_at_constant_pitch",
                               "point --width 64 --height 64 --point-x 10 --point-y 40",
                               "--fov 60 --perspective off --age 70", 60,
                               Projection::kConstantPitch},
                    EnergyCase{"point_with_a_threshold",
                               "point --width 64 --height 36 --point-x 10 --point-y 30",
                               "--fov 30 --threshold 10 --gain 3", 30, Projection::kConstantPitch},
                    EnergyCase{"bars", "bars --width 96 --height 54", "--fov 50 --scatter ijspeert",
                               50, Projection::kPerspective}),
    [](const auto& test_case) { return test_case.param.name; });

}  // namespace
}  // namespace aureole::cli
