// Lens flares: which lights make them, what they are worth, what artists change, and what is
// refused. `aureole flare`, and cameras in `aureole glare` and `aureole psf`.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "aureole/image/view.h"
#include "program.h"

namespace aureole::cli {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 64;
constexpr double kFovDeg = 30;
const std::string kLens = " --lens heliar --f-number 8 ";
// The same picture for both renderers, in a fraction of the time.
const std::string kFast = kLens + "--ghosts matrix ";

// Dim, with one light of 3x3 pixels.
Image lit_picture(int channels = 3) {
    Image image = constant(kWidth, kHeight, channels, 0.25F);
    for (int c = 0; c < channels; ++c) {
        for (int y = 19; y < 22; ++y) {
            for (int x = 69; x < 72; ++x) image.at(x, y, c) = 2e5F / static_cast<float>(1 + c);
        }
    }
    return image;
}

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

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
    return text;
}

class Flare : public CliTest {
  protected:
    void SetUp() override {
        io::Picture picture(lit_picture());
        picture.set_attribute("aureole:fov_deg", static_cast<float>(kFovDeg));
        write("in.exr", picture);
    }
    // Energy of the ghosts that a run adds.
    double ghosts(const std::string& words) const {
        return report("flare in.exr -o ghosts.exr" + words)["energy"]["ghosts"];
    }
};

using FlareReport = Flare;
using FlareLights = Flare;
using FlareView = Flare;
using FlareLooks = Flare;
using FlareFiles = Flare;
using FlareErrors = Flare;
using CameraGlare = Flare;

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
    EXPECT_NEAR(json["lights"][0]["x"].get<double>(), 70.5 - 16, 1e-3);
    EXPECT_NEAR(json["lights"][0]["y"].get<double>(), 20.5 - 10, 1e-3);
    ASSERT_EQ(
        run("flare in.exr -o wide.exr --only --fov " + std::to_string(wide_deg) + kFast).exit_code,
        0);
    const Image out = read("out.exr").image();
    EXPECT_GT(largest(out), 0);
    EXPECT_LT(largest_difference(out, read("wide.exr").image()), 1e-3 * largest(out));
    // Given positions count from the corner of the display window.
    const auto given = report("flare over.exr -o out.exr --fov 50 --light 54.5,10.5,1" + kFast);
    EXPECT_NEAR(given["lights"][0]["right_deg"].get<double>(),
                json["lights"][0]["right_deg"].get<double>(), 1e-3);
}

TEST_F(FlareLooks, BlogIsMatrixAndSameSide) {
    const auto json = report("flare in.exr -o out.exr --preset blog" + kLens);
    EXPECT_EQ(json["method"], "matrix");
    EXPECT_EQ(json["parameters"]["preset"], "blog");
    EXPECT_EQ(json["parameters"]["pairs"], "same-side");
    EXPECT_GT(json["energy"]["ghosts"].get<double>(), 0);
    EXPECT_LT(json["ghosts"]["count"].get<int>(),
              report("flare in.exr -o out.exr" + kFast)["ghosts"]["count"].get<int>());
}

TEST_F(FlareLooks, TintScales) {
    const double all = ghosts(kFast);
    EXPECT_NEAR(ghosts(" --tint 0.5" + kFast) / all, 0.5, 1e-4);
    ASSERT_EQ(run("flare in.exr -o red.exr --only --tint 1,0,0" + kFast).exit_code, 0);
    ASSERT_EQ(run("flare in.exr -o all.exr --only" + kFast).exit_code, 0);
    const Image red = read("red.exr").image();
    EXPECT_EQ(largest(red.view().channel_range(1, 2)), 0);
    EXPECT_GT(largest(red.view().channel_range(0, 1)), 0);
}

TEST_F(FlareLooks, DumpedAndReadBackChangeNothing) {
    ASSERT_EQ(run("flare in.exr -o a.exr --dump-ghosts g.toml" + kLens).exit_code, 0);
    const auto json = report("flare in.exr -o b.exr --ghosts-from g.toml" + kLens);
    EXPECT_TRUE(identical(read("a.exr").image(), read("b.exr").image()));
    const std::string text = bytes("g.toml");
    std::size_t count = 0;
    for (std::size_t at = text.find("[[ghost]]"); at != std::string::npos;
         at = text.find("[[ghost]]", at + 1)) {
        ++count;
    }
    EXPECT_EQ(json["ghosts"]["count"], count);
    EXPECT_TRUE(names_all(text, {"surfaces = [", "enabled = true", "gain = 1.0",
                                 "tint = [1.0, 1.0, 1.0]", "# ", "% of the energy"}));
}

