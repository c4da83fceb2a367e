// What happens to the channels, values and parts of a picture that are not light, or no numbers.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "aureole/image/finite.h"
#include "program.h"

namespace aureole::cli {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class Channels : public CliTest {
  protected:
    void SetUp() override {
        write("k.exr", soft_kernel(9));
        write("one.exr", constant(1, 1, 3, 1));
    }
    io::Picture glare_of(const std::string& name) const {
        const Outcome outcome = run("glare " + name + " -o out.exr --psf k.exr --quiet");
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return read("out.exr");
    }
};

TEST_F(Channels, GreyStaysGrey) {
    write("in.exr", point(16, 12, 1, 5, 5, 100), {"Y"});
    const io::Picture out = glare_of("in.exr");
    EXPECT_EQ(out.channel_names(), std::vector<std::string>{"Y"});
    EXPECT_GT(out.image().at(6, 5), 0);
    EXPECT_LT(out.image().at(5, 5), 100);
    ASSERT_EQ(run("glare in.exr -o out.png --psf k.exr").exit_code, 0);
    EXPECT_EQ(read("out.png").image().channels(), 1);
}

// The luminance of the kernel is what a grey picture sees.
TEST_F(Channels, GreyIsTheColourPictureOfEqualChannels) {
    write("grey.exr", noise(16, 12, 1), {"Y"});
    Image rgb(16, 12, 3);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < 12; ++y) {
            for (int x = 0; x < 16; ++x) rgb.at(x, y, c) = noise(16, 12, 1).at(x, y);
        }
    }
    write("rgb.exr", rgb);
    const Image grey = channel(glare_of("grey.exr"), "Y");
    EXPECT_LT(largest_difference(grey, channel(glare_of("rgb.exr"), "G")), 1e-5 * largest(grey));
}

TEST_F(Channels, AlphaIsNotChanged) {
    const Image grey = noise(16, 12, 2);
    write("grey.exr", grey, {"Y", "A"});
    const io::Picture grey_out = glare_of("grey.exr");
    EXPECT_EQ(grey_out.image().channels(), 2);
    EXPECT_TRUE(identical(channel(grey_out, "A"), copy(grey.view().channel_range(1, 1))));

    const Image rgba = noise(16, 12, 4);
    write("rgba.exr", rgba, {"R", "G", "B", "A"});
    const io::Picture out = glare_of("rgba.exr");
    EXPECT_EQ(out.image().channels(), 4);
    EXPECT_TRUE(identical(channel(out, "A"), copy(rgba.view().channel_range(3, 1))));
    EXPECT_FALSE(identical(channel(out, "R"), copy(rgba.view().channel_range(0, 1))));
}

// Also where they are infinite or no numbers: depth has the right to be.
TEST_F(Channels, OthersAreCarriedThrough) {
    Image image = noise(16, 12, 5);
    image.at(3, 3, 3) = kInfinity;
    image.at(4, 3, 4) = kNan;
    write("in.exr", image, {"R", "G", "B", "Z", "velocity.x"});
    const io::Picture out = glare_of("in.exr");
    EXPECT_EQ(out.image().channels(), 5);
    EXPECT_TRUE(identical(channel(out, "Z"), copy(image.view().channel_range(3, 1))));
    EXPECT_TRUE(identical(channel(out, "velocity.x"), copy(image.view().channel_range(4, 1))));
    EXPECT_FALSE(identical(channel(out, "B"), copy(image.view().channel_range(2, 1))));
}

// Five channels of which none is called a colour: the first is taken as grey.
TEST_F(Channels, OfArbitraryNamesKeepThem) {
    const std::vector<std::string> names = {"ash", "birch", "cedar", "fir", "oak"};
    const Image image = noise(16, 12, 5);
    write("in.exr", image, names);
    const io::Picture out = glare_of("in.exr");
    EXPECT_EQ(out.channel_names(), names);
    EXPECT_FALSE(identical(channel(out, "ash"), copy(image.view().channel_range(0, 1))));
    for (int c = 1; c < 5; ++c) {
        EXPECT_TRUE(identical(channel(out, names[static_cast<std::size_t>(c)]),
                              copy(image.view().channel_range(c, 1))));
    }
}

