// Which lights make flares, what they are worth, and how the picture is seen.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "aureole/image/view.h"
#include "flare_pictures.h"

namespace aureole::cli {
namespace {

using FlareReport = Flare;
using FlareFiles = Flare;
using FlareLights = Flare;
using FlareView = Flare;

// Sum over pixels and colours, as --json counts it: by solid angle only above 40 deg.
double plain_sum(const Image& image) {
    double sum = 0;
    for (int c = 0; c < image.channels(); ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) sum += double{image.plane(c)[i]};
    }
    return sum;
}

Image sum_of(const Image& a, const Image& b) {
    Image sum = a;
    for (int c = 0; c < a.channels(); ++c) {
        for (std::size_t i = 0; i < a.pixels(); ++i) sum.plane(c)[i] += b.plane(c)[i];
    }
    return sum;
}

TEST_F(FlareReport, HasTheDocumentedKeys) {
    const auto json = report("flare in.exr -o out.exr" + kLens);
    for (const char* stage : {"read", "psf", "plan", "apply", "lights", "ghosts", "write"}) {
        EXPECT_GE(json["seconds"][stage].get<double>(), 0) << stage;
    }
    for (const char* key : {"in", "out", "off_picture", "ghosts"}) {
        EXPECT_TRUE(json["energy"][key].is_number()) << key;
    }
    EXPECT_EQ(json["method"], "hybrid");
    EXPECT_EQ(json["nonfinite_pixels"], 0);
    EXPECT_EQ(json["outputs"], nlohmann::json::array({"out.exr"}));
    EXPECT_EQ(json["lights"].size(), 1U);
    int drawn = 0;
    for (const char* how : {"matrix", "traced", "dropped", "disabled", "blocked"}) {
        drawn += json["ghosts"][how].get<int>();
    }
    EXPECT_EQ(json["ghosts"]["count"], drawn);
    EXPECT_GE(drawn, 20);
    EXPECT_LE(json["ghosts"]["energy_dropped"].get<double>(), 1e-3);
    for (const char* key : {"lens",
                            "f_number",
                            "efl_mm",
                            "sensor_mm",
                            "blades",
                            "blade_curvature",
                            "iris_rotation_deg",
                            "iris_smoothing",
                            "lens_fov_deg",
                            "starburst",
                            "preset",
                            "ghosts",
                            "pairs",
                            "wavelengths",
                            "rays",
                            "energy_dropped",
                            "strongest",
                            "hybrid_tolerance",
                            "coarse_tolerance",
                            "tint",
                            "given_lights",
                            "found_lights",
                            "max_lights",
                            "light_threshold",
                            "fov_deg",
                            "perspective",
                            "output_layers",
                            "depth",
                            "tone_map"}) {
        EXPECT_TRUE(json["parameters"].contains(key)) << key;
    }
    EXPECT_EQ(json["parameters"]["f_number"], 8);
}

// The only light that is added is that of the ghosts; sums over the files agree with the report.
TEST_F(FlareReport, AccountsForAllLight) {
    const auto energy = report("flare in.exr -o out.exr" + kLens)["energy"];
    const double in = energy["in"];
    const double added = energy["ghosts"];
    EXPECT_GT(added, 1e-4 * in);
    EXPECT_LT(added, 0.1 * in);
    EXPECT_NEAR((in + added) / energy["out"].get<double>(), 1, 1e-12);
    EXPECT_EQ(energy["off_picture"], 0);
    EXPECT_NEAR(plain_sum(read("in.exr").image()) / in, 1, 1e-6);
    ASSERT_EQ(run("flare in.exr -o only.exr --only" + kLens).exit_code, 0);
    EXPECT_NEAR(plain_sum(read("only.exr").image()) / added, 1, 1e-6);
}

TEST_F(FlareReport, AccountsForTheStarburst) {
    const auto energy = report("flare in.exr -o out.exr --starburst" + kFast)["energy"];
    const double in = energy["in"];
    EXPECT_GT(energy["off_picture"].get<double>(), 0);
    const double sum = energy["out"].get<double>() + energy["off_picture"].get<double>();
    EXPECT_NEAR((in + energy["ghosts"].get<double>()) / sum, 1, 1e-5);
}

TEST_F(FlareFiles, OnlyAndTheInputMakeTheComposite) {
    for (const std::string& options : {kFast, kFast + "--starburst "}) {
        ASSERT_EQ(run("flare in.exr -o out.exr" + options).exit_code, 0);
        ASSERT_EQ(run("flare in.exr -o only.exr --only" + options).exit_code, 0);
        ASSERT_EQ(run("flare in.exr -o both.exr --output-layers both" + options).exit_code, 0);
        const Image only = read("only.exr").image();
        const Image out = read("out.exr").image();
        EXPECT_GT(largest(only), 1e-4);
        // One rounding of a float at the light itself.
        EXPECT_LT(largest_difference(sum_of(only, read("in.exr").image()), out), 0.02);
        EXPECT_EQ(channel(read("both.exr"), "glare.G").at(5, 7), only.at(5, 7, 1));
        EXPECT_EQ(channel(read("both.exr"), "G").at(5, 7), out.at(5, 7, 1));
    }
}

TEST_F(FlareFiles, GreyStaysGrey) {
    write("grey.exr", constant(kWidth, kHeight, 1, 0));
    write("black.exr", constant(kWidth, kHeight, 3, 0));
    const std::string light = " --fov 30 --light 70,20,2e5 --only" + kFast;
    ASSERT_EQ(run("flare grey.exr -o grey-out.exr" + light).exit_code, 0);
    ASSERT_EQ(run("flare black.exr -o out.exr" + light).exit_code, 0);
    const Image grey = read("grey-out.exr").image();
    const Image out = read("out.exr").image();
    ASSERT_EQ(grey.channels(), 1);
    EXPECT_GT(largest(grey), 0);
    for (int x = 0; x < kWidth; ++x) {
        const double luminance =
            0.2126 * out.at(x, 40, 0) + 0.7152 * out.at(x, 40, 1) + 0.0722 * out.at(x, 40, 2);
        EXPECT_NEAR(grey.at(x, 40), luminance, 1e-6 * largest(grey));
    }
}

TEST_F(FlareFiles, SequencesAreTheirFrames) {
    write("s.0001.exr", lit_picture());
    Image second = lit_picture();
    second.at(20, 50, 0) = 1e6F;
    write("s.0002.exr", second);
    const std::string options = " --fov 30" + kFast;
    ASSERT_EQ(run("flare s.%04d.exr -o o.%04d.exr --frames 1-2" + options).exit_code, 0);
    ASSERT_EQ(run("flare s.0002.exr -o single.exr" + options).exit_code, 0);
    EXPECT_TRUE(identical(read("o.0002.exr").image(), read("single.exr").image()));
    EXPECT_GT(largest_difference(read("o.0001.exr").image(), read("o.0002.exr").image()), 1e5);
}

// What an eye never sees: NaN goes in, is counted, and does not come out.
TEST_F(FlareFiles, NanNeitherFlaresNorSpreads) {
    Image image = lit_picture();
    image.at(3, 4, 1) = std::nanf("");
    image.at(70, 20, 0) = HUGE_VALF;
    write("nan.exr", image);
    const auto json = report("flare nan.exr -o out.exr --fov 30 --starburst" + kLens);
    EXPECT_EQ(json["nonfinite_pixels"], 2);
    const Image out = read("out.exr").image();
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < out.pixels(); ++i) {
            ASSERT_TRUE(std::isfinite(out.plane(c)[i])) << c << " " << i;
        }
    }
}

