// The lenses that come with Aureole against the checked reference table.
#include "aureole/lens/library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/lens/formats.h"
#include "aureole/lens/glass.h"
#include "aureole/lens/lens.h"
#include "aureole/lens/paraxial.h"

namespace aureole::lens {
namespace {

// Typed from the reference: paraxial at the d line; f-number from the printed stop; refracting
// faces, and pairs of them.
constexpr struct {
    const char* id;
    const char* position;
    double efl_mm;
    double bfd_mm;
    double printed_f_number;
    int rows;
    int stop_row;
    int pairs;
} kReference[] = {
    {"heliar", "", 99.236, 81.315, 3.43, 9, 6, 28},
    {"nikon-28-75", "", 28.900, 39.682, 3.44, 28, 15, 351},
    {"canon-70-200", "wide", 72.118, 52.446, 2.40, 34, 25, 528},
    {"canon-70-200", "mid", 134.948, 52.429, 2.40, 34, 25, 528},
    {"canon-70-200", "tele", 193.910, 52.421, 2.40, 34, 25, 528},
    {"tessar", "", 99.996, 79.809, 2.73, 8, 4, 21},
    {"biotar", "", 99.913, 65.329, 1.44, 11, 6, 45},
    {"ektar", "", 100.355, 82.126, 4.48, 9, 6, 28},
    {"angenieux-double-gauss", "", 99.940, 55.977, 1.14, 15, 8, 91},
    {"double-gauss", "", 50.007, 35.722, 2.01, 11, 6, 45},
    {"fisheye", "", 9.991, 23.161, 3.95, 12, 7, 55},
    {"cooke-triplet", "", 50.021, 42.436, 3.81, 7, 5, 15},
    {"nikon-retrofocus", "", 100.059, 130.848, 2.64, 15, 9, 91},
    {"canon-14", "", 14.279, 36.301, 2.12, 26, 18, 300},
    {"itoh-zoom", "short", 99.918, 149.458, 3.45, 19, 9, 153},
    {"itoh-zoom", "long", 145.726, 189.530, 4.01, 19, 9, 153},
    {"sonnar", "", 49.765, 22.266, 1.46, 11, 7, 45},
    {"summicron-r", "", 52.016, 37.356, 2.01, 11, 6, 45},
    {"canon-35-135", "", 36.020, 42.125, 3.58, 30, 14, 406},
    {"canon-28-80", "", 28.969, 37.724, 3.39, 21, 11, 190},
    {"biconvex", "", 49.808, 48.064, 1.96, 3, 1, 1},
};

TEST(ShippedLenses, FocalLengthAndBackFocusAreThoseOfTheReference) {
    for (const auto& row : kReference) {
        SCOPED_TRACE(std::string(row.id) + " " + row.position);
        const Lens lens(shipped_lens(row.id), {.position = row.position});
        const CardinalPoints points = cardinal_points(lens, kLineDNm);
        // The reference prints three decimals.
        EXPECT_NEAR(points.efl_mm, row.efl_mm, 0.0015);
        EXPECT_NEAR(points.bfd_mm, row.bfd_mm, 0.0015);
        const double printed_stop =
            lens.prescription().surfaces[static_cast<std::size_t>(lens.stop())].semi_aperture_mm;
        EXPECT_NEAR(points.f_number * lens.stop_radius_mm() / printed_stop, row.printed_f_number,
                    0.0051);
    }
}

TEST(ShippedLenses, RowsStopsAndPairsAreThoseOfTheReference) {
    for (const auto& row : kReference) {
        SCOPED_TRACE(row.id);
        const Prescription lens = shipped_lens(row.id);
        ASSERT_EQ(lens.surfaces.size(), static_cast<std::size_t>(row.rows));
        EXPECT_TRUE(lens.surfaces[static_cast<std::size_t>(row.stop_row) - 1].stop);
        const int faces = row.rows - 1;
        EXPECT_EQ(faces * (faces - 1) / 2, row.pairs);
    }
}

TEST(ShippedLenses, AllOfTheReferenceAreThereInAlphabeticalOrder) {
    const auto lenses = shipped_lenses();
    EXPECT_EQ(lenses.size(), 18u);
    EXPECT_TRUE(
        std::is_sorted(lenses.begin(), lenses.end(), [](auto& a, auto& b) { return a.id < b.id; }));
    for (const ShippedLens& lens : lenses) {
        const auto is_it = [&](const auto& row) { return row.id == lens.id; };
        EXPECT_TRUE(std::any_of(std::begin(kReference), std::end(kReference), is_it)) << lens.id;
    }
}

TEST(ShippedLenses, EachSaysWhatItIsAndWhereItsNumbersAreFrom) {
    for (const ShippedLens& shipped : shipped_lenses()) {
        SCOPED_TRACE(shipped.id);
        const Prescription lens = shipped_lens(shipped.id);
        EXPECT_FALSE(lens.name.empty());
        EXPECT_FALSE(lens.source.empty());
        EXPECT_GT(lens.focal_length_mm, 0);
        EXPECT_TRUE(lens.warnings.empty());
        // What has no Abbe numbers says so.
        const bool undispersed = std::any_of(
            lens.surfaces.begin(), lens.surfaces.end(),
            [](const Surface& s) { return s.index != 1 && s.abbe == 0 && s.glass.empty(); });
        EXPECT_EQ(undispersed, lens.missing.find("Abbe") != std::string::npos);
    }
}

TEST(ShippedLenses, AnUnknownNameIsToldWithThoseNearIt) {
    const auto message = [](std::string_view id) -> std::string {
        try {
            shipped_lens(id);
        } catch (const InvalidArgument& error) {
            return error.what();
        }
        return "found";
    };
    EXPECT_THAT(message("helair"), testing::HasSubstr("lens = helair: "));
    EXPECT_THAT(message("helair"), testing::HasSubstr("heliar"));
    EXPECT_THAT(message("nikon"), testing::HasSubstr("nikon-28-75, nikon-retrofocus"));
    EXPECT_THAT(message("HELIAR"), testing::HasSubstr("near this name"));
    EXPECT_THAT(message(""), testing::HasSubstr("near this name"));
    EXPECT_THAT(message(std::string(100000, 'x')), testing::HasSubstr("near this name"));
}

}  // namespace
}  // namespace aureole::lens
