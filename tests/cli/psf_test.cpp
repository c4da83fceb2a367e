// aureole psf: kernels for this and other tools.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "program.h"

namespace aureole::cli {
namespace {

double sum_of(const Image& image, int c) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) sum += image.plane(c)[i];
    return sum;
}

class PsfFile : public CliTest {
  protected:
    // The kernel and its attribute account for all the energy, in every colour.
    void expect_complete(const std::string& name) const {
        const io::Picture psf = read(name);
        for (int c = 0; c < 3; ++c) {
            const std::string attribute =
                std::string("aureole:off_kernel_energy_") + "rgb"[static_cast<std::size_t>(c)];
            const float off = psf.float_attribute(attribute).value_or(-1);
            EXPECT_GE(off, 0) << attribute;
            EXPECT_NEAR(sum_of(psf.image(), c) + off, 1, 1e-4) << attribute;
        }
    }
};

TEST_F(PsfFile, SumsToItsShareOfTheEnergy) {
    ASSERT_EQ(run("psf -o k.exr --size 129 --pupil 6 --fov 60 --width 480").exit_code, 0);
    const io::Picture psf = read("k.exr");
    EXPECT_EQ(psf.image().width(), 129);
    EXPECT_EQ(psf.image().height(), 129);
    expect_complete("k.exr");
    EXPECT_GT(sum_of(psf.image(), 1), 0.8);
    const float pitch = psf.float_attribute("aureole:pitch_deg").value_or(0);
    EXPECT_NEAR(pitch, std::atan(2 * std::tan(M_PI / 6) / 480) * 180 / M_PI, 1e-6);
    const float off = psf.float_attribute("aureole:off_kernel_energy").value_or(0);
    EXPECT_GT(off, 0);
    EXPECT_LT(off, 0.2);
    EXPECT_EQ(psf.string_attribute("aureole:projection"), "perspective");
}

TEST_F(PsfFile, AtConstantPitch) {
    ASSERT_EQ(run("psf -o k.exr --size 65 --pupil 4 --fov 20 --width 200").exit_code, 0);
    EXPECT_NEAR(read("k.exr").float_attribute("aureole:pitch_deg").value_or(0), 0.1, 1e-6);
    EXPECT_EQ(read("k.exr").string_attribute("aureole:projection"), "constant-pitch");
    expect_complete("k.exr");
}

class PsfComponent : public PsfFile, public testing::WithParamInterface<std::string> {};

TEST_P(PsfComponent, HasUnitEnergyAndAPicture) {
    const Outcome outcome =
        run("psf -o k.exr -o k.png --size 65 --width 480 --pupil 7 --component " + GetParam());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_complete("k.exr");
    const Image picture = read("k.png").image();
    EXPECT_EQ(picture.width(), 65);
    EXPECT_GT(largest(picture), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Each, PsfComponent,
                         testing::Values("all", "bloom", "corona", "halo", "streaks", "joint"),
                         [](const auto& test_case) { return test_case.param; });

// In the picture of a kernel the source is the brightest, and nothing is burnt out around it.
TEST_F(PsfFile, PictureIsLogarithmic) {
    ASSERT_EQ(run("psf -o k.png --size 129 --pupil 5").exit_code, 0);
    const Image picture = read("k.png").image();
    EXPECT_GT(picture.at(64, 64, 1), 0.9);
    EXPECT_GT(picture.at(64, 20, 1), 0.01);
    EXPECT_LT(picture.at(64, 20, 1), 0.6);
}

TEST_F(PsfFile, DependsOnTheEyeAndTheSeed) {
    const std::string command = "psf --size 33 --pupil 5 -o ";
    ASSERT_EQ(run(command + "a.exr").exit_code, 0);
    ASSERT_EQ(run(command + "b.exr --threads 1").exit_code, 0);
    ASSERT_EQ(run(command + "c.exr --seed 2").exit_code, 0);
    ASSERT_EQ(run(command + "d.exr --age 75").exit_code, 0);
    const Image a = read("a.exr").image();
    EXPECT_TRUE(identical(a, read("b.exr").image()));
    EXPECT_FALSE(identical(a, read("c.exr").image()));
    EXPECT_LT(sum_of(read("d.exr").image(), 1), sum_of(a, 1));  // older eyes scatter farther
}

// A cat's halo lies to both sides, where its slit uncovers the fibres.
TEST_F(PsfFile, OfASlitPupilSpreadsAcrossIt) {
    const std::string command =
        "psf --size 65 --width 480 --pupil 4 --component bloom --fov 10 -o k.exr ";
    const auto spread = [&](const std::string& options) {
        const nlohmann::json json = report(command + options);
        const Image image = read("k.exr").image();
        double across = 0;
        double along = 0;
        for (int y = 0; y < 65; ++y) {
            for (int x = 0; x < 65; ++x) {
                across += double{image.at(x, y, 1)} * std::abs(x - 32);
                along += double{image.at(x, y, 1)} * std::abs(y - 32);
            }
        }
        return std::pair(across / along, json["parameters"]);
    };
    EXPECT_NEAR(spread("").first, 1, 0.05);
    const auto [upright, parameters] = spread("--pupil-shape slit");
    EXPECT_GT(upright, 2);
    EXPECT_EQ(parameters["pupil_shape"], "slit");
    EXPECT_EQ(parameters["pupil_long_mm"], 9);
    EXPECT_LT(parameters["pupil_short_mm"], 3);
    EXPECT_NEAR(spread("--pupil-shape slit --pupil-rotation 90").first * upright, 1, 0.05);
    EXPECT_LT(spread("--pupil-shape ellipse:2").first, 0.8);
    for (const auto& [options, named] :
         std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"--pupil-shape blob", {"--pupil-shape", "blob", "slit"}},
             {"--pupil-shape ellipse:11", {"--pupil-shape", "11", "10"}},
             {"--pupil-shape ellipse", {"--pupil-shape", "ellipse", "number"}},
             {"--pupil-rotation 3", {"--pupil-rotation", "--pupil-shape"}}}) {
        const Outcome outcome = run("psf --size 9 -o bad.exr " + options);
        EXPECT_EQ(outcome.exit_code, 2) << options;
        EXPECT_TRUE(names_all(outcome.err, named)) << outcome.err;
        EXPECT_FALSE(exists("bad.exr"));
    }
}