TEST_F(FlareFiles, DisplayFilesAndSideBySide) {
    const Outcome outcome =
        run("flare in.exr -o out.png --side-by-side both.jpg --tone-map aces" + kFast);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(read("out.png").image().width(), kWidth);
    EXPECT_EQ(read("both.jpg").image().width(), 2 * kWidth + 4);
}

TEST_F(FlareLights, OfThePictureAreWhereTheyAre) {
    const auto lights = report("flare in.exr -o out.exr" + kFast)["lights"];
    ASSERT_EQ(lights.size(), 1U);
    EXPECT_NEAR(lights[0]["x"].get<double>(), 70.5, 1e-3);
    EXPECT_NEAR(lights[0]["y"].get<double>(), 20.5, 1e-3);
    EXPECT_EQ(lights[0]["found"], true);
    // The light's solid angle times its radiance is that of its pixels.
    const View view = View::from_fov(kWidth, kHeight, kFovDeg, Projection::kConstantPitch);
    const double green =
        lights[0]["radiance"][1].get<double>() * lights[0]["solid_angle_sr"].get<double>();
    EXPECT_NEAR(green / (9 * 1e5 * std::pow(1 / view.focal_length_px(), 2)), 1, 1e-4);
}

// A light given as the picture has it makes the flare of the picture's.
TEST_F(FlareLights, PixelsAndAnglesMeanTheSame) {
    const View view = View::from_fov(kWidth, kHeight, kFovDeg, Projection::kConstantPitch);
    const double pitch = view.pitch_deg;
    // In a view of equal angles: right and up of a direction at distance r along the diagonal.
    const double dx = 22.5 * pitch;
    const auto json = report("flare in.exr -o a.exr --only --light 70.5,32,1e6" + kFast);
    EXPECT_NEAR(json["lights"][0]["right_deg"].get<double>(), dx, 1e-9);
    EXPECT_NEAR(json["lights"][0]["up_deg"].get<double>(), 0, 1e-9);
    EXPECT_EQ(json["lights"][0]["found"], false);
    ASSERT_EQ(run("flare in.exr -o b.exr --only --light " + std::to_string(dx) +
                  "deg,0deg,1e6:1e6:1e6" + kFast)
                  .exit_code,
              0);
    const Image a = read("a.exr").image();
    EXPECT_LT(largest_difference(a, read("b.exr").image()), 1e-3 * largest(a));
}

