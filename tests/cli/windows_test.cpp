// Data and display windows, metadata, and the field of view they tell.
#include <gtest/gtest.h>

#include <string>

#include "program.h"

namespace aureole::cli {
namespace {

const io::Window kDisplay = {0, 0, 64, 48};
const io::Window kData = {-16, -12, 96, 72};

// A light beyond the upper left corner of the display window.
io::Picture overscan_picture() {
    io::Picture picture(point(kData.width, kData.height, 3, 8, 6, 1000));
    picture.set_data_origin(kData.x, kData.y);
    picture.set_display_window(kDisplay);
    return picture;
}

class Windows : public CliTest {
  protected:
    void SetUp() override { write("k.exr", soft_kernel(81)); }
};

TEST_F(Windows, AreBothKept) {
    write("in.exr", overscan_picture());
    ASSERT_EQ(run("glare in.exr -o out.exr --psf k.exr").exit_code, 0);
    EXPECT_EQ(read("out.exr").data_window(), kData);
    EXPECT_EQ(read("out.exr").display_window(), kDisplay);
}

// Light outside the display window makes glare inside it: as much as if all were displayed.
TEST_F(Windows, OverscanMakesGlare) {
    write("in.exr", overscan_picture());
    write("wide.exr", overscan_picture().image());
    ASSERT_EQ(run("glare in.exr -o out.exr --psf k.exr --perspective off").exit_code, 0);
    ASSERT_EQ(run("glare wide.exr -o wide-out.exr --psf k.exr --perspective off").exit_code, 0);
    const Image out = read("out.exr").image();
    EXPECT_GT(out.at(16 + 4, 12 + 4), 1e-4);
    EXPECT_TRUE(identical(out, read("wide-out.exr").image()));
}

// The axis of a perspective picture is the centre of the display window, wherever the data lie.
TEST_F(Windows, PerspectiveFollowsTheDisplayWindow) {
    const Image image = noise(32, 24, 3);
    write("whole.exr", image);
    io::Picture part(copy({image.row(0, 0) + 16, 16, 24, 3, 1, 32, 32 * 24}));  // right half
    part.set_data_origin(16, 0);
    part.set_display_window({0, 0, 32, 24});
    write("part.exr", part);
    Image cut = image;
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < 24; ++y) {
            for (int x = 0; x < 16; ++x) cut.at(x, y, c) = 0;
        }
    }
    write("cut.exr", cut);
    for (const char* name : {"part", "cut"}) {
        ASSERT_EQ(
            run(std::string("glare ") + name + ".exr -o " + name + "-out.exr --psf k.exr --fov 100")
                .exit_code,
            0);
    }
    const Image from_cut = read("cut-out.exr").image();
    const Image right = copy({from_cut.row(0, 0) + 16, 16, 24, 3, 1, 32, 32 * 24});
    EXPECT_LT(largest_difference(read("part-out.exr").image(), right), 1e-5 * largest(image));
}

// The eye is that of the picture as it is seen: overscan changes neither its field of view nor its
// adaptation.
TEST_F(Windows, OverscanDoesNotChangeTheEye) {
    io::Picture wide(constant(kData.width, kData.height, 3, 1));
    wide.set_data_origin(kData.x, kData.y);
    wide.set_display_window(kDisplay);
    for (int x = 0; x < kData.width; ++x) wide.image().at(x, 0, 1) = 1e6F;  // outside the display
    write("wide.exr", wide);
    write("seen.exr", constant(kDisplay.width, kDisplay.height, 3, 1));
    const std::string options = " -o out.exr --fov 30 --preset vivid --json";
    const auto a = report("glare wide.exr" + options)["parameters"];
    const auto b = report("glare seen.exr" + options)["parameters"];
    for (const char* key : {"fov_deg", "pitch_deg", "pupil_mm", "corona_contrast"}) {
        EXPECT_NEAR(a[key].get<double>(), b[key].get<double>(), 1e-9) << key;
    }
}