// A kernel of full reach is the eye that glare would make by itself.
TEST_F(PsfFile, AppliedByGlareIsTheEyeItself) {
    for (const std::string& view : {std::string("--fov 60"), std::string("--fov 25")}) {
        ASSERT_EQ(run("scene bars --width 48 --height 27 -o in.exr").exit_code, 0);
        ASSERT_EQ(run("psf -o k.exr --size 95 --width 48 --pupil 5 " + view).exit_code, 0);
        ASSERT_EQ(run("glare in.exr -o eye.exr --pupil 5 " + view).exit_code, 0);
        ASSERT_EQ(run("glare in.exr -o file.exr --psf k.exr " + view).exit_code, 0);
        const Image eye = read("eye.exr").image();
        EXPECT_LT(largest_difference(eye, read("file.exr").image()), 1e-5 * largest(eye)) << view;
        EXPECT_GT(largest_difference(eye, read("in.exr").image()), 1e-2 * largest(eye)) << view;
    }
}

TEST_F(PsfFile, OfALampFollowsItsSpectrum) {
    const std::string command = "psf --size 65 --width 480 --pupil 7 --component halo -o ";
    ASSERT_EQ(run(command + "default.exr").exit_code, 0);
    ASSERT_EQ(run(command + "d65.exr --source-spectrum d65").exit_code, 0);
    EXPECT_TRUE(identical(read("default.exr").image(), read("d65.exr").image()));
    // How far the channels are apart, over the brightest pixel.
    const auto colourfulness = [&](const std::string& name) {
        const Image image = read(name).image();
        double apart = 0;
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            apart = std::max(apart, std::abs(double{image.plane(0)[i]} - image.plane(2)[i]));
        }
        return apart / largest(image);
    };
    for (const std::string lamp : {"mercury", "led"}) {
        const nlohmann::json json = report(command + "lamp.exr --source-spectrum " + lamp);
        EXPECT_EQ(json["parameters"]["source_spectrum"], lamp);
        EXPECT_GT(colourfulness("lamp.exr"), 0.1) << lamp;
    }
    ASSERT_EQ(run(command + "sodium.exr --source-spectrum sodium").exit_code, 0);
    expect_complete("sodium.exr");
    EXPECT_LT(colourfulness("sodium.exr"), 0.01);
}

TEST_F(PsfFile, SpectraAreKnownAndOfTheEye) {
    const Outcome unknown = run("psf -o k.exr --size 9 --source-spectrum neon");
    EXPECT_NE(unknown.exit_code, 0);
    EXPECT_TRUE(names_all(unknown.err, {"--source-spectrum", "neon", "sodium"}));
    const Outcome camera = run("psf -o k.exr --size 9 --observer camera --source-spectrum sodium");
    EXPECT_NE(camera.exit_code, 0);
    EXPECT_TRUE(names_all(camera.err, {"--source-spectrum", "eye"}));
    EXPECT_FALSE(exists("k.exr"));
}

