// Our own lens format: what is written is read back bit by bit, and what is wrong is placed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/random.h"
#include "aureole/lens/glass.h"
#include "aureole/lens/library.h"
#include "lens/format_fixtures.h"
#include "lens/format_test_support.h"

namespace aureole::lens {
namespace {

using testing::HasSubstr;

// Any number of a sign, from the whole range of doubles that tables may hold.
double any_number(Random& random) {
    const double magnitude =
        std::ldexp(1 + random.uniform(), static_cast<int>(random.uniform(-60, 60)));
    return random.uniform() < 0.5 ? magnitude : -magnitude;
}

Prescription any_lens(Random& random) {
    Prescription lens;
    lens.name = "a \"quoted\" \\ name\twith\ncontrols \x01 and \xC3\xBC";
    lens.patent = random.uniform() < 0.5 ? "" : "US 1";
    lens.focal_length_mm = std::abs(any_number(random));
    lens.field_deg = random.uniform(0, 359);
    const int rows = 3 + static_cast<int>(random.uniform(0, 20));
    for (int i = 0; i < rows; ++i) {
        Surface s;
        s.thickness_mm = std::abs(any_number(random));
        s.semi_aperture_mm = std::abs(any_number(random));
        if (i == 1) {
            s.stop = true;
            lens.surfaces.push_back(s);
            continue;
        }
        s.radius_mm = random.uniform() < 0.2 ? 0 : any_number(random);
        if (i > 1 && i + 1 < rows) {
            s.index = random.uniform(1, 5);
            s.abbe = random.uniform() < 0.3 ? 0 : random.uniform(5, 150);
            if (random.uniform() < 0.3) {
                const auto& glasses = glass_catalogue();
                const Glass& glass = glasses[random.next_bits() % glasses.size()];
                s.glass = glass.name;
                s.index = glass.index_d() + random.uniform(-1e-3, 1e-3);
            }
        }
        s.conic = random.uniform() < 0.5 ? 0 : any_number(random);
        for (double k = random.uniform(-7, 7); k > 1; --k) s.asphere.push_back(any_number(random));
        s.profile = static_cast<Profile>(random.next_bits() % 3);
        s.coating = random.uniform() < 0.3 ? "mgf2:480" : "";
        lens.surfaces.push_back(s);
    }
    if (random.uniform() < 0.5) {
        lens.positions = {{"wide", 30.1, 0, 0, {}},
                          {"tele", std::abs(any_number(random)), 4, 10, {{1, 0.1}, {3, 1.0 / 3}}}};
    }
    return lens;
}

TEST(TomlFormat, WhatIsWrittenIsReadBackBitByBit) {
    Random random(1);
    for (int i = 0; i < 300; ++i) {
        const Prescription lens = any_lens(random);
        ASSERT_EQ(parse_toml(to_toml(lens), "file"), lens) << to_toml(lens);
    }
}

TEST(TomlFormat, ShippedLensesAndTheirTextAreTheSame) {
    for (const ShippedLens& shipped : shipped_lenses()) {
        const Prescription lens = shipped_lens(shipped.id);
        EXPECT_EQ(parse_toml(to_toml(lens), "file"), lens) << shipped.id;
    }
}

TEST(TomlFormat, WarningsAreNotWritten) {
    Prescription lens = parse_toml(kTripletToml, "file");
    const std::string text = to_toml(lens);
    lens.warnings.push_back("surface 3: mended");
    EXPECT_EQ(to_toml(lens), text);
}

TEST(TomlFormat, ReadsEveryField) {
    const Prescription lens = parse_toml(R"(
name = "n"
patent = "p"
source = "s"
missing = "m"
focal_length_mm = 50
f_number = 2
field_deg = 40.5
[[surface]]
radius_mm = 30
thickness_mm = 3
index = 1.6
abbe = 40
semi_aperture_mm = 9
profile = "cylinder-y"
coating = "none"
[[surface]]
radius_mm = -3.0e1
thickness_mm = 0
semi_aperture_mm = 8
conic = -1
asphere = [1e-5, 0, -2]
profile = "cylinder-x"
[[surface]]
thickness_mm = 30
semi_aperture_mm = 7
stop = true
profile = "rotational"
[[position]]
name = "near"
focal_length_mm = 60
f_number = 3
field_deg = 30
gaps = [{ surface = 2, thickness_mm = 5 }]
)",
                                         "file");
    Prescription expected;
    expected.name = "n";
    expected.patent = "p";
    expected.source = "s";
    expected.missing = "m";
    expected.focal_length_mm = 50;
    expected.f_number = 2;
    expected.field_deg = 40.5;
    expected.surfaces.resize(3);
    Surface& first = expected.surfaces[0];
    first.radius_mm = 30;
    first.thickness_mm = 3;
    first.index = 1.6;
    first.abbe = 40;
    first.semi_aperture_mm = 9;
    first.profile = Profile::kCylinderY;
    first.coating = "none";
    Surface& second = expected.surfaces[1];
    second.radius_mm = -30;
    second.semi_aperture_mm = 8;
    second.conic = -1;
    second.asphere = {1e-5, 0, -2};
    second.profile = Profile::kCylinderX;
    Surface& third = expected.surfaces[2];
    third.thickness_mm = 30;
    third.semi_aperture_mm = 7;
    third.stop = true;
    expected.positions = {{"near", 60, 3, 30, {{2, 5.0}}}};
    EXPECT_EQ(lens, expected);
}

TEST(TomlFormat, AGlassBringsItsIndexAndAbbeNumber) {
    const Prescription lens = parse_toml(kTripletToml, "file");
    EXPECT_EQ(lens.surfaces[0].index, find_glass("N-SK16")->index_d());
    EXPECT_EQ(lens.surfaces[0].abbe, find_glass("N-SK16")->abbe());
    // An index beside it is that of the melt, and stays.
    const auto melt = with(kTripletToml, "glass = \"F2\"", "glass = \"F2\"\nindex = 1.6202");
    EXPECT_EQ(parse_toml(melt, "file").surfaces[2].index, 1.6202);
}

TEST(TomlFormat, WhatIsWrongIsNamedWithFileLineSurfaceAndWhatIsAllowed) {
    const Spoilt cases[] = {
        {"radius_mm = 20.2919",
         "radius_mm = \"20.3\"",
         {"line 23: surface 4: ", "radius_mm is a string", "number"}},
        {"radius_mm = 20.2919", "radius_mm = nan", {"line 23: surface 4: ", "= nan", "finite"}},
        {"radius_mm = 20.2919", "radius_mm = -inf", {"line 23: surface 4: ", "= -inf", "finite"}},
        {"radius_mm = 20.2919",
         "radius = 20.2919",
         {"surface 4: ", "unknown key \"radius\"", "radius_mm"}},
        {"radius_mm = 20.2919", "radius_mm = 1e999", {"line 23"}},
        {"thickness_mm = 3.259\n", "", {"line 5: surface 1: thickness_mm is missing"}},
        {"semi_aperture_mm = 7.5\n", "", {"surface 6: semi_aperture_mm is missing"}},
        {"stop = true\n", "", {"stops = 0", "must be 1"}},
        {"stop = true", "stop = 1", {"surface 5: stop is a number", "true or false"}},
        {"glass = \"F2\"", "glass = \"F2\"\nstop = true", {"stops", "= 2"}},
        {"glass = \"F2\"", "glass = \"XYZ\"", {"line 19: surface 3: glass = XYZ", "catalogue"}},
        {"glass = \"F2\"", "glass = 2", {"surface 3: glass is a number", "string"}},
        {"glass = \"F2\"", "index = 0", {"surface 3: index = 0", "[1, 5]"}},
        {"glass = \"F2\"", "glass = \"F2\"\nindex = 1.9", {"surface 3: index = 1.9", "F2"}},
        {"thickness_mm = 6.0076", "thickness_mm = -6.0076", {"surface 2", "-6.0076", "negative"}},
        {"conic = -0.125", "conic = [1]", {"surface 7: conic is a list", "number"}},
        {"asphere = [0.0, 2e-8]", "asphere = 3", {"surface 7: asphere is a number", "list"}},
        {"asphere = [0.0, 2e-8]", "asphere = [0, \"a\"]", {"surface 7: asphere is a string"}},
        {"asphere = [0.0, 2e-8]", "asphere = [0,0,0,0,0,0,0,0]", {"surface 7", "= 8", "at most 7"}},
        {"asphere = [0.0, 2e-8]",
         "profile = \"toric\"",
         {"surface 7: profile = toric", "cylinder-x"}},
        {"name = \"Triplet\"", "name = 3", {"line 1: name is a number", "string"}},
        {"name = \"Triplet\"", "title = \"Triplet\"", {"line 1: unknown key \"title\"", "name"}},
        {"name = \"Triplet\"", "position = 3", {"position is a number", "list of tables"}},
        {"name = \"Triplet\"", "position = [{ focal_length_mm = 3 }]", {"name", "empty"}},
        {"name = \"Triplet\"",
         "position = [{ name = \"x\" }]",
         {"position 1: focal_length_mm is missing"}},
        {"name = \"Triplet\"",
         "position = [{ name = \"x\", focal_length_mm = 3, gaps = [{ surface = 2.5, "
         "thickness_mm = 1 }] }]",
         {"position \"x\"", "1 to 7"}},
        {"name = \"Triplet\"",
         "position = [{ name = \"x\", focal_length_mm = 3, gaps = [{ surface = 1e300, "
         "thickness_mm = 1 }] }]",
         {"position \"x\"", "1 to 7"}},
        {"name = \"Triplet\"",
         "position = [{ name = \"x\", focal_length_mm = 3, gaps = [{ surface = 2 }] }]",
         {"position 1: gaps 1: thickness_mm is missing"}},
        {"[[surface]]", "[surface]", {"line"}},
        {"[[surface]]", "[#surface]]", {"line 5: line = [#surface]]", "name"}},
        {"[[surface]]", " [[ \xC3\xBC]]", {"line 5: line =  [[ ??]]", "name"}},
        {"[[surface]]", "[", {"line 5", "name"}},
        {"f_number = 5.0", "f_number = ", {"line 2", "no TOML"}},
        {"f_number = 5.0", "f_number = 5.0\nf_number = 4.0", {"line 3", "no TOML"}},
        {"f_number = 5.0", "f_number = -5.0", {"f_number = -5", "positive"}},
    };
    ASSERT_EQ(refusal(parse_toml, kTripletToml), "accepted");
    for (const Spoilt& c : cases) {
        SCOPED_TRACE(c.to);
        const std::string message = refusal(parse_toml, with(kTripletToml, c.from, c.to));
        EXPECT_THAT(message, testing::StartsWith("some/file.ext: "));
        for (const std::string& part : c.said) EXPECT_THAT(message, HasSubstr(part));
    }
}

TEST(TomlFormat, FilesThatAreNoTables) {
    EXPECT_THAT(refusal(parse_toml, ""), HasSubstr("empty"));
    EXPECT_THAT(refusal(parse_toml, "\n\n"), HasSubstr("surfaces = 0"));
    EXPECT_THAT(refusal(parse_toml, std::string(100, '\0')), HasSubstr("no TOML"));
    EXPECT_THAT(refusal(parse_toml, "\xFF\xFE\xFD"), HasSubstr("no TOML"));
    EXPECT_THAT(refusal(parse_toml, std::string(100000, '[')), HasSubstr("name"));
    EXPECT_THAT(refusal(parse_toml, "a = " + std::string(100000, '[')), HasSubstr("no TOML"));
    EXPECT_THAT(refusal(parse_toml, "a" + std::string(100000, '.')), HasSubstr("no TOML"));
    EXPECT_THAT(refusal(parse_toml, std::string(5 << 20, ' ')), HasSubstr("5242880 bytes"));
    std::string long_lens(kTripletToml);
    for (int i = 0; i < 10000; ++i) {
        long_lens += "[[surface]]\nthickness_mm = 1\nsemi_aperture_mm = 1\n";
    }
    EXPECT_THAT(refusal(parse_toml, long_lens), HasSubstr("surfaces = 10007: must be 2 to 1000"));
}

}  // namespace
}  // namespace aureole::lens
