// Lens files of CODE V.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "aureole/lens/glass.h"
#include "lens/format_fixtures.h"
#include "lens/format_test_support.h"

namespace aureole::lens {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(CodeVFormat, RowsHoldCurvaturesUnlessRdmSaysRadii) {
    const std::string text = "S 0.04 3 516.642\nCIR 8\nS 0 4\nSTO\nCIR 5\nSI 0 0\nGO\n";
    for (const char* head : {"", "RDM N\n", "RDM NO;LEN\n", "LEN NEW\n"}) {
        EXPECT_EQ(parse_code_v(std::string(head) + "SO 0 1e10\n" + text, "f").surfaces[0].radius_mm,
                  25);
    }
    for (const char* head : {"RDM\n", "RDM Y\n", "rdm yes;len\n", "RDM;LEN \"VERSION: 1\"\n"}) {
        EXPECT_EQ(parse_code_v(std::string(head) + text, "f").surfaces[0].radius_mm, 0.04);
    }
}

TEST(CodeVFormat, GlassByNameByCodeAndByNumbers) {
    const auto flint = [](const char* glass) {
        return parse_code_v(with(kTripletSeq, "F2_SCHOTT", glass), "f").surfaces[2];
    };
    EXPECT_EQ(flint("F2").glass, "F2");
    EXPECT_EQ(flint("NSF6_SCHOTT").glass, "N-SF6");
    EXPECT_EQ(flint("SFPL53_OHARA").glass, "S-FPL53");
    EXPECT_EQ(flint("bk7_schott").glass, "N-BK7");
    EXPECT_DOUBLE_EQ(flint("620.364").index, 1.62);
    EXPECT_DOUBLE_EQ(flint("620.364").abbe, 36.4);
    EXPECT_DOUBLE_EQ(flint("620041.363662").index, 1.620041);
    EXPECT_DOUBLE_EQ(flint("620041.363662").abbe, 36.3662);
    EXPECT_DOUBLE_EQ(flint("917.212").index, 1.917);
    EXPECT_EQ(flint("1.62 36.4").index, 1.62);
    EXPECT_EQ(flint("1.62 36.4").abbe, 36.4);
    EXPECT_EQ(flint("1.62").abbe, 0);
}

TEST(CodeVFormat, CommandsMayNameTheirSurface) {
    const Prescription lens = parse_code_v(kTripletSeq, "f");
    std::string text(kTripletSeq);
    text = with(text, "GO\n",
                "RDY S1 -50\nCUY S2 0.01\nTHI S3 1.5\nGLA S1 F2\nK S6 -2\nC S6 3e-9\nGO");
    Prescription expected = lens;
    expected.surfaces[0].radius_mm = -50;
    expected.surfaces[0].glass = "F2";
    expected.surfaces[0].index = find_glass("F2")->index_d();
    expected.surfaces[0].abbe = find_glass("F2")->abbe();
    expected.surfaces[1].radius_mm = 100;
    expected.surfaces[2].thickness_mm = 1.5;
    expected.surfaces[6].conic = -2;
    expected.surfaces[6].asphere = {0, 2e-8, 3e-9};
    EXPECT_EQ(parse_code_v(text, "f"), expected);
}

TEST(CodeVFormat, UnitsScaleEveryLength) {
    const Prescription mm = parse_code_v(kTripletSeq, "f");
    for (const auto& [unit, ratio] : {std::pair("DIM   C", 10.0), std::pair("DIM   I", 25.4)}) {
        const Prescription other = parse_code_v(with(kTripletSeq, "DIM   M", unit), "f");
        EXPECT_DOUBLE_EQ(other.surfaces[0].radius_mm, ratio * mm.surfaces[0].radius_mm);
        EXPECT_DOUBLE_EQ(other.surfaces[1].thickness_mm, ratio * mm.surfaces[1].thickness_mm);
        EXPECT_DOUBLE_EQ(other.surfaces[4].semi_aperture_mm,
                         ratio * mm.surfaces[4].semi_aperture_mm);
    }
}

// Most files of CODE V leave the apertures to the program.
TEST(CodeVFormat, MissingAperturesAreEstimatedFromTheEntrancePupil) {
    const Prescription lens =
        parse_code_v("EPD 10\nYAN 0 10\nSO 0 1e13\nS 0.02 6 500.600\nSTO\nS 0 90\nSI 0 0\n", "f");
    EXPECT_TRUE(lens.surfaces[0].stop);  // in front of the glass
    EXPECT_NEAR(lens.surfaces[0].semi_aperture_mm, 5, 1e-9);
    EXPECT_NEAR(lens.surfaces[1].semi_aperture_mm, 1.05 * 5, 1e-9);
    EXPECT_NEAR(lens.f_number, 10, 1e-9);
    EXPECT_EQ(lens.field_deg, 20);
}

TEST(CodeVFormat, WhatIsIgnoredIsToldOnceWithItsPlace) {
    std::string text = with(kTripletSeq, "GO\n", "ZOO 3\nZOO THI S2 1 2 3\nTHI S2 OAL S1..3 9\n");
    text = with(text, "  CIR 9.5; CCY 0\n", "  CIR 9.5; CCY 0\n  CIR OBS 2\n  XDE 0.0\n");
    EXPECT_THAT(parse_code_v(text, "f").warnings,
                ElementsAre(HasSubstr("ignored: CIR (surface 1, line 12), ZOO (line"),
                            HasSubstr("the stop lies")));
}

TEST(CodeVFormat, PrivateGlassesAreNotTakenForCommands) {
    const auto text = with(kTripletSeq, "GO\n", "PRV\nPWL 656 587 486\n'XX' 1.6 1.61 1.62\nEND\n");
    EXPECT_EQ(parse_code_v(text, "f"), parse_code_v(kTripletSeq, "f"));
    EXPECT_THAT(refusal(parse_code_v, with(text, "F2_SCHOTT", "'XX'")), HasSubstr("glass = XX"));
}

TEST(CodeVFormat, WhatIsWrongIsNamedWithLineSurfaceAndWhatIsAllowed) {
    const Spoilt cases[] = {
        {"S     22.0136 3.259", "S     22.0136 x", {"line 10: surface 1: S = x", "finite"}},
        {"S     22.0136 3.259", "S     nan 3.259", {"line 10: surface 1: S = nan", "finite"}},
        {"S     22.0136 3.259 NSK16_SCHOTT", "S     22.0136", {"surface 1: S: a value is missing"}},
        {"F2_SCHOTT", "XK9_SCHOTT", {"line 14: surface 3: glass = XK9_SCHOTT", "catalogue"}},
        {"F2_SCHOTT", "REFL", {"surface 3: glass = REFL", "mirrors"}},
        {"F2_SCHOTT", "0.0 3", {"surface 3: index = 0", "[1, 5]"}},
        {"F2_SCHOTT", "620.xyz", {"surface 3: glass = 620.xyz"}},
        {"6.0076", "-6.0076", {"surface 2: thickness_mm = -6.0076", "negative"}},
        {"  STO\n", "", {"stops = 0"}},
        {"CIR S5 7.5", "STO S5; CIR S5 7.5", {"stops", "= 2"}},
        {"CIR S5 7.5", "CIR S7 7.5", {"CIR of surface = S7", "S1 to S6"}},
        {"CIR S5 7.5", "CIR S1.5 7.5", {"CIR of surface = S1.5"}},
        {"CIR S5 7.5", "CIR S5 -7.5", {"surface 5: CIR = -7.5", "positive"}},
        {"CIR S5 7.5", "CIR S5", {"surface 5: CIR: a value is missing"}},
        {"  K -0.125", "  XDE 0.5", {"surface 6: command = XDE", "centred"}},
        {"  K -0.125", "  CYL", {"surface 6: command = CYL", "rotational"}},
        {"  K -0.125", "  SPS XYP", {"surface 6: command = SPS"}},
        {"  K -0.125", "  J 1e-20", {"surface 6: J = 1e-20", "r^16"}},
        {"DIM   M", "DIM   F", {"line 4: DIM = F", "M (mm)"}},
        {"FNO   5.0", "FNO   0", {"line 3: FNO = 0", "positive"}},
        {"RDM;", "RDM X;", {"line 1: RDM = X", "Y or N"}},
        {"GO\n", "S 10 10\n", {"surface follows the image"}},
    };
    for (const Spoilt& c : cases) {
        SCOPED_TRACE(c.to);
        const std::string message = refusal(parse_code_v, with(kTripletSeq, c.from, c.to));
        EXPECT_THAT(message, testing::StartsWith("some/file.ext: "));
        for (const std::string& part : c.said) EXPECT_THAT(message, HasSubstr(part));
    }
}

}  // namespace
}  // namespace aureole::lens
