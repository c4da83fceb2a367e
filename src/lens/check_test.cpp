// What is said of doubtful tables, and what is not said of sound ones.
#include "aureole/lens/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "aureole/base/error.h"
#include "aureole/lens/formats.h"
#include "aureole/lens/library.h"
#include "lens/format_fixtures.h"

namespace aureole::lens {
namespace {

using Kind = Finding::Kind;
using testing::HasSubstr;

// A triplet of which nothing is doubtful: its stop solved for f/5, as docs/lenses.md does.
Prescription sound() {
    Prescription lens = parse_toml(kTripletToml, "triplet.toml");
    lens.surfaces[4].semi_aperture_mm = 3.81;
    lens.surfaces[6].conic = 0;
    lens.surfaces[6].asphere.clear();
    lens.focal_length_mm = 50;
    return lens;
}

std::vector<Kind> kinds(const Prescription& lens) {
    std::vector<Kind> found;
    for (const Finding& finding : check(lens)) found.push_back(finding.kind);
    return found;
}

const Finding* find(const std::vector<Finding>& findings, Kind kind) {
    const auto it = std::find_if(findings.begin(), findings.end(),
                                 [&](const Finding& f) { return f.kind == kind; });
    return it == findings.end() ? nullptr : &*it;
}

TEST(Check, SaysNothingOfASoundTable) {
    for (const Finding& finding : check(sound())) ADD_FAILURE() << finding.text;
}

struct Case {
    std::function<void(Prescription&)> spoil;
    Kind kind;
    int surface;
    std::vector<std::string> said;
};

TEST(Check, EveryKindIsFoundWhereItIs) {
    const Case cases[] = {
        {[](auto& p) { p.focal_length_mm = 51.5; }, Kind::kFocalLength, 0, {"50.02", "51.5"}},
        {[](auto& p) { p.surfaces[4].semi_aperture_mm = 3.4; },
         Kind::kFNumber,
         5,
         {"3.4 mm", "f/5.6", "f/5", "3.83 mm"}},
        {[](auto& p) { p.surfaces[4].semi_aperture_mm = 5; },
         Kind::kFNumber,
         5,
         {"f/3.81", "housing"}},
        {[](auto& p) { p.surfaces[0].semi_aperture_mm = 23; },
         Kind::kSemiAperture,
         1,
         {"23 mm", "22.01"}},
        // The biconvex front lens of 3.3 mm would need more glass for a height of 13 mm.
        {[](auto& p) {
             p.surfaces[0].semi_aperture_mm = 13;
             p.surfaces[1].semi_aperture_mm = 13;
         },
         Kind::kCrossing,
         1,
         {"surface 2", "13 and 13"}},
        {[](auto& p) {
             p.surfaces[2].glass = "";
             p.surfaces[2].abbe = 0;
         },
         Kind::kNoDispersion,
         3,
         {"surface 3"}},
        {[](auto& p) { p.surfaces[6].thickness_mm = 44; }, Kind::kBackFocus, 7, {"44", "42.4"}},
        {[](auto& p) { p.surfaces[5].semi_aperture_mm = 4; }, Kind::kTooDark, 6, {"4 mm", "f/5"}},
        {[](auto& p) { p.warnings = {"surface 2: mended"}; }, Kind::kParser, 0, {"mended"}},
        {[](auto& p) {
             for (Surface& s : p.surfaces) s.semi_aperture_mm *= 2;
         },
         Kind::kDiameters,
         0,
         {"f/2.5", "half"}},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(name_of(c.kind));
        Prescription lens = sound();
        c.spoil(lens);
        const auto findings = check(lens);
        const Finding* finding = find(findings, c.kind);
        ASSERT_NE(finding, nullptr);
        EXPECT_EQ(finding->surface, c.surface);
        for (const std::string& part : c.said) EXPECT_THAT(finding->text, HasSubstr(part));
    }
}

TEST(Check, StaysSilentWithinItsTolerances) {
    for (const auto& change : std::initializer_list<std::function<void(Prescription&)>>{
             [](auto& p) { p.focal_length_mm = 50.95; },
             [](auto& p) { p.surfaces[4].semi_aperture_mm = 3.65; },
             [](auto& p) { p.surfaces[6].thickness_mm = 43.4; },
             [](auto& p) { p.surfaces[6].thickness_mm = 0; },  // not printed
             [](auto& p) { p.focal_length_mm = p.f_number = 0; }}) {
        Prescription lens = sound();
        change(lens);
        EXPECT_THAT(kinds(lens), testing::IsEmpty());
    }
}

TEST(Check, DiametersReadAsRadiiAreFoundInEveryShippedLens) {
    for (const ShippedLens& shipped : shipped_lenses()) {
        SCOPED_TRACE(shipped.id);
        const Prescription table = shipped_lens(shipped.id);
        std::vector<std::string> names = {""};
        for (const Position& position : table.positions) names.push_back(position.name);
        for (const std::string& name : names) {
            Prescription lens = at_position(table, name);
            EXPECT_THAT(kinds(lens), testing::Not(testing::Contains(Kind::kDiameters)));
            for (Surface& s : lens.surfaces) s.semi_aperture_mm *= 2;
            // A singlet without a stated f-number gives nothing to go by.
            if (shipped.id != "biconvex") {
                EXPECT_THAT(kinds(lens), testing::Contains(Kind::kDiameters));
            }
        }
    }
}

// The blog's own numbers: 28 mm f/2.8 is an effective aperture of 10 mm and a stop
// of about 22 mm diameter; the table prints 9 mm, which is f/3.44 near the axis.
TEST(Check, ExplainsTheDoubtAboutTheNikonsFNumber) {
    const auto findings = check(shipped_lens("nikon-28-75"));
    const Finding* finding = find(findings, Kind::kFNumber);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->surface, 15);
    for (const char* part : {"semi-aperture 9 mm", "f/3.49 (paraxially f/3.44)", "stated f/2.8",
                             "effective aperture of 10 mm", "diameter of 21.9 mm"}) {
        EXPECT_THAT(finding->text, HasSubstr(part));
    }
    EXPECT_NE(find(findings, Kind::kFocalLength), nullptr);
}

TEST(Check, AZoomIsCheckedAtItsPosition) {
    const Prescription zoom = shipped_lens("itoh-zoom");
    EXPECT_EQ(find(check(at_position(zoom, "short")), Kind::kBackFocus), nullptr);
    // The back gap of the file is that of the short end.
    const auto findings = check(at_position(zoom, "long"));
    const Finding* finding = find(findings, Kind::kBackFocus);
    ASSERT_NE(finding, nullptr);
    EXPECT_THAT(finding->text, HasSubstr("149.674"));
}

TEST(Check, RefusesWhatIsNoLens) {
    Prescription lens = sound();
    lens.surfaces[1].index = 0;
    EXPECT_THROW(check(lens), InvalidArgument);
    Prescription window = sound();
    for (Surface& s : window.surfaces) s.radius_mm = 0;
    EXPECT_THROW(check(window), InvalidArgument);
}

}  // namespace
}  // namespace aureole::lens
