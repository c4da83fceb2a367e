// Lens files of pbrt.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lens/format_fixtures.h"
#include "lens/format_test_support.h"

namespace aureole::lens {
namespace {

using testing::HasSubstr;

TEST(PbrtFormat, ColumnsAreDiametersAndTheStopIsTheRowWithoutRadius) {
    const Prescription lens = parse_pbrt(kTripletDat, "f");
    EXPECT_EQ(lens.name, "Triplet");
    EXPECT_EQ(lens.surfaces[0].semi_aperture_mm, 9.5);
    EXPECT_TRUE(lens.surfaces[4].stop);
    EXPECT_EQ(lens.surfaces[4].index, 1);
    // Some files print index 1 there.
    EXPECT_EQ(parse_pbrt(with(kTripletDat, "4.7504   0", "4.7504   1"), "f"), lens);
}

TEST(PbrtFormat, AFlatFaceOfGlassIsNoStop) {
    const Prescription lens =
        parse_pbrt("0 2 0 8\n0 3 1.5 10\n0 4 1 10\n30 2 1.6 10\n0 9 1.0 10\n", "f");
    EXPECT_TRUE(lens.surfaces[0].stop);
    EXPECT_EQ(lens.surfaces[1].index, 1.5);
    EXPECT_FALSE(lens.surfaces[2].stop);
    EXPECT_FALSE(lens.surfaces[4].stop);
}

TEST(PbrtFormat, ALoneNumberOnTopIsTheFocalLength) {
    const auto text = with(kTripletDat, "22.0136", "50\n22.0136");
    EXPECT_EQ(parse_pbrt(text, "f").focal_length_mm, 50);
}

TEST(PbrtFormat, WhatIsWrongIsNamedWithLineSurfaceAndWhatIsAllowed) {
    const Spoilt cases[] = {
        {"-22.2133", "-22,2133", {"line 5: surface 3: radius = -22,2133", "finite number"}},
        {"-22.2133", "nan", {"line 5: surface 3: radius = nan", "finite"}},
        {"-22.2133", "inf", {"line 5: surface 3: radius = inf", "finite"}},
        {"-22.2133", "1e400", {"line 5: surface 3: radius = 1e400", "finite"}},
        {"0.99997  1.62004  10.0", "0.99997  1.62004", {"line 5: surface 3: row", "diameter"}},
        {"0.99997  1.62004  10.0", "0.99997  1.62004  10.0 5", {"line 5: surface 3: row"}},
        {"1.62004", "0", {"surface 3: index = 0", "[1, 5]"}},
        {"1.62004", "0.5", {"surface 3: index = 0.5", "[1, 5]"}},
        {"0.99997", "-0.99997", {"surface 3: thickness_mm = -0.99997", "negative"}},
        {"0         4.7504", "9         4.7504", {"surface 5: index = 0"}},
        {"0         4.7504   0", "9         4.7504   1", {"stops = 0"}},
        {"-435.76   6.0076   1  ", "-435.76 3 1 9\n0 3.0076 1 ", {"surfaces 3 and 6", "= 2"}},
        {"15.0\n", "-15.0\n", {"surface 6: semi_aperture_mm = -7.5", "positive"}},
        {"42.208   1  ", "42.208 1.5", {"last surface = 1.5", "air"}},
    };
    for (const Spoilt& c : cases) {
        SCOPED_TRACE(c.to);
        const std::string message = refusal(parse_pbrt, with(kTripletDat, c.from, c.to));
        EXPECT_THAT(message, testing::StartsWith("some/file.ext: "));
        for (const std::string& part : c.said) EXPECT_THAT(message, HasSubstr(part));
    }
}

}  // namespace
}  // namespace aureole::lens
