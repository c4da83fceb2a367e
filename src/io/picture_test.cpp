#include "aureole/io/picture.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/io/field_of_view.h"
#include "io/test_support.h"

namespace aureole::io {
namespace {

struct NamesCase {
    std::vector<std::string> names;
    std::vector<int> color;
    int alpha;
};

TEST(FindColorChannels, KnowsOrdersCasesAndLayers) {
    const std::vector<NamesCase> cases = {
        {{"R", "G", "B"}, {0, 1, 2}, -1},
        {{"A", "B", "G", "R", "Z"}, {3, 2, 1}, 0},
        {{"red", "GREEN", "Blue", "alpha"}, {0, 1, 2}, 3},
        {{"Y"}, {0}, -1},
        {{"A", "Y"}, {1}, 0},
        {{"Z", "L"}, {1}, -1},
        {{"id", "A"}, {0}, 1},         // no name tells: first that may be
        {{"Z", "A", "mask"}, {2}, 1},  //
        {{"A"}, {0}, -1},              //
        {{"b.R", "b.G", "b.B", "R", "G", "B", "b.A"}, {3, 4, 5}, -1},  // plain names first
        {{"n.X", "b.B", "b.G", "b.R", "b.A", "A"}, {3, 2, 1}, 4},      // else the first layer
        {{"a.Y", "b.R", "b.G", "b.B"}, {1, 2, 3}, -1},                 // colour before grey
        {{"left.b.R", "left.b.G", "left.b.B"}, {0, 1, 2}, -1},
        {{"R", "G", "Z"}, {0}, -1},    // two of three are no colour
        {{"x.R", "G", "B"}, {0}, -1},  // nor are three of different layers
    };
    for (const NamesCase& test : cases) {
        const ColorChannels found = find_color_channels(test.names);
        EXPECT_EQ(found.color, test.color) << test.names.front();
        EXPECT_EQ(found.alpha, test.alpha) << test.names.front();
    }
}

TEST(Picture, PutsColorFirst) {
    const Image image = noise(3, 2, 5);
    const Picture picture(image, {"A", "B", "id", "G", "R"});
    EXPECT_EQ(picture.channel_names(), (std::vector<std::string>{"R", "G", "B", "A", "id"}));
    EXPECT_EQ(picture.color_channels(), 3);
    EXPECT_EQ(picture.alpha_channel(), 3);
    const int from[] = {4, 3, 1, 0, 2};
    for (int c = 0; c < 5; ++c) EXPECT_EQ(picture.image().at(2, 1, c), image.at(2, 1, from[c]));
    EXPECT_EQ(picture.color().channels, 3);
    EXPECT_EQ(picture.color().at(2, 1, 2), image.at(2, 1, 1));
}

TEST(Picture, NamesChannelsByTheirNumber) {
    EXPECT_EQ(Picture(Image(1, 1, 1)).channel_names(), (std::vector<std::string>{"Y"}));
    EXPECT_EQ(Picture(Image(1, 1, 2)).channel_names(), (std::vector<std::string>{"Y", "A"}));
    EXPECT_EQ(Picture(Image(1, 1, 5)).channel_names(),
              (std::vector<std::string>{"R", "G", "B", "A", "channel4"}));
}

TEST(Picture, RefusesWrongNames) {
    EXPECT_THROW(Picture(Image(2, 2, 3), {"R", "G"}), InvalidArgument);
    EXPECT_THROW(Picture(Image(2, 2, 2), {"R", "R"}), InvalidArgument);
    EXPECT_THROW(Picture(Image(2, 2, 1), {""}), InvalidArgument);
    EXPECT_THROW(Picture{Image{}}, InvalidArgument);
}

TEST(Picture, AppendsLayersNamedLikeItsColor) {
    const Image image = noise(4, 3, 4);
    const Image glare = noise(4, 3, 3, 2);
    Picture picture(image);
    picture.append_layer("glare", glare);
    EXPECT_EQ(picture.channel_names(),
              (std::vector<std::string>{"R", "G", "B", "A", "glare.R", "glare.G", "glare.B"}));
    EXPECT_EQ(picture.color_channels(), 3);
    EXPECT_EQ(picture.alpha_channel(), 3);
    for (int c = 0; c < 4; ++c) EXPECT_EQ(picture.image().at(3, 2, c), image.at(3, 2, c));
    for (int c = 0; c < 3; ++c) EXPECT_EQ(picture.image().at(3, 2, 4 + c), glare.at(3, 2, c));

    EXPECT_THROW(picture.append_layer("glare", glare), InvalidArgument);
    EXPECT_THROW(picture.append_layer("other", noise(4, 4, 3)), InvalidArgument);
    EXPECT_THROW(picture.append_layer("", glare), InvalidArgument);
    EXPECT_THROW(picture.append_layer("grey", noise(4, 3, 1)), InvalidArgument);
    EXPECT_EQ(picture.image().channels(), 7);

    Picture grey(noise(4, 3, 1));
    grey.append_layer("glare", noise(4, 3, 1, 2));
    EXPECT_EQ(grey.channel_names(), (std::vector<std::string>{"Y", "glare.Y"}));
}

TEST(Picture, CopiesDoNotShareChanges) {
    Picture first(noise(2, 2, 1));
    first.set_attribute("aureole:fov_deg", 40.0F);
    Picture second = first;
    second.set_attribute("aureole:fov_deg", 50.0F);
    second.set_attribute("owner", "me");
    EXPECT_EQ(first.float_attribute("aureole:fov_deg"), 40.0F);
    EXPECT_EQ(second.float_attribute("aureole:fov_deg"), 50.0F);
    EXPECT_EQ(first.string_attribute("owner"), std::nullopt);
    EXPECT_EQ(second.string_attribute("owner"), "me");
    EXPECT_EQ(second.float_attribute("owner"), std::nullopt);
    EXPECT_EQ(second.string_attribute("aureole:fov_deg"), std::nullopt);
    second.erase_attribute("owner");
    EXPECT_EQ(second.attribute_names(), (std::vector<std::string>{"aureole:fov_deg"}));
}

TEST(FieldOfView, FollowsTheOrderOfTrust) {
    Picture picture(Image(30, 20, 1));
    EXPECT_FALSE(field_of_view(picture).has_value());

    picture.set_attribute("Exif:FocalLengthIn35mmFilm", 18.0F);
    EXPECT_NEAR(field_of_view(picture)->deg, 90, 1e-9);
    picture.set_attribute("screenWindowWidth", 1.0F);  // what writers without a camera put there
    EXPECT_EQ(field_of_view(picture)->source, "Exif:FocalLengthIn35mmFilm");
    picture.set_attribute("screenWindowWidth", 2.0F);
    EXPECT_NEAR(field_of_view(picture)->deg, 90, 1e-9);
    EXPECT_EQ(field_of_view(picture)->source, "screenWindowWidth");
    picture.set_attribute("aureole:fov_deg", 33.0F);
    EXPECT_EQ(field_of_view(picture)->deg, 33);
    picture.set_attribute("aureole:fov_deg", -1.0F);  // nonsense is passed over
    EXPECT_EQ(field_of_view(picture)->source, "screenWindowWidth");
}

// A 50 mm lens on 24 x 36 mm held upright sees 24 mm across: 26.99 deg, not 39.6.
TEST(FieldOfView, TurnsThe35mmFrameForPortraits) {
    Picture picture(Image(20, 30, 1));
    picture.set_attribute("Exif:FocalLengthIn35mmFilm", 50.0F);
    EXPECT_NEAR(field_of_view(picture)->deg, 26.99, 0.01);
}

// Overscan adds pixels, not field of view: the metadata describes the display window.
TEST(FieldOfView, RefersToTheDisplayWindow) {
    Picture picture(Image(60, 200, 1));
    picture.set_display_window({10, 10, 36, 24});
    picture.set_attribute("Exif:FocalLengthIn35mmFilm", 18.0F);
    EXPECT_NEAR(field_of_view(picture)->deg, 90, 1e-9);
}

}  // namespace
}  // namespace aureole::io
