// The catalogue against the numbers that the makers print beside the coefficients.
#include "aureole/lens/glass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace aureole::lens {
namespace {

// n_d and V_d as printed in the data sheets, typed apart from the coefficients. CaF2 and fused
// silica: of Malitson's papers, at 24 and 20 deg C.
constexpr struct {
    const char* name;
    double index_d;
    double abbe;
} kDataSheets[] = {
    {"CAF2", 1.43384, 95.0},          {"F2", 1.62004, 36.37},       {"F5", 1.60342, 38.03},
    {"FUSED-SILICA", 1.45846, 67.82}, {"LF5", 1.58144, 40.85},      {"LLF1", 1.54814, 45.75},
    {"N-BAF10", 1.67003, 47.11},      {"N-BAF4", 1.60568, 43.72},   {"N-BAK1", 1.57250, 57.55},
    {"N-BAK2", 1.53996, 59.71},       {"N-BAK4", 1.56883, 55.98},   {"N-BALF4", 1.57956, 53.87},
    {"N-BASF64", 1.70400, 39.38},     {"N-BK10", 1.49782, 66.95},   {"N-BK7", 1.51680, 64.17},
    {"N-F2", 1.62005, 36.43},         {"N-FK5", 1.48749, 70.41},    {"N-FK51A", 1.48656, 84.47},
    {"N-K5", 1.52249, 59.48},         {"N-KZFS4", 1.61336, 44.49},  {"N-LAF2", 1.74397, 44.85},
    {"N-LAK10", 1.72003, 50.62},      {"N-LAK12", 1.67790, 55.20},  {"N-LAK14", 1.69680, 55.41},
    {"N-LAK21", 1.64049, 60.10},      {"N-LAK22", 1.65113, 55.89},  {"N-LAK7", 1.65160, 58.52},
    {"N-LAK8", 1.71300, 53.83},       {"N-LAK9", 1.69100, 54.71},   {"N-LASF40", 1.83404, 37.30},
    {"N-LASF41", 1.83501, 43.13},     {"N-LASF43", 1.80610, 40.61}, {"N-LASF44", 1.80420, 46.50},
    {"N-LASF45", 1.80107, 34.97},     {"N-LASF9", 1.85025, 32.17},  {"N-PK51", 1.52855, 76.98},
    {"N-PK52A", 1.49700, 81.61},      {"N-PSK53A", 1.61800, 63.39}, {"N-SF1", 1.71736, 29.62},
    {"N-SF10", 1.72828, 28.53},       {"N-SF11", 1.78472, 25.68},   {"N-SF14", 1.76182, 26.53},
    {"N-SF15", 1.69892, 30.20},       {"N-SF4", 1.75513, 27.38},    {"N-SF5", 1.67271, 32.25},
    {"N-SF57", 1.84666, 23.78},       {"N-SF6", 1.80518, 25.36},    {"N-SF8", 1.68894, 31.31},
    {"N-SK14", 1.60311, 60.60},       {"N-SK16", 1.62041, 60.32},   {"N-SK2", 1.60738, 56.65},
    {"N-SK4", 1.61272, 58.63},        {"N-SK5", 1.58913, 61.27},    {"N-SSK2", 1.62229, 53.27},
    {"N-SSK5", 1.65844, 50.88},       {"N-SSK8", 1.61773, 49.83},   {"S-FPL51", 1.49700, 81.54},
    {"S-FPL53", 1.43875, 94.93},      {"S-LAH66", 1.77250, 49.60},  {"S-TIH53", 1.84666, 23.78},
    {"SF1", 1.71736, 29.51},          {"SF10", 1.72825, 28.41},     {"SF11", 1.78472, 25.76},
    {"SF2", 1.64769, 33.85},          {"SF5", 1.67270, 32.21},      {"SF57", 1.84666, 23.83},
    {"SF6", 1.80518, 25.43},
};

TEST(Glass, FormulasGiveTheIndexAndAbbeNumberOfTheDataSheets) {
    EXPECT_EQ(glass_catalogue().size(), std::size(kDataSheets));
    for (const auto& sheet : kDataSheets) {
        SCOPED_TRACE(sheet.name);
        const Glass* glass = find_glass(sheet.name);
        ASSERT_NE(glass, nullptr);
        // Half a unit of the fifth decimal, and what rounding leaves.
        EXPECT_NEAR(glass->index_d(), sheet.index_d, 1e-5);
        EXPECT_NEAR(glass->abbe(), sheet.abbe, 0.02);
    }
}

TEST(Glass, IndexFallsWithTheWavelengthOverTheVisible) {
    for (const Glass& glass : glass_catalogue()) {
        SCOPED_TRACE(glass.name);
        for (double nm = 380; nm < 780; nm += 5) {
            EXPECT_GT(glass.index(nm), glass.index(nm + 5));
            EXPECT_GT(glass.index(nm + 5), 1.3);
        }
    }
}

TEST(Glass, CatalogueIsSortedAndNamesItsSources) {
    std::string last;
    for (const Glass& glass : glass_catalogue()) {
        EXPECT_LT(last, glass.name);
        EXPECT_FALSE(glass.source.empty()) << glass.name;
        last = glass.name;
    }
}

TEST(Glass, IsFoundByAnyLettersAndByItsOldName) {
    EXPECT_EQ(find_glass("n-bk7"), find_glass("N-BK7"));
    EXPECT_EQ(find_glass("BK7"), find_glass("N-BK7"));
    EXPECT_EQ(find_glass("bk7"), find_glass("N-BK7"));
    EXPECT_EQ(find_glass("SILICA"), find_glass("FUSED-SILICA"));
    // Where both are made, the plain name is the leaded glass.
    EXPECT_NE(find_glass("SF6"), find_glass("N-SF6"));
    EXPECT_EQ(find_glass("SF6")->name, "SF6");
    for (const char* unknown : {"", "N-", "-BK7", "BK", "N-BK77", "N-N-BK7"}) {
        EXPECT_EQ(find_glass(unknown), nullptr) << unknown;
    }
}

TEST(Glass, CauchyPassesThroughTheIndexWithTheSlopeOfTheAbbeNumber) {
    for (const double index : {1.45, 1.62, 1.9}) {
        for (const double abbe : {20.0, 36.37, 95.0}) {
            EXPECT_DOUBLE_EQ(cauchy_index(index, abbe, kLineDNm), index);
            const double slope =
                cauchy_index(index, abbe, kLineFNm) - cauchy_index(index, abbe, kLineCNm);
            EXPECT_NEAR((index - 1) / slope, abbe, 1e-9);
            // A + B / lambda^2: linear in 1 / lambda^2.
            const auto at = [&](double per_nm2) {
                return cauchy_index(index, abbe, 1 / std::sqrt(per_nm2));
            };
            EXPECT_NEAR(at(2e-6) + at(4e-6), 2 * at(3e-6), 1e-12);
        }
        EXPECT_EQ(cauchy_index(index, 0, 400), index);
    }
    // Air has no slope, whatever Abbe number a table prints for it.
    EXPECT_EQ(cauchy_index(1, 89.3, 400), 1);
}

// Two constants cannot follow a real glass exactly: how far apart the two ways are.
TEST(Glass, CauchyIsNearSellmeierOverTheVisible) {
    for (const Glass& glass : glass_catalogue()) {
        SCOPED_TRACE(glass.name);
        for (double nm = 420; nm <= 700; nm += 10) {
            EXPECT_NEAR(cauchy_index(glass.index_d(), glass.abbe(), nm), glass.index(nm), 6e-3);
        }
    }
}

}  // namespace
}  // namespace aureole::lens