TEST_F(PsfFile, OfEveryColourAtOnceIsRefused) {
    const Outcome outcome = run("psf -o k.exr --size 9 --source-spectrum rgb");
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_TRUE(names_all(outcome.err, {"--source-spectrum", "rgb", "aureole glare"}));
}

// White light is daylight, an orange one is not.
TEST_F(PsfFile, OfEveryColourAtOnceIsThatOfDaylightForWhite) {
    const std::string glare = "glare in.exr --fov 20 --pupil 7 --source-spectrum ";
    Image in(48, 27, 3);
    for (const bool white : {true, false}) {
        in.at(24, 13, 0) = 1e4F;
        in.at(24, 13, 1) = white ? 1e4F : 2e3F;
        in.at(24, 13, 2) = white ? 1e4F : 0;
        write("in.exr", in);
        ASSERT_EQ(run(glare + "d65 -o d65.exr").exit_code, 0);
        EXPECT_EQ(report(glare + "rgb -o rgb.exr")["parameters"]["source_spectrum"], "rgb");
        const Image by_color = read("rgb.exr").image();
        const Image daylight = read("d65.exr").image();
        double apart = 0;
        double light = 0;
        for (int c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < by_color.pixels(); ++i) {
                if (i == 13 * 48 + 24) continue;
                const double value = daylight.plane(c)[i];
                apart += std::abs(by_color.plane(c)[i] - value);
                light += value;
            }
        }
        if (white) {
            EXPECT_LT(apart, 2e-3 * light);
        } else {
            EXPECT_GT(apart, 1e-2 * light);
        }
    }
    for (const std::string option : {"--method sprites", "--surround same", "--field-varying on"}) {
        const Outcome outcome = run(glare + "rgb -o no.exr " + option);
        EXPECT_NE(outcome.exit_code, 0);
        EXPECT_TRUE(names_all(outcome.err, {"--source-spectrum rgb", option.substr(0, 8)}));
        EXPECT_FALSE(exists("no.exr"));
    }
}

// `aureole glare` sees lights of the same spectrum.
TEST_F(PsfFile, OfALampAppliedByGlareIsTheEyeItself) {
    const std::string eye = " --fov 10 --pupil 7 --source-spectrum sodium";
    ASSERT_EQ(run("scene point --width 48 --height 27 -o in.exr").exit_code, 0);
    ASSERT_EQ(run("psf -o k.exr --size 95 --width 48" + eye).exit_code, 0);
    ASSERT_EQ(run("glare in.exr -o eye.exr" + eye).exit_code, 0);
    ASSERT_EQ(run("glare in.exr -o file.exr --fov 10 --psf k.exr").exit_code, 0);
    ASSERT_EQ(run("glare in.exr -o white.exr --fov 10 --pupil 7").exit_code, 0);
    const Image sodium = read("eye.exr").image();
    EXPECT_LT(largest_difference(sodium, read("file.exr").image()), 1e-5 * largest(sodium));
    EXPECT_GT(largest_difference(sodium, read("white.exr").image()), 1e-4 * largest(sodium));
}

TEST_F(PsfFile, ForOtherPixelsIsRefused) {
    write("in.exr", noise(48, 27, 3));
    // At 1 deg the projections differ by less than a thousandth, and are still not the same.
    for (const auto& [made_for, used_for] :
         {std::pair("--fov 60", "--fov 50"), std::pair("--fov 60", "--fov 60 --perspective off"),
          std::pair("--fov 1 --perspective on", "--fov 1")}) {
        ASSERT_EQ(
            run(std::string("psf -o k.exr --size 9 --width 48 --pupil 5 ") + made_for).exit_code,
            0);
        const Outcome outcome = run(std::string("glare in.exr -o out.exr --psf k.exr ") + used_for);
        EXPECT_EQ(outcome.exit_code, 1) << used_for;
        EXPECT_TRUE(names_all(outcome.err, {"k.exr", "deg", "--fov"})) << used_for;
    }
    EXPECT_FALSE(exists("out.exr"));
}

TEST_F(PsfFile, AdaptationThatIsAssumedIsSaid) {
    EXPECT_TRUE(names_all(run("psf -o k.exr --size 9").err, {"note:", "10 cd/m2"}));
    EXPECT_EQ(run("psf -o k.exr --size 9 --adaptation 10").err, "");
}

}  // namespace
}  // namespace aureole::cli