// --dump-ghosts needs no picture to be written, and tells the settings in force.
TEST_F(FlareLooks, DumpAlone) {
    ASSERT_EQ(run("flare in.exr --dump-ghosts g.toml" + kFast).exit_code, 0);
    write_bytes("h.toml", replaced(bytes("g.toml"), "gain = 1.0", "gain = 0.25"));
    ASSERT_EQ(run("flare in.exr --ghosts-from h.toml --dump-ghosts i.toml" + kFast).exit_code, 0);
    EXPECT_TRUE(names_all(bytes("i.toml"), {"gain = 0.25"}));
    EXPECT_EQ(bytes("i.toml").find("gain = 1.0"), std::string::npos);
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"g.toml", "h.toml", "i.toml", "in.exr"}));
}

TEST_F(FlareLooks, EditedGhostsObey) {
    const double all = ghosts(" --dump-ghosts g.toml" + kFast);
    const std::string text = bytes("g.toml");
    const auto edited = [&](const std::string& from, const std::string& to) {
        write_bytes("e.toml", replaced(text, from, to));
        return ghosts(" --ghosts-from e.toml" + kFast);
    };
    EXPECT_NEAR(edited("gain = 1.0", "gain = 2.0") / all, 2, 1e-4);
    EXPECT_NEAR(edited("tint = [1.0, 1.0, 1.0]", "tint = [0.5, 0.5, 0.5]") / all, 0.5, 1e-4);
    EXPECT_EQ(edited("enabled = true", "enabled = false"), 0);
    // One ghost alone, by its name: the strongest is the first in the file.
    const std::string first = text.substr(text.find("[[ghost]]"));
    write_bytes("e.toml",
                replaced(first.substr(0, first.find("\n\n")), "enabled = true", "enabled = false"));
    const double without = ghosts(" --ghosts-from e.toml" + kFast);
    EXPECT_LT(without, all);
    EXPECT_GT(without, 0);
}

TEST_F(FlareErrors, OfGhostFilesNameFileEntryAndValue) {
    const std::string command = "flare in.exr -o out.exr --ghosts-from g.toml" + kFast;
    for (const auto& [text, words] :
         {std::pair<std::string, std::vector<std::string>>{"[[ghost]]\nsurfaces = [1, 99]\n",
                                                           {"g.toml", "ghost 1", "[1, 99]"}},
          {"[[ghost]]\nsurfaces = [1, 2]\ngain = -3\n", {"g.toml", "line 3", "gain = -3"}},
          {"[[ghost]\n", {"g.toml", "line 1", "TOML"}}}) {
        write_bytes("g.toml", text);
        const Outcome outcome = run(command);
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_TRUE(names_all(outcome.err, words));
    }
    EXPECT_FALSE(exists("out.exr"));
}

TEST_F(FlareErrors, OfFilesNameThem) {
    write("black.png", constant(8, 8, 1, 0));
    for (const auto& [words, file] :
         {std::pair("missing.exr -o out.exr", "missing.exr"),
          std::pair("in.exr -o no/out.exr", "no/out.exr"),
          std::pair("in.exr --dump-ghosts no/g.toml", "no/g.toml"),
          std::pair("in.exr -o out.exr --iris black.png", "black.png"),
          std::pair("in.exr -o out.exr --iris no.png", "no.png"),
          std::pair("in.exr -o out.exr --occluder no.png", "no.png"),
          std::pair("in.exr -o out.exr --matte no.png", "no.png"),
          std::pair("in.exr -o out.exr --ghosts-from no.toml", "no.toml"),
          std::pair("in.exr -o out.exr --ghost-texture no.png", "no.png")}) {
        const Outcome outcome = run(std::string("flare ") + words + kFast);
        EXPECT_EQ(outcome.exit_code, 1) << words;
        EXPECT_TRUE(names_all(outcome.err, {file})) << words;
    }
    EXPECT_FALSE(exists("out.exr"));
}