TEST_F(FlareLights, GivenReplaceThoseFoundUnlessAskedFor) {
    const std::string light = " --light 20,32,1e5" + kFast;
    const auto given = report("flare in.exr -o out.exr" + light);
    EXPECT_EQ(given["lights"].size(), 1U);
    const auto both = report("flare in.exr -o out.exr --found-lights" + light);
    EXPECT_EQ(both["lights"].size(), 2U);
    EXPECT_GT(both["energy"]["ghosts"], given["energy"]["ghosts"]);
    const auto two = report("flare in.exr -o out.exr --light 30,20,2:1:0.5,0.53" + light);
    ASSERT_EQ(two["lights"].size(), 2U);
    EXPECT_EQ(two["lights"][0]["radiance"], nlohmann::json::array({2, 1, 0.5}));
    const double radius_rad = 0.53 / 2 * std::numbers::pi / 180;
    EXPECT_NEAR(two["lights"][0]["solid_angle_sr"].get<double>(),
                std::numbers::pi * radius_rad * radius_rad, 1e-3 * radius_rad * radius_rad);
}

// Energy grows with the light, and nothing else.
TEST_F(FlareLights, AreLinear) {
    const double one = ghosts(" --light 20,32,1e5" + kFast);
    EXPECT_NEAR(ghosts(" --light 20,32,3e5" + kFast) / one, 3, 1e-4);
}

TEST_F(FlareLights, OffTheFrameFlareToo) {
    const auto json = report("flare in.exr -o out.exr --light -8,20.5,1e6" + kFast);
    EXPECT_NEAR(json["lights"][0]["x"].get<double>(), -8, 1e-6);
    EXPECT_GT(json["energy"]["ghosts"].get<double>(), 0);
}

TEST_F(FlareLights, BeyondTheLensAddNothingAndAreTold) {
    const Outcome outcome = run("flare in.exr -o out.exr --light 85deg,0deg,1e6" + kFast);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(names_all(outcome.err, {"note", "light"}));
    EXPECT_TRUE(identical(read("out.exr").image(), read("in.exr").image()));
}

TEST_F(FlareLights, BehindTheCameraAreAnError) {
    for (const char* light : {"90deg,0deg,1", "0deg,-120deg,1"}) {
        const Outcome outcome =
            run(std::string("flare in.exr -o out.exr --light ") + light + kFast);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_TRUE(names_all(outcome.err, {"--light", light, "behind the camera"}));
    }
    EXPECT_FALSE(exists("out.exr"));
}

TEST_F(FlareLights, NothingFoundSaysTheThreshold) {
    write("dim.exr", constant(kWidth, kHeight, 3, 0.5F));
    const Outcome outcome = run("flare dim.exr -o out.exr --fov 30 --light-threshold 7.5" + kFast);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(names_all(outcome.err, {"note", "7.5", "--light-threshold"}));
    EXPECT_TRUE(identical(read("out.exr").image(), read("dim.exr").image()));
}

