// Lens files of Zemax.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "aureole/lens/glass.h"
#include "lens/format_fixtures.h"
#include "lens/format_test_support.h"

namespace aureole::lens {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string utf16(std::string_view text, bool big_endian) {
    std::string bytes = big_endian ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : text) {
        bytes += big_endian ? '\0' : c;
        bytes += big_endian ? c : '\0';
    }
    return bytes;
}

TEST(ZmxFormat, EveryEncodingOfAFileIsTheSameLens) {
    const Prescription lens = parse_zmx(kTripletZmx, "f");
    EXPECT_EQ(parse_zmx(utf16(kTripletZmx, false), "f"), lens);
    EXPECT_EQ(parse_zmx(utf16(kTripletZmx, true), "f"), lens);
    EXPECT_EQ(parse_zmx("\xEF\xBB\xBF" + std::string(kTripletZmx), "f"), lens);
    // Names keep their letters; bytes of other code pages are not UTF-8.
    EXPECT_EQ(parse_zmx(with(kTripletZmx, "NAME Triplet", "NAME F\xC3\xBCr 50"), "f").name,
              "F\xC3\xBCr 50");
    EXPECT_EQ(parse_zmx(with(kTripletZmx, "NAME Triplet", "NAME F\xFCr 50"), "f").name, "F?r 50");
    const auto accent =
        with(utf16(kTripletZmx, false), utf16("T", false).substr(2) + "r", "\xFC\x01r");
    EXPECT_EQ(parse_zmx(accent, "f").name, "\xC7\xBCriplet");
    std::string windows;
    for (const char c : kTripletZmx) windows += c == '\n' ? "\r\n" : std::string(1, c);
    EXPECT_EQ(parse_zmx(windows, "f"), lens);
    std::string cut = utf16(kTripletZmx, false);
    cut.pop_back();
    EXPECT_THAT(refusal(parse_zmx, cut), HasSubstr("odd number of bytes"));
}

TEST(ZmxFormat, UnitsScaleEveryLength) {
    const Prescription cm = parse_zmx(kTripletZmx, "f");
    for (const auto& [unit, ratio] :
         {std::pair("MM", 0.1), std::pair("IN", 2.54), std::pair("METER", 100.0)}) {
        const Prescription other =
            parse_zmx(with(kTripletZmx, "UNIT CM", std::string("UNIT ") + unit), "f");
        for (std::size_t i = 0; i < cm.surfaces.size(); ++i) {
            const Surface& s = cm.surfaces[i];
            const Surface& t = other.surfaces[i];
            EXPECT_DOUBLE_EQ(t.radius_mm, s.radius_mm * ratio);
            EXPECT_DOUBLE_EQ(t.thickness_mm, s.thickness_mm * ratio);
            EXPECT_DOUBLE_EQ(t.semi_aperture_mm, s.semi_aperture_mm * ratio);
        }
        // a r^6 is a length.
        EXPECT_DOUBLE_EQ(other.surfaces[6].asphere[1],
                         cm.surfaces[6].asphere[1] * std::pow(ratio, -5));
    }
}

TEST(ZmxFormat, GlassByNameByModelAndByTheNumbersBesideAnUnknownName) {
    const auto flint = [](const char* glass) {
        return parse_zmx(with(kTripletZmx, "GLAS F2 0 0 1.5 4.0E+1", glass), "f").surfaces[2];
    };
    EXPECT_EQ(flint("GLAS F2").glass, "F2");
    EXPECT_EQ(flint("GLAS f2 0 0 0 0").index, find_glass("F2")->index_d());
    const Surface model = flint("GLAS ___BLANK 1 0 1.62 36.4 0 0 0 0 0 0");
    EXPECT_EQ(model.glass, "");
    EXPECT_EQ(model.index, 1.62);
    EXPECT_EQ(model.abbe, 36.4);
    const Surface unknown = flint("GLAS MYGLASS 0 0 1.61 37.5 0 0");
    EXPECT_EQ(unknown.glass, "");
    EXPECT_EQ(unknown.index, 1.61);
    EXPECT_EQ(unknown.abbe, 37.5);
    const auto lens = parse_zmx(
        with(kTripletZmx, "GLAS F2 0 0 1.5 4.0E+1", "GLAS MYGLASS 0 0 1.61 37.5 0 0"), "f");
    EXPECT_THAT(lens.warnings[0], HasSubstr("surface 3: glass MYGLASS"));
}

TEST(ZmxFormat, ATermOfTheSquareAloneIsAParaboloid) {
    auto text = with(kTripletZmx, "CURV -0.5436171195903302", "CURV 0");
    text = with(text, "PARM 1 0", "PARM 1 -0.25");
    const Surface s = parse_zmx(with(text, "CONI -0.125", "CONI 0"), "f").surfaces[6];
    // z = -0.25 / cm r^2 = r^2 / (2 R) with R = -2 cm.
    EXPECT_DOUBLE_EQ(s.radius_mm, -20);
    EXPECT_EQ(s.conic, -1);
    EXPECT_EQ(s.asphere.size(), 2u);
}

