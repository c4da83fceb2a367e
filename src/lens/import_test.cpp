// The same lens through every format, and choosing a parser by the file's extension.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lens/format_fixtures.h"
#include "lens/format_test_support.h"

namespace aureole::lens {
namespace {

using testing::HasSubstr;

// Equal up to the rounding of a curvature and a unit, 1e-14.
void expect_same_table(const Prescription& a, const Prescription& b) {
    const auto near = [](double x, double y) { return std::abs(x - y) <= 1e-14 * std::abs(x); };
    EXPECT_EQ(a.name, b.name);
    ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
    for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
        SCOPED_TRACE(i + 1);
        const Surface& s = a.surfaces[i];
        const Surface& t = b.surfaces[i];
        EXPECT_PRED2(near, s.radius_mm, t.radius_mm);
        EXPECT_PRED2(near, s.thickness_mm, t.thickness_mm);
        EXPECT_PRED2(near, s.semi_aperture_mm, t.semi_aperture_mm);
        EXPECT_EQ(s.index, t.index);
        EXPECT_EQ(s.abbe, t.abbe);
        EXPECT_EQ(s.glass, t.glass);
        EXPECT_EQ(s.stop, t.stop);
        EXPECT_EQ(s.conic, t.conic);
        ASSERT_EQ(s.asphere.size(), t.asphere.size());
        for (std::size_t k = 0; k < s.asphere.size(); ++k) {
            EXPECT_PRED2(near, s.asphere[k], t.asphere[k]);
        }
    }
}

TEST(Import, OneLensIsTheSameThroughAllFormats) {
    Prescription lens = parse_prescription(kTripletToml, "triplet.toml");
    for (const Prescription& other : {parse_prescription(kTripletZmx, "dir.x/triplet.ZMX"),
                                      parse_prescription(kTripletSeq, "triplet.Seq")}) {
        expect_same_table(lens, other);
        EXPECT_EQ(other.f_number, 5);
        EXPECT_EQ(other.field_deg, 40);
        // Only the stop, which lay on a face of the flint, was mended.
        ASSERT_EQ(other.warnings.size(), 1u);
        EXPECT_THAT(other.warnings[0], HasSubstr("surface 4: the stop lies on a face of glass"));
    }
    const Prescription pbrt = parse_prescription(kTripletDat, "triplet.dat");
    EXPECT_TRUE(pbrt.warnings.empty());
    for (Surface& s : lens.surfaces) {
        s.glass.clear();
        s.abbe = 0;
        s.conic = 0;
        s.asphere.clear();
        s.index = std::round(s.index * 1e5) / 1e5;  // as the file prints it
    }
    expect_same_table(lens, pbrt);
}

TEST(Import, TheExtensionChoosesTheFormat) {
    const auto message = [](const std::string& file) -> std::string {
        try {
            parse_prescription(kTripletToml, file);
        } catch (const FileError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(message("a.b/c.toml"), "accepted");
    EXPECT_EQ(message("c.TOML"), "accepted");
    EXPECT_THAT(message("lens.len"), HasSubstr("lens.len: extension = .len: must be .toml"));
    EXPECT_THAT(message("a.toml/lens"), HasSubstr("extension = none"));
    EXPECT_THAT(message(""), HasSubstr("extension = none"));
    // A file of another format is not taken for this one.
    EXPECT_THAT(message("c.zmx"), HasSubstr("SURF"));
    EXPECT_THAT(message("c.dat"), HasSubstr("line 1"));
    EXPECT_NE(message("c.seq"), "accepted");
}

TEST(Import, FilesThatAreNoTables) {
    for (const Parser parse : {parse_zmx, parse_pbrt, parse_code_v}) {
        EXPECT_THAT(refusal(parse, ""), HasSubstr("some/file.ext: empty"));
        EXPECT_THAT(refusal(parse, std::string(5 << 20, ' ')), HasSubstr("5242880 bytes"));
        for (const std::string& garbage :
             {std::string(1000, '\0'), std::string("\xFF\xD8\xFF\xE0\0JFIF\n1 2 3"),
              std::string(100000, '"'), std::string(100000, '\n'), std::string("# nothing")}) {
            EXPECT_NE(refusal(parse, garbage), "accepted");
        }
    }
}

TEST(Import, TenThousandSurfacesAreTooMany) {
    std::string zmx = "SURF 0\nCURV 0\nDISZ INFINITY\n";
    std::string seq = "SO 0 1e13\n";
    std::string dat;
    for (int i = 1; i <= 10000; ++i) {
        zmx += "SURF " + std::to_string(i) + "\nCURV 0\nDISZ 1\nDIAM 1\n";
        seq += "S 0 1\nCIR 1\n";
        dat += "10 1 1 1\n";
    }
    EXPECT_THAT(refusal(parse_zmx, zmx), HasSubstr("surfaces = 9999: must be 2 to 1000"));
    EXPECT_THAT(refusal(parse_code_v, seq), HasSubstr("surfaces = 10000: must be 2 to 1000"));
    EXPECT_THAT(refusal(parse_pbrt, dat), HasSubstr("surfaces = 10000: must be 2 to 1000"));
}

}  // namespace
}  // namespace aureole::lens