TEST_F(FlareErrors, OfUseEndWithTwo) {
    for (const auto& [words, message] :
         {std::pair<std::string, std::vector<std::string>>{"in.exr", {"--output", "--dump-ghosts"}},
          {"in.exr -o o.exr --only --output-layers both", {"--output-layers", "--only"}},
          {"in.exr -o o.exr --ghosts magic", {"--ghosts", "magic", "hybrid"}},
          {"in.exr -o o.exr --pairs some", {"--pairs", "some", "same-side"}},
          {"in.exr -o o.exr --preset vivid", {"--preset", "vivid", "blog"}},
          {"in.exr -o o.exr --preset blog --ghosts traced", {"--ghosts", "traced", "blog"}},
          {"in.exr -o o.exr --preset blog --pairs all", {"--pairs", "all", "blog"}},
          {"in.exr -o o.exr --ghosts matrix --rays 64", {"--rays", "64", "traced"}},
          {"in.exr -o o.exr --ghosts matrix --wavelengths 3", {"--wavelengths", "traced"}},
          {"in.exr -o o.exr --ghosts traced --hybrid-tolerance 0.1", {"--hybrid-tolerance"}},
          {"in.exr -o o.exr --rays 4", {"--rays", "4", "from 8"}},
          {"in.exr -o o.exr --wavelengths 65", {"--wavelengths", "65", "64"}},
          {"in.exr -o o.exr --strongest 0", {"--strongest", "0"}},
          {"in.exr -o o.exr --energy-dropped 1", {"--energy-dropped", "1"}},
          {"in.exr -o o.exr --hybrid-tolerance 0", {"--hybrid-tolerance", "0"}},
          {"in.exr -o o.exr --coarse-tolerance -1", {"--coarse-tolerance", "-1"}},
          {"in.exr -o o.exr --tint 1,2", {"--tint", "1,2", "R,G,B"}},
          {"in.exr -o o.exr --tint -1", {"--tint", "-1", "at least 0"}},
          {"in.exr -o o.exr --light 1,2", {"--light", "1,2", "RADIANCE"}},
          {"in.exr -o o.exr --light 1deg,2,3", {"--light", "1deg,2,3", "12deg,-3deg"}},
          {"in.exr -o o.exr --light 1,2,-3", {"--light", "1,2,-3", "at least 0"}},
          {"in.exr -o o.exr --light 1,2,3:4", {"--light", "1,2,3:4", "R:G:B"}},
          {"in.exr -o o.exr --light 1,2,3,90", {"--light", "1,2,3,90", "below 90"}},
          {"in.exr -o o.exr --light 1,2,nan", {"--light", "1,2,nan"}},
          {"in.exr -o o.exr --light 1,2,3 --max-lights 4", {"--max-lights", "--found-lights"}},
          {"in.exr -o o.exr --light-threshold 0", {"--light-threshold", "0", "above 0"}},
          {"in.exr -o o.exr --max-lights 0", {"--max-lights", "0", "from 1"}},
          {"in.exr -o o.exr --blades 2", {"--blades", "2", "3 to 64"}},
          {"in.exr -o o.exr --blades 65", {"--blades", "65", "64"}},
          {"in.exr -o o.exr --blade-curvature 2", {"--blade-curvature", "2", "to 1"}},
          {"in.exr -o o.exr --iris-smoothing 1", {"--iris-smoothing", "1", "0.5"}},
          {"in.exr -o o.exr --iris in.exr --blades 6", {"--iris", "--blades"}},
          {"in.exr -o o.exr --sensor 36", {"--sensor", "36", "36x24"}},
          {"in.exr -o o.exr --sensor 36x0", {"--sensor", "36x0", "above 0"}},
          {"in.exr -o o.exr --fov 0", {"--fov", "0", "above 0"}},
          {"in.exr in.exr -o . --dump-ghosts g.toml", {"in.exr"}},
          {"in.exr -o o.exr --age 30", {"--age"}}}) {
        const std::string lens = words.find("--ghosts") != std::string::npos ||
                                         words.find("--preset") != std::string::npos
                                     ? kLens
                                     : " --lens heliar ";
        const Outcome outcome = run("flare " + words + lens);
        EXPECT_EQ(outcome.exit_code, 2) << words;
        EXPECT_TRUE(names_all(outcome.err, message)) << words;
        EXPECT_EQ(outcome.err.rfind("aureole: ", 0), 0U) << outcome.err;
        EXPECT_EQ(folder_.names(), std::vector<std::string>{"in.exr"}) << words;
    }
}

