#include "ibl/gauss_legendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aureole::ibl {
namespace {

TEST(GaussLegendre, IsExactForPolynomialsAndNoFurther) {
    for (const int points : {1, 2, 3, 4, 5, 24, 48}) {
        const GaussRule rule = gauss_legendre(points);
        ASSERT_EQ(rule.points(), points);
        const auto integral = [&](int power) {
            double sum = 0;
            for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
                sum += rule.weights[i] * std::pow(rule.nodes[i], power);
            }
            return sum;
        };
        for (int power = 0; power < 2 * points; ++power) {
            EXPECT_NEAR(integral(power), power % 2 == 0 ? 2.0 / (power + 1) : 0, 1e-13) << points;
        }
        if (points < 6) {
            EXPECT_LT(integral(2 * points), 2.0 / (2 * points + 1) - 1e-3);
        }
    }
}

}  // namespace
}  // namespace aureole::ibl
