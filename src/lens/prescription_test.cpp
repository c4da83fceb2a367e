// Which tables are accepted, what is said of the others, and the positions of a zoom.
#include "aureole/lens/prescription.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "aureole/base/error.h"
#include "aureole/lens/formats.h"
#include "lens/format_fixtures.h"

namespace aureole::lens {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Prescription triplet() { return parse_toml(kTripletToml, "triplet.toml"); }

Prescription zoom() {
    Prescription lens = triplet();
    lens.positions = {{"wide", 50, 5, 40, {{2, 6.0}, {5, 4.5}}},
                      {"tele", 60, 5.6, 33, {{2, 7.0}, {7, -1.0}}}};
    return lens;
}

std::string refusal(const Prescription& lens) {
    try {
        validate(lens);
    } catch (const InvalidArgument& error) {
        return error.what();
    }
    return "accepted";
}

struct Case {
    std::function<void(Prescription&)> spoil;
    std::vector<std::string> said;  // surface, value, and what is allowed
};

TEST(Prescription, WhatIsRefusedIsNamedWithSurfaceValueAndWhatIsAllowed) {
    const Case cases[] = {
        {[](auto& p) { p.surfaces.clear(); }, {"surfaces = 0", "2 to 1000"}},
        {[](auto& p) { p.surfaces.resize(10000, p.surfaces[0]); }, {"= 10000", "2 to 1000"}},
        {[](auto& p) { p.surfaces[4].stop = false; }, {"stops = 0", "must be 1"}},
        {[](auto& p) { p.surfaces[1].stop = true; }, {"surfaces 2 and 5", "= 2", "must be 1"}},
        {[](auto& p) { p.surfaces[4].radius_mm = 30; }, {"surface 5", "= 30", "flat"}},
        {[](auto& p) { p.surfaces[4].conic = -1; }, {"surface 5", "flat"}},
        {[](auto& p) { p.surfaces[4].index = 1.3; }, {"surface 5", "= 1.3", "in front"}},
        {[](auto& p) { p.surfaces[0].index = 0; }, {"surface 1: index = 0", "[1, 5]"}},
        {[](auto& p) { p.surfaces[1].index = 0.9; }, {"surface 2: index = 0.9", "[1, 5]"}},
        {[](auto& p) { p.surfaces[1].index = 6; }, {"surface 2: index = 6", "[1, 5]"}},
        {[](auto& p) { p.surfaces[1].index = kNan; }, {"surface 2: index = nan", "[1, 5]"}},
        {[](auto& p) { p.surfaces[0].index = 1.7; }, {"surface 1: index = 1.7", "N-SK16"}},
        {[](auto& p) { p.surfaces[0].glass = "XK9"; }, {"surface 1: glass = XK9", "catalogue"}},
        {[](auto& p) { p.surfaces[2].abbe = 2; }, {"surface 3: abbe = 2", "[5, 150]"}},
        {[](auto& p) { p.surfaces[2].abbe = -40; }, {"surface 3: abbe = -40", "[5, 150]"}},
        {[](auto& p) { p.surfaces[2].abbe = kNan; }, {"surface 3: abbe = nan"}},
        {[](auto& p) { p.surfaces[2].thickness_mm = -1; }, {"surface 3", "= -1", "negative"}},
        {[](auto& p) { p.surfaces[2].thickness_mm = kInfinity; }, {"surface 3", "= inf"}},
        {[](auto& p) { p.surfaces[6].thickness_mm = kNan; }, {"surface 7", "= nan", "finite"}},
        {[](auto& p) { p.surfaces[1].radius_mm = kNan; }, {"surface 2", "radius_mm = nan"}},
        {[](auto& p) { p.surfaces[1].semi_aperture_mm = 0; }, {"surface 2", "= 0", "positive"}},
        {[](auto& p) { p.surfaces[1].semi_aperture_mm = -3; }, {"surface 2", "= -3"}},
        {[](auto& p) { p.surfaces[1].semi_aperture_mm = kNan; }, {"surface 2", "= nan"}},
        {[](auto& p) { p.surfaces[1].conic = kInfinity; }, {"surface 2", "conic = inf"}},
        {[](auto& p) {
             p.surfaces[1].asphere = {0, kNan};
         },
         {"surface 2", "asphere = nan"}},
        {[](auto& p) { p.surfaces[1].asphere.resize(8); }, {"surface 2", "= 8", "at most 7"}},
        {[](auto& p) { p.surfaces[6].index = 1.5; }, {"surface", "= 1.5", "air"}},
        {[](auto& p) { p.focal_length_mm = -50; }, {"focal_length_mm = -50", "positive"}},
        {[](auto& p) { p.f_number = kNan; }, {"f_number = nan", "positive"}},
        {[](auto& p) { p.field_deg = 360; }, {"field_deg = 360", "(0, 360)"}},
    };
    ASSERT_EQ(refusal(triplet()), "accepted");
    for (const Case& c : cases) {
        Prescription lens = triplet();
        c.spoil(lens);
        const std::string message = refusal(lens);
        for (const std::string& part : c.said) EXPECT_THAT(message, HasSubstr(part));
    }
}

TEST(Prescription, PositionsAreHeldToTheirLens) {
    const Case cases[] = {
        {[](auto& p) { p.positions[1].name = ""; }, {"name", "empty"}},
        {[](auto& p) { p.positions[1].name = "wide"; }, {"wide", "once"}},
        {[](auto& p) { p.positions[1].focal_length_mm = 0; }, {"\"tele\"", "= 0", "positive"}},
        {[](auto& p) { p.positions[1].f_number = -2; }, {"\"tele\"", "= -2"}},
        {[](auto& p) { p.positions[1].field_deg = kNan; }, {"\"tele\"", "= nan"}},
        {[](auto& p) { p.positions[0].gaps[0].surface = 0; }, {"\"wide\"", "= 0", "1 to 7"}},
        {[](auto& p) { p.positions[0].gaps[0].surface = 8; }, {"\"wide\"", "= 8", "1 to 7"}},
        {[](auto& p) { p.positions[0].gaps[1].surface = 2; }, {"\"wide\"", "= 2", "once"}},
        {[](auto& p) { p.positions[0].gaps[0].thickness_mm = -1; }, {"surface 2", "= -1"}},
        {[](auto& p) { p.positions[1].gaps[1].thickness_mm = kNan; }, {"surface 7", "= nan"}},
    };
    ASSERT_EQ(refusal(zoom()), "accepted");
    for (const Case& c : cases) {
        Prescription lens = zoom();
        c.spoil(lens);
        const std::string message = refusal(lens);
        for (const std::string& part : c.said) EXPECT_THAT(message, HasSubstr(part));
    }
}

// A semi-aperture above the radius is clipped later, with a warning; no error.
TEST(Prescription, ASemiApertureAboveTheRadiusIsAccepted) {
    Prescription lens = triplet();
    lens.surfaces[0].semi_aperture_mm = 1000;
    EXPECT_EQ(refusal(lens), "accepted");
}

TEST(Prescription, APositionPutsItsGapsAndNumbersIn) {
    const Prescription lens = zoom();
    const Prescription tele = at_position(lens, "tele");
    EXPECT_TRUE(tele.positions.empty());
    EXPECT_EQ(tele.focal_length_mm, 60);
    EXPECT_EQ(tele.f_number, 5.6);
    EXPECT_EQ(tele.field_deg, 33);
    EXPECT_EQ(tele.surfaces[1].thickness_mm, 7);
    EXPECT_EQ(tele.surfaces[6].thickness_mm, -1);
    // Everything else is as printed, and not what another position says.
    Prescription rest = tele;
    rest.surfaces[1].thickness_mm = lens.surfaces[1].thickness_mm;
    rest.surfaces[6].thickness_mm = lens.surfaces[6].thickness_mm;
    EXPECT_EQ(rest.surfaces, lens.surfaces);
    EXPECT_EQ(at_position(lens, ""), at_position(lens, "wide"));
}

TEST(Prescription, APrimeIsItsOwnPosition) {
    EXPECT_EQ(at_position(triplet(), ""), triplet());
    EXPECT_EQ(at_position(at_position(zoom(), "tele"), ""), at_position(zoom(), "tele"));
}

TEST(Prescription, AnUnknownPositionIsToldWithThoseThereAre) {
    try {
        at_position(zoom(), "long");
        FAIL();
    } catch (const InvalidArgument& error) {
        EXPECT_THAT(error.what(), HasSubstr("position = long: must be one of wide, tele"));
    }
    EXPECT_THROW(at_position(triplet(), "wide"), InvalidArgument);
}

}  // namespace
}  // namespace aureole::lens