TEST_F(FlareErrors, DumpIsOfOnePicture) {
    write("s.0001.exr", lit_picture());
    write("s.0002.exr", lit_picture());
    const Outcome outcome =
        run("flare s.%04d.exr -o o.%04d.exr --frames 1-2 --dump-ghosts g.toml" + kFast);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(names_all(outcome.err, {"--dump-ghosts", "g.toml", "2"}));
}

// One pass: the star of the iris, then the ghosts.
TEST_F(CameraGlare, IsFlareWithAStarburst) {
    ASSERT_EQ(run("flare in.exr -o flare.exr --starburst --blades 6" + kLens).exit_code, 0);
    const auto json = report("glare in.exr -o glare.exr --observer camera --blades 6" + kLens);
    EXPECT_TRUE(identical(read("flare.exr").image(), read("glare.exr").image()));
    EXPECT_EQ(json["method"], "fft");
    EXPECT_EQ(json["parameters"]["observer"], "camera");
    EXPECT_EQ(json["parameters"]["starburst"], true);
    EXPECT_GT(json["energy"]["ghosts"].get<double>(), 0);
    EXPECT_GT(json["energy"]["off_picture"].get<double>(), 0);
}

// The kernel that psf writes is the one that glare applies.
TEST_F(CameraGlare, AppliesTheKernelOfPsf) {
    const std::string camera = " --observer camera --blades 5" + kLens;
    const auto json = report("psf -o star.exr --width 96 --height 64 --size 191 --fov 30" + camera);
    double sum = 0;
    const Image kernel = read("star.exr").image();
    for (std::size_t i = 0; i < kernel.pixels(); ++i) sum += double{kernel.plane(1)[i]};
    EXPECT_NEAR(sum + json["energy"]["off_kernel"][1].get<double>(), 1, 1e-4);
    EXPECT_GT(kernel.at(95, 95, 1), kernel.at(95, 90, 1));
    ASSERT_EQ(run("glare in.exr -o a.exr --tint 0" + camera).exit_code, 0);
    ASSERT_EQ(run("glare in.exr -o b.exr --psf star.exr").exit_code, 0);
    const Image a = read("a.exr").image();
    EXPECT_LT(largest_difference(a, read("b.exr").image()), 1e-5 * largest(a));
}

TEST_F(CameraGlare, HasADefaultLensAndSaysSo) {
    const Outcome outcome = run("glare in.exr -o out.exr --observer camera");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(names_all(outcome.err, {"note", "heliar", "--lens"}));
}

TEST_F(CameraGlare, OptionsOfTheOtherObserverAreRefused) {
    for (const auto& [words, message] :
         {std::pair<std::string, std::vector<std::string>>{
              "glare in.exr --observer camera --age 30", {"--age", "--observer camera"}},
          {"glare in.exr --observer camera --preset vivid", {"--preset", "vivid"}},
          {"glare in.exr --observer camera --psf k.exr", {"--psf", "--observer camera"}},
          {"glare in.exr --observer camera --white-luminance 9", {"--white-luminance"}},
          {"glare in.exr --observer camera --preset blog --ghosts hybrid", {"--ghosts", "blog"}},
          {"glare in.exr --lens biotar", {"--lens", "--observer camera"}},
          {"glare in.exr --f-number 4", {"--f-number", "--observer camera"}},
          {"glare in.exr --blades 5", {"--blades", "--observer camera"}},
          {"glare in.exr --light 1,2,3", {"--light", "--observer camera"}},
          {"glare in.exr --ghosts matrix", {"--ghosts", "--observer camera"}},
          {"glare in.exr --tint 2", {"--tint", "--observer camera"}},
          {"glare in.exr --preset blog", {"--preset", "blog", "camera"}},
          {"psf --observer camera --pupil 4", {"--pupil", "--observer camera"}},
          {"psf --observer camera --component halo", {"--component", "--observer camera"}},
          {"psf --sensor 36x24", {"--sensor", "--observer camera"}}}) {
        const Outcome outcome = run(words + " -o out.exr");
        EXPECT_EQ(outcome.exit_code, 2) << words;
        EXPECT_TRUE(names_all(outcome.err, message)) << words;
    }
    EXPECT_FALSE(exists("out.exr"));
}

}  // namespace
}  // namespace aureole::cli
