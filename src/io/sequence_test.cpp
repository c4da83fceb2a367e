#include "aureole/io/sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "aureole/base/error.h"

namespace aureole::io {
namespace {

using testing::ElementsAre;

TEST(ParseFrames, Ranges) {
    EXPECT_THAT(parse_frames("5"), ElementsAre(5));
    EXPECT_THAT(parse_frames("0998-1001"), ElementsAre(998, 999, 1000, 1001));
    EXPECT_THAT(parse_frames("1-10x2"), ElementsAre(1, 3, 5, 7, 9));
    EXPECT_THAT(parse_frames("1-3,7,20-30x5"), ElementsAre(1, 2, 3, 7, 20, 25, 30));
    EXPECT_THAT(parse_frames("-5--3"), ElementsAre(-5, -4, -3));
    EXPECT_THAT(parse_frames("4-4"), ElementsAre(4));
    EXPECT_THAT(parse_frames("2147483646-2147483647"), ElementsAre(2147483646, 2147483647));
    EXPECT_EQ(parse_frames("1001-1240").size(), 240U);
}

TEST(ParseFrames, DropsRepetitionsAndKeepsOrder) {
    EXPECT_THAT(parse_frames("7,1-3,2-8x3,7"), ElementsAre(7, 1, 2, 3, 5, 8));
}

TEST(ParseFrames, RefusesWhatIsMalformed) {
    for (const char* text :
         {"", " ", "a", "1-", "-", "1,", ",1", "1-2-3", "1-10x", "1-10x0", "1-10x-1", "10-1",
          "1..5", "1 - 5", "1-5 ", "99999999999", "1-2000000", "5x", "1-5,x2"}) {
        EXPECT_THROW(parse_frames(text), InvalidArgument) << '"' << text << '"';
    }
}

TEST(ParseFrames, MessageNamesValueAndWhatIsAllowed) {
    try {
        parse_frames("1001-1240q");
        FAIL();
    } catch (const InvalidArgument& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("1001-1240q"));
        EXPECT_THAT(error.what(), testing::HasSubstr("\"q\""));
        EXPECT_THAT(error.what(), testing::HasSubstr("1-10x2"));
    }
}

TEST(FramePath, FillsTheNumberIn) {
    EXPECT_EQ(frame_path("shot.%04d.exr", 7), "shot.0007.exr");
    EXPECT_EQ(frame_path("shot.####.exr", 7), "shot.0007.exr");
    EXPECT_EQ(frame_path("shot.%04d.exr", 123456), "shot.123456.exr");
    EXPECT_EQ(frame_path("s%d", 42), "s42");
    EXPECT_EQ(frame_path("s#", 42), "s42");
    EXPECT_EQ(frame_path("s%04d", -5), "s-005");  // as printf
    EXPECT_EQ(frame_path("100%%_%02d.exr", 3), "100%_03.exr");
    EXPECT_EQ(frame_path("still.exr", 3), "still.exr");
}

TEST(FramePath, LooksAtTheFileNameOnly) {
    EXPECT_EQ(frame_path("take#3/50%/a.##.exr", 1), "take#3/50%/a.01.exr");
    EXPECT_FALSE(has_frame_number("shot_####/a.exr"));
}

TEST(FramePath, RefusesUnknownAndRepeatedFields) {
    for (const char* pattern : {"a%s.exr", "a%4d.exr", "a%", "a%04", "%d_%d.exr", "##_##.exr",
                                "%04d.####.exr", "a%09999d"}) {
        EXPECT_THROW(frame_path(pattern, 1), InvalidArgument) << pattern;
    }
}

TEST(FramePaths, NeedsANumberForSeveralFrames) {
    EXPECT_THAT(frame_paths("a.##.exr", {1, 20}), ElementsAre("a.01.exr", "a.20.exr"));
    EXPECT_THAT(frame_paths("a.exr", {1}), ElementsAre("a.exr"));
    EXPECT_THROW(frame_paths("a.exr", {1, 2}), InvalidArgument);
}

}  // namespace
}  // namespace aureole::io