TEST(ZmxFormat, AspheresOfStandardSurfacesAreNotRead) {
    const auto text = with(kTripletZmx, "TYPE EVENASPH", "TYPE STANDARD");
    EXPECT_TRUE(parse_zmx(text, "f").surfaces[6].asphere.empty());
    EXPECT_EQ(parse_zmx(text, "f").surfaces[6].conic, -0.125);
}

TEST(ZmxFormat, AClearApertureCountsBeforeTheSemiDiameter) {
    const auto text = with(kTripletZmx, "DIAM 0.95 1", "CLAP 0 0.8 0\n  DIAM 0.95 1");
    EXPECT_DOUBLE_EQ(parse_zmx(text, "f").surfaces[0].semi_aperture_mm, 8);
}

TEST(ZmxFormat, AStopOnAFrontFaceGetsItsRowInFrontOfIt) {
    auto text = with(kTripletZmx, "  STOP\n", "");
    text = with(text, "SURF 5\n", "SURF 5\n  STOP\n");
    const Prescription lens = parse_zmx(text, "f");
    ASSERT_EQ(lens.surfaces.size(), 7u);
    EXPECT_TRUE(lens.surfaces[4].stop);
    EXPECT_EQ(lens.surfaces[4].thickness_mm, 0);
    EXPECT_EQ(lens.surfaces[4].semi_aperture_mm, lens.surfaces[5].semi_aperture_mm);
    EXPECT_DOUBLE_EQ(lens.surfaces[3].thickness_mm, 4.7504);
    EXPECT_THAT(lens.warnings, ElementsAre(HasSubstr("surface 5: the stop lies on a face")));
}

// y = 5.0 mm enters; a thin beam: paraxial heights by hand, y' = y + u d.
TEST(ZmxFormat, MissingSemiDiametersAreEstimatedFromTheBeam) {
    const std::string text =
        "ENPD 10\nYFLN 0 0\nSURF 0\nCURV 0\nDISZ INFINITY\n"
        "SURF 1\nSTOP\nCURV 0\nDISZ 10\nDIAM 0\n"
        "SURF 2\nCURV 0.02\nDISZ 6\nGLAS ___BLANK 1 0 1.5 60\nDIAM 0\n"
        "SURF 3\nCURV 0\nDISZ 90\nDIAM 7 1\nSURF 4\nCURV 0\nDISZ 0\n";
    const Prescription on_axis = parse_zmx(text, "f");
    EXPECT_NEAR(on_axis.surfaces[0].semi_aperture_mm, 5, 1e-9);
    EXPECT_NEAR(on_axis.surfaces[1].semi_aperture_mm, 1.05 * 5, 1e-9);
    EXPECT_EQ(on_axis.surfaces[2].semi_aperture_mm, 7);
    // f = R / (n - 1) = 100 mm, over an entrance of 10 mm.
    EXPECT_NEAR(on_axis.f_number, 10, 1e-9);
    EXPECT_THAT(on_axis.warnings, ElementsAre(HasSubstr("estimated")));
    // The principal ray of 20 deg is tan(20 deg) * 10 mm high on the first face.
    const Prescription field = parse_zmx(with(text, "YFLN 0 0", "YFLN 0 -20"), "f");
    EXPECT_NEAR(field.surfaces[1].semi_aperture_mm, 1.05 * (5 + 10 * 0.363970234266), 1e-9);
    EXPECT_NEAR(field.surfaces[0].semi_aperture_mm, 5, 1e-9);
    // Nothing to estimate from.
    EXPECT_THAT(refusal(parse_zmx, with(text, "ENPD 10", "")),
                HasSubstr("surface 1: semi-aperture = missing: must be given"));
}

// The stop 10 mm behind a plano-convex lens; by hand, from the centre of the stop forwards, with
// slope 1 there: y2 = -10, y1 = y2 - 6 / 1.5 = -14, slope in front 1 + y1 * 0.5 / 50 = 0.86.
TEST(ZmxFormat, ThePrincipalRayMeetsTheCentreOfTheStop) {
    const Prescription lens = parse_zmx(
        "ENPD 10\nYFLN 0 20\nSURF 0\nCURV 0\nDISZ INFINITY\n"
        "SURF 1\nCURV 0.02\nDISZ 6\nGLAS ___BLANK 1 0 1.5 60\nDIAM 0\n"
        "SURF 2\nCURV 0\nDISZ 10\nDIAM 0\n"
        "SURF 3\nSTOP\nCURV 0\nDISZ 80\nDIAM 0\nSURF 4\nCURV 0\nDISZ 0\n",
        "f");
    const double slope = 0.363970234266 / 0.86;
    EXPECT_NEAR(lens.surfaces[0].semi_aperture_mm, 1.05 * (5 + 14 * slope), 1e-9);
    EXPECT_NEAR(lens.surfaces[1].semi_aperture_mm, 1.05 * (4.8 + 10 * slope), 1e-9);
    EXPECT_NEAR(lens.surfaces[2].semi_aperture_mm, 4.8 - 10 * 0.05, 1e-9);
}

