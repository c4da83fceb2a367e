// --supersampling: pictures with several samples for each pixel of the result.
#include <gtest/gtest.h>

#include <string>

#include "aureole/image/resample.h"
#include "program.h"

namespace aureole::cli {
namespace {

using Supersampling = CliTest;

TEST_F(Supersampling, IsTheMeanBeforeAnythingElse) {
    const Image large = noise(48, 36, 3);
    write("large.exr", large);
    write("small.exr", area_average(large, 3));
    const std::string options = " --fov 40 --pupil 5 --threshold 1" + kPlainEye;
    const auto json = report("glare large.exr -o a.exr --supersampling 3" + options);
    EXPECT_EQ(json["parameters"]["supersampling"], 3);
    EXPECT_EQ(json["parameters"]["width"], 16);
    ASSERT_EQ(run("glare small.exr -o b.exr" + options).exit_code, 0);
    EXPECT_TRUE(identical(read("a.exr").image(), read("b.exr").image()));
    ASSERT_EQ(run("flare large.exr -o c.exr --lens heliar --fov 20 --supersampling 2").exit_code,
              0);
    EXPECT_EQ(read("c.exr").image().width(), 24);
}

TEST_F(Supersampling, IsOfTheMatteToo) {
    const Image large = noise(24, 16, 3);
    Image matte = constant(24, 16, 1, 0);
    for (int y = 0; y < 16; ++y) matte.at(7, y) = 1;
    write("large.exr", large);
    write("matte.exr", matte);
    write("small.exr", area_average(large, 2));
    write("small-matte.exr", area_average(matte, 2));
    const std::string options = " --fov 40 --pupil 5" + kPlainEye;
    ASSERT_EQ(
        run("glare large.exr -o a.exr --supersampling 2 --matte matte.exr" + options).exit_code, 0);
    ASSERT_EQ(run("glare small.exr -o b.exr --matte small-matte.exr" + options).exit_code, 0);
    EXPECT_TRUE(identical(read("a.exr").image(), read("b.exr").image()));
    const Outcome other = run("glare large.exr -o c.exr --supersampling 2 --matte small-matte.exr");
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_TRUE(names_all(other.err, {"small-matte.exr", "12x8", "24x16"}));
}

TEST_F(Supersampling, ShrinksBothWindowsAndKeepsOtherChannels) {
    io::Picture picture(noise(24, 16, 5), {"R", "G", "B", "A", "Z"});
    picture.set_data_origin(-4, 2);
    picture.set_display_window({0, 0, 16, 12});
    picture.set_attribute("aureole:fov_deg", 40.0F);
    write("in.exr", picture);
    ASSERT_EQ(run("glare in.exr -o out.exr --supersampling 2 --pupil 5" + kPlainEye).exit_code, 0);
    const io::Picture out = read("out.exr");
    EXPECT_EQ(out.data_window(), (io::Window{-2, 1, 12, 8}));
    EXPECT_EQ(out.display_window(), (io::Window{0, 0, 8, 6}));
    EXPECT_TRUE(identical(channel(out, "A"), area_average(channel(read("in.exr"), "A"), 2)));
    EXPECT_EQ(channel(out, "Z").at(2, 3), channel(read("in.exr"), "Z").at(5, 7));
}

TEST_F(Supersampling, OfPicturesThatDoNotDivideIsRefused) {
    write("in.exr", noise(25, 16, 3));
    const Outcome outcome = run("glare in.exr -o out.exr --supersampling 2");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(names_all(outcome.err, {"in.exr", "supersampling", "2", "25x16"}));
    EXPECT_FALSE(exists("out.exr"));
    const Outcome zero = run("glare in.exr -o out.exr --supersampling 0");
    EXPECT_EQ(zero.exit_code, 2);
    EXPECT_TRUE(names_all(zero.err, {"--supersampling", "0", "1 to 16"}));
}

}  // namespace
}  // namespace aureole::cli