TEST_F(Channels, NonfiniteValuesAreReplacedCountedAndReported) {
    Image image = constant(16, 12, 3, 1);
    image.at(2, 2, 0) = kNan;
    image.at(2, 2, 1) = kInfinity;  // the same pixel counts once
    image.at(7, 3, 2) = -kInfinity;
    write("in.exr", image);
    const Outcome outcome = run("glare in.exr -o out.exr --psf k.exr --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["nonfinite_pixels"], 2);
    EXPECT_TRUE(names_all(outcome.err, {"in.exr", "2 pixels"}));
    Image clean = image;
    replace_nonfinite(clean);
    write("clean.exr", clean);
    EXPECT_TRUE(identical(read("out.exr").image(), glare_of("clean.exr").image()));
}

TEST_F(Channels, NegativeValuesAreKept) {
    const Image image = noise(16, 12, 3);
    write("in.exr", image);
    ASSERT_EQ(run("glare in.exr -o direct.exr --psf one.exr --method direct").exit_code, 0);
    EXPECT_TRUE(identical(read("direct.exr").image(), image));
    ASSERT_EQ(run("glare in.exr -o fft.exr --psf one.exr --method fft").exit_code, 0);
    EXPECT_LT(largest_difference(read("fft.exr").image(), image), 1e-6 * largest(image));
}

TEST_F(Channels, PicturesOfOnePixelWork) {
    write("in.exr", constant(1, 1, 3, 7));
    EXPECT_NEAR(glare_of("in.exr").image().at(0, 0), 7 * soft_kernel(9).at(4, 4), 1e-4);
}

TEST_F(Channels, HalfDepthRoundsTheColourOnly) {
    const Image image = noise(16, 12, 4);
    write("in.exr", image, {"R", "G", "B", "Z"});
    const io::Picture full = glare_of("in.exr");
    ASSERT_EQ(run("glare in.exr -o half.exr --psf k.exr --depth half").exit_code, 0);
    const io::Picture half = read("half.exr");
    const auto input = OIIO::ImageInput::open(file("half.exr"));
    ASSERT_TRUE(input);
    EXPECT_EQ(input->spec().channelformat(0), OIIO::TypeDesc(OIIO::TypeDesc::HALF));
    EXPECT_TRUE(identical(channel(half, "Z"), channel(full, "Z")));
    for (int y = 0; y < 12; ++y) {
        for (int x = 0; x < 16; ++x) {
            const float value = full.image().at(x, y);
            EXPECT_NEAR(half.image().at(x, y), value, std::abs(value) / 2047);
        }
    }
}

TEST_F(Channels, OtherPartsAreCarriedThrough) {
    const std::vector<float> pixels(16UL * 12 * 3, 3.5F);
    std::vector<OIIO::ImageSpec> specs(2, OIIO::ImageSpec(16, 12, 3, OIIO::TypeDesc::FLOAT));
    specs[0].attribute("oiio:subimagename", "left");
    specs[1].attribute("oiio:subimagename", "right");
    const auto output = OIIO::ImageOutput::create("in.exr");
    ASSERT_TRUE(output->open(file("in.exr"), 2, specs.data()));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
    ASSERT_TRUE(output->open(file("in.exr"), specs[1], OIIO::ImageOutput::AppendSubimage));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
    ASSERT_TRUE(output->close());

    EXPECT_LT(glare_of("in.exr").image().at(0, 0), 3.5F);  // some of its light left the picture
    const auto input = OIIO::ImageInput::open(file("out.exr"));
    ASSERT_TRUE(input);
    ASSERT_TRUE(input->seek_subimage(1, 0));
    EXPECT_EQ(input->spec().get_string_attribute("oiio:subimagename"), "right");
    std::vector<float> right(pixels.size());
    ASSERT_TRUE(input->read_image(1, 0, 0, 3, OIIO::TypeDesc::FLOAT, right.data()));
    EXPECT_EQ(right, pixels);
}

}  // namespace
}  // namespace aureole::cli
