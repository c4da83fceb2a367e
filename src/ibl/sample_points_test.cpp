#include "ibl/sample_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace aureole::ibl {
namespace {

// Every box of 2^a x 2^b equal boxes that share the square among 2^(a + b) holds one point.
void expect_net(const std::vector<SquarePoint>& points) {
    for (std::size_t columns = 1; columns <= points.size(); columns *= 2) {
        const std::size_t rows = points.size() / columns;
        std::set<std::size_t> boxes;
        for (const SquarePoint& point : points) {
            const auto column = static_cast<std::size_t>(point.x * static_cast<double>(columns));
            const auto row = static_cast<std::size_t>(point.y * static_cast<double>(rows));
            ASSERT_LT(column, columns);
            ASSERT_LT(row, rows);
            boxes.insert(row * columns + column);
        }
        EXPECT_EQ(boxes.size(), points.size()) << columns << " columns";
    }
}

TEST(SamplePoints, RadicalInverseMirrorsDigits) {
    EXPECT_EQ(radical_inverse(0), 0);
    EXPECT_EQ(radical_inverse(1), 0.5);
    EXPECT_EQ(radical_inverse(6), 3.0 / 8);
    EXPECT_EQ(radical_inverse(0x80000001U), 0.5 + 0x1p-32);
}

TEST(SamplePoints, HammersleysSetIsANet) {
    std::vector<SquarePoint> points;
    for (std::uint32_t i = 0; i < 64; ++i) points.push_back(hammersley(i, 64));
    expect_net(points);
}

TEST(SamplePoints, PartsOfHammersleysSetInOrderAreEven) {
    for (int digits = 1; digits <= 11; ++digits) {
        const std::uint32_t count = 1U << digits;
        const int half = digits / 2;
        std::vector<SquarePoint> points;
        std::set<std::uint32_t> indices;
        for (std::uint32_t place = 0; place < count; ++place) {
            indices.insert(hammersley_index(place, digits));
            points.push_back(hammersley(hammersley_index(place, digits), count));
        }
        EXPECT_EQ(indices.size(), count);
        EXPECT_LT(*indices.rbegin(), count);
        for (int a = 0; a <= half; ++a) {
            for (int b = 0; b <= half; ++b) {
                const std::uint32_t block = 1U << (a + b);
                for (std::uint32_t first = 0; first < count; first += block) {
                    std::set<std::uint32_t> boxes;
                    for (std::uint32_t i = first; i < first + block; ++i) {
                        boxes.insert((static_cast<std::uint32_t>(points[i].x * (1 << a)) << b) |
                                     static_cast<std::uint32_t>(points[i].y * (1 << b)));
                    }
                    ASSERT_EQ(boxes.size(), block) << digits << " " << a << " " << b;
                }
            }
        }
    }
}

// Kensler 2013, section 3: one point in each cell of the grid, each row and each column.
TEST(SamplePoints, MultiJitteredPointsAreStratified) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        for (const std::uint32_t side : {1U, 2U, 5U, 8U}) {
            const std::uint32_t count = side * side;
            std::set<std::uint32_t> cells;
            std::set<std::uint32_t> rows;
            std::set<std::uint32_t> columns;
            for (std::uint32_t i = 0; i < count; ++i) {
                const SquarePoint p = multi_jittered(i, count, seed);
                columns.insert(static_cast<std::uint32_t>(p.x * count));
                rows.insert(static_cast<std::uint32_t>(p.y * count));
                cells.insert(static_cast<std::uint32_t>(p.y * side) * side +
                             static_cast<std::uint32_t>(p.x * side));
            }
            EXPECT_EQ(columns.size(), count);
            EXPECT_EQ(rows.size(), count);
            EXPECT_EQ(cells.size(), count);
        }
    }
}

TEST(SamplePoints, MultiJitteredSetsOfAnySizeFillTheirRows) {
    for (const std::uint32_t count : {1U, 2U, 3U, 7U, 32U, 33U, 100U}) {
        std::set<std::uint32_t> rows;
        for (std::uint32_t i = 0; i < count; ++i) {
            const SquarePoint p = multi_jittered(i, count, 3);
            EXPECT_GE(p.x, 0);
            EXPECT_LT(p.x, 1);
            rows.insert(static_cast<std::uint32_t>(p.y * count));
        }
        EXPECT_EQ(rows.size(), count);
    }
}

// Over many seeds each point is anywhere with the same probability.
TEST(SamplePoints, MultiJitteredSetsDifferAndAreEvenOnTheWhole) {
    constexpr int kSeeds = 4000;
    constexpr int kBins = 8;
    std::vector<int> bins(kBins * kBins);
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
        const SquarePoint p = multi_jittered(5, 32, seed);
        ++bins[static_cast<std::size_t>(p.y * kBins) * kBins +
               static_cast<std::size_t>(p.x * kBins)];
    }
    double chi2 = 0;
    constexpr double kExpected = static_cast<double>(kSeeds) / (kBins * kBins);
    for (const int bin : bins) chi2 += (bin - kExpected) * (bin - kExpected) / kExpected;
    EXPECT_LT(chi2, 63 + 5 * std::sqrt(2 * 63.0));
}

}  // namespace
}  // namespace aureole::ibl