TEST_F(Windows, DisplayFilesShowTheDisplayWindow) {
    write("in.exr", overscan_picture());
    const Outcome outcome =
        run("glare in.exr -o out.png -o out.jpg -o out.tif -o out.hdr --side-by-side both.png "
            "--psf k.exr");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const char* name : {"out.png", "out.jpg", "out.tif", "out.hdr"}) {
        EXPECT_EQ(read(name).image().width(), kDisplay.width) << name;
        EXPECT_EQ(read(name).image().height(), kDisplay.height) << name;
    }
    EXPECT_EQ(read("both.png").image().width(), 2 * kDisplay.width + 4);
    EXPECT_EQ(read("both.png").image().height(), kDisplay.height);
}

// Every pixel of them is where it belongs.
TEST_F(Windows, DisplayFilesAreCutWithoutAShift) {
    io::Picture picture(point(kData.width, kData.height, 3, 16 + 10, 12 + 20, 1));
    picture.set_data_origin(kData.x, kData.y);
    picture.set_display_window(kDisplay);
    write("in.exr", picture);
    write("one.exr", constant(1, 1, 3, 1));
    ASSERT_EQ(run("glare in.exr -o out.png --side-by-side both.png --tone-map none --psf one.exr")
                  .exit_code,
              0);
    const Image out = read("out.png").image();
    EXPECT_EQ(out.at(10, 20), 1);
    EXPECT_EQ(out.at(26, 32), 0);
    const Image both = read("both.png").image();
    EXPECT_EQ(both.at(10, 20), 1);
    EXPECT_EQ(both.at(kDisplay.width + 4 + 10, 20), 1);
    EXPECT_EQ(both.at(26, 32), 0);
}

TEST_F(Windows, MetadataIsKept) {
    io::Picture picture(noise(16, 12, 3));
    picture.set_attribute("Copyright", std::string("a lighthouse"));
    picture.set_attribute("lamp:height_m", 23.5F);
    picture.set_pixel_aspect_ratio(2);
    write("in.exr", picture);
    ASSERT_EQ(run("glare in.exr -o out.exr --psf k.exr").exit_code, 0);
    const io::Picture out = read("out.exr");
    EXPECT_EQ(out.string_attribute("Copyright"), "a lighthouse");
    EXPECT_EQ(out.float_attribute("lamp:height_m"), 23.5F);
    EXPECT_EQ(out.pixel_aspect_ratio(), 2);
}

TEST_F(Windows, FieldOfViewComesFromTheOptionThenTheFileThenSixtyDegrees) {
    io::Picture picture(noise(16, 12, 3));
    write("plain.exr", picture);
    picture.set_attribute("aureole:fov_deg", 25.0F);
    write("known.exr", picture);
    const auto fov = [&](const std::string& words) {
        return report("glare " + words + " -o out.exr --psf k.exr")["parameters"]["fov_deg"]
            .get<double>();
    };
    EXPECT_NEAR(fov("known.exr --fov 80"), 80, 1e-6);
    EXPECT_NEAR(fov("known.exr"), 25, 1e-4);
    EXPECT_NEAR(fov("plain.exr"), 60, 1e-6);
    EXPECT_TRUE(
        names_all(run("glare plain.exr -o out.exr --psf k.exr").err, {"note:", "60", "--fov"}));
    EXPECT_EQ(run("glare known.exr -o out.exr --psf k.exr").err, "");
}

TEST_F(Windows, PerspectiveIsOnAboveFortyDegrees) {
    write("in.exr", noise(16, 12, 3));
    const auto on = [&](const std::string& words) {
        return report("glare in.exr -o out.exr --psf k.exr " + words)["parameters"]["perspective"]
            .get<bool>();
    };
    EXPECT_FALSE(on("--fov 40"));
    EXPECT_TRUE(on("--fov 41"));
    EXPECT_TRUE(on("--fov 20 --perspective on"));
    EXPECT_FALSE(on("--fov 90 --perspective off"));
    EXPECT_FALSE(on("--fov 360 --perspective off"));
}

TEST_F(Windows, FieldOfViewInTheFileThatCannotBeIsNamed) {
    io::Picture picture(noise(16, 12, 3));
    picture.set_attribute("aureole:fov_deg", 200.0F);
    write("in.exr", picture);
    const Outcome outcome = run("glare in.exr -o out.exr --psf k.exr");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(names_all(outcome.err, {"aureole:fov_deg", "200", "180", "--perspective off"}));
}

}  // namespace
}  // namespace aureole::cli