TEST(ZmxFormat, WhatAnImageAtInfinityLacksIsTold) {
    const auto near = with(kTripletZmx, "DISZ INFINITY", "DISZ 250");
    EXPECT_THAT(parse_zmx(near, "f").warnings, testing::Contains(HasSubstr("distance of 250")));
    const auto zoom = std::string(kTripletZmx) + "MNUM 3 1\n";
    EXPECT_THAT(parse_zmx(zoom, "f").warnings, testing::Contains(HasSubstr("3 configurations")));
}

TEST(ZmxFormat, WhatIsWrongIsNamedWithLineSurfaceAndWhatIsAllowed) {
    const Spoilt cases[] = {
        {"CURV -0.4501807475701494", "CURV x", {"line 28: surface 3: CURV = x", "finite"}},
        {"CURV -0.4501807475701494", "CURV NAN", {"line 28: surface 3: CURV = NAN", "finite"}},
        {"CURV -0.4501807475701494", "CURV", {"line 28: surface 3: CURV: value 1 is missing"}},
        {"  CURV -0.4501807475701494\n", "", {"surface 3: CURV is missing"}},
        {"  DISZ 0.60076\n", "", {"surface 2: DISZ is missing"}},
        {"DISZ 0.60076", "DISZ INFINITY", {"surface 2: DISZ = INFINITY", "finite"}},
        {"DISZ 0.60076", "DISZ -0.60076", {"surface 2: thickness_mm = -6.0076", "negative"}},
        {"GLAS F2 0 0 1.5 4.0E+1", "GLAS MIRROR 0 0", {"surface 3: GLAS = MIRROR", "mirrors"}},
        {"GLAS F2 0 0 1.5 4.0E+1", "GLAS XK9 0 0 1.5 4.0E+1", {"surface 3: glass = XK9", "index"}},
        {"GLAS F2 0 0 1.5 4.0E+1", "GLAS XK9 0 0 0 0", {"surface 3: glass = XK9", "catalogue"}},
        {"GLAS F2 0 0 1.5 4.0E+1", "GLAS ___BLANK 1 0", {"surface 3: GLAS", "index"}},
        {"GLAS F2 0 0 1.5 4.0E+1", "GLAS ___BLANK 1 0 0 36", {"surface 3: index = 0", "[1, 5]"}},
        {"GLAS F2 0 0 1.5 4.0E+1", "GLAS ___BLANK 2 1 1.5 40", {"surface 3: glass"}},
        {"TYPE EVENASPH", "TYPE COORDBRK", {"surface 6: TYPE = COORDBRK", "EVENASPH"}},
        {"TYPE EVENASPH", "TYPE", {"surface 6: TYPE = "}},
        {"PARM 1 0", "PARM 1 1e-3", {"surface 6: PARM 1 = 0.001", "CURV"}},
        {"PARM 4 0", "PARM 9 1", {"surface 7: number of asphere coefficients = 8"}},
        {"PARM 4 0", "PARM 1e9 1", {"surface 6: PARM = 1e9", "1 to 255"}},
        {"PARM 4 0", "PARM 2.5 1", {"surface 6: PARM = 2.5"}},
        {"UNIT CM", "UNIT FEET", {"line 4: UNIT = FEET", "MM, CM, IN or METER"}},
        {"UNIT CM", "UNIT CM\nENPD -1", {"line 5: ENPD = -1", "positive"}},
        {"MODE SEQ", "MODE NSC", {"line 2: MODE = NSC", "SEQ"}},
        {"  STOP\n", "", {"stops = 0"}},
        {"SURF 5\n", "SURF 5\nSTOP\n", {"stops", "= 2"}},
        {"SURF 5\n", "SURF 6\n", {"SURF = 6", "must be 5"}},
        {"DIAM 0.75 1", "DIAM -0.75", {"semi_aperture_mm = -7.5", "positive"}},
        {"DISZ INFINITY", "DISZ INFINITY\nGLAS F2", {"object lies in glass"}},
        {"DISZ 4.2208", "DISZ 4.2208\nGLAS F2", {"air"}},
    };
    for (const Spoilt& c : cases) {
        SCOPED_TRACE(c.to);
        const std::string message = refusal(parse_zmx, with(kTripletZmx, c.from, c.to));
        EXPECT_THAT(message, testing::StartsWith("some/file.ext: "));
        for (const std::string& part : c.said) EXPECT_THAT(message, HasSubstr(part));
    }
}

TEST(ZmxFormat, AStopInsideCementedGlassIsRefused) {
    const auto text = with(kTripletZmx, "DISZ 0.60076", "DISZ 0.60076\nGLAS F2");
    EXPECT_THAT(refusal(parse_zmx, with(with(text, "  STOP\n", ""), "SURF 2\n", "SURF 2\nSTOP\n")),
                HasSubstr("surface 2: the stop lies on a cemented face"));
}

}  // namespace
}  // namespace aureole::lens