TEST_F(FlareLights, UnderAMatteAreNoLights) {
    write("mask.exr", constant(kWidth, kHeight, 1, 0));
    EXPECT_EQ(ghosts(" --matte mask.exr" + kFast), 0);
    write("mask.exr", constant(kWidth, kHeight, 1, 1));
    EXPECT_EQ(ghosts(" --matte mask.exr" + kFast), ghosts(kFast));
}

TEST_F(FlareView, OfAPictureThatSaysNothingIsTheLens) {
    write("plain.exr", lit_picture());
    const Outcome outcome = run("flare plain.exr -o out.exr" + kFast);
    EXPECT_TRUE(names_all(outcome.err, {"note", "field of view", "--fov"}));
    const auto parameters = report("flare plain.exr -o out.exr" + kFast)["parameters"];
    const double efl_mm = parameters["efl_mm"];
    const auto field_deg = [&](double width_mm) {
        return 2 * std::atan(width_mm / 2 / efl_mm) * 180 / std::numbers::pi;
    };
    EXPECT_NEAR(parameters["fov_deg"].get<double>(), field_deg(36), 1e-6);
    const auto small = report("flare plain.exr -o out.exr --sensor 18x12" + kFast)["parameters"];
    EXPECT_NEAR(small["fov_deg"].get<double>(), field_deg(18), 1e-6);
    // Upright: the sensor is turned. Wide: only a strip of it is used. Square: its height.
    for (const auto& [width, height, used_mm] :
         {std::tuple(64, 96, 24.0), std::tuple(96, 32, 36.0), std::tuple(64, 64, 24.0)}) {
        write("other.exr", constant(width, height, 3, 1));
        const auto other = report("flare other.exr -o out.exr" + kFast)["parameters"];
        EXPECT_NEAR(other["fov_deg"].get<double>(), field_deg(used_mm), 1e-6) << width;
    }
}

TEST_F(FlareView, DisagreementIsTold) {
    const Outcome other = run("flare in.exr -o out.exr" + kFast);
    EXPECT_TRUE(names_all(other.err, {"note", "30 deg", "aureole:fov_deg", "20.5", "mm"}));
    const auto given = report("flare in.exr -o out.exr --fov 25" + kFast)["parameters"];
    EXPECT_NEAR(given["fov_deg"].get<double>(), 25, 1e-6);
    const double lens_deg = given["lens_fov_deg"];
    const Outcome same =
        run("flare in.exr -o out.exr --fov " + std::to_string(1.01 * lens_deg) + kFast);
    EXPECT_EQ(same.err, "");
    const Outcome differs =
        run("flare in.exr -o out.exr --fov " + std::to_string(1.03 * lens_deg) + kFast);
    EXPECT_TRUE(names_all(differs.err, {"note", "--fov", "20.5", "21.1"}));
}

// All of the data window makes ghosts, around the centre of the display window.
TEST_F(FlareView, OverscanFlares) {
    const io::Window display = {0, 0, 64, 44};
    io::Picture over(lit_picture());
    over.set_data_origin(-16, -10);
    over.set_display_window(display);
    write("over.exr", over);
    // The same pixels as a picture of their own, with the field that this makes.
    const double half = std::tan(25 * std::numbers::pi / 180);
    const double wide_deg = 2 * std::atan(half * 96 / 64) * 180 / std::numbers::pi;
    const auto json = report("flare over.exr -o out.exr --only --fov 50" + kFast);
    // The centre of its energy: the solid angle of pixels varies over the light.
    EXPECT_NEAR(json["lights"][0]["x"].get<double>(), 70.5 - 16, 0.02);
    EXPECT_NEAR(json["lights"][0]["y"].get<double>(), 20.5 - 10, 0.02);
    ASSERT_EQ(
        run("flare in.exr -o wide.exr --only --fov " + std::to_string(wide_deg) + kFast).exit_code,
        0);
    const Image out = read("out.exr").image();
    EXPECT_GT(largest(out), 0);
    EXPECT_LT(largest_difference(out, read("wide.exr").image()), 1e-3 * largest(out));
    // Given positions count from the corner of the display window.
    const auto given = report("flare over.exr -o out.exr --fov 50 --light 54.5,10.5,1" + kFast);
    EXPECT_NEAR(given["lights"][0]["right_deg"].get<double>(),
                json["lights"][0]["right_deg"].get<double>(), 0.02);
}

}  // namespace
}  // namespace aureole::cli
