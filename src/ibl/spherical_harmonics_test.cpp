#include "aureole/ibl/spherical_harmonics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/ibl/irradiance.h"
#include "ibl/test_environments.h"

namespace aureole::ibl {
namespace {

Direction random_direction(Random& random) {
    return normalized({random.normal(), random.normal(), random.normal()});
}

// The integral over the sphere of a function that is a polynomial of degree <= 9 in x, y and z: 5
// Gauss-Legendre heights and 16 azimuths are exact.
template <class Function>
double over_sphere(const Function& f) {
    constexpr double kHeights[5] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                    0.9061798459386640};
    constexpr double kWeights[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                    0.4786286704993665, 0.2369268850561891};
    double sum = 0;
    for (int j = 0; j < 5; ++j) {
        const double r = std::sqrt(1 - kHeights[j] * kHeights[j]);
        for (int i = 0; i < 16; ++i) {
            const double phi = 2 * kPi * i / 16;
            sum += kWeights[j] * f(Direction{r * std::cos(phi), r * std::sin(phi), kHeights[j]});
        }
    }
    return sum * 2 * kPi / 16;
}

TEST(SphericalHarmonics, AreOrthonormal) {
    for (std::size_t i = 0; i < kMostShCoefficients; ++i) {
        for (std::size_t k = 0; k <= i; ++k) {
            const double product =
                over_sphere([&](const Direction& d) { return sh_basis(d)[i] * sh_basis(d)[k]; });
            EXPECT_NEAR(product, i == k ? 1 : 0, 1e-12) << i << " " << k;
        }
    }
}

// The polynomials of Ramamoorthi & Hanrahan 2001, eq. 3, and of bands 3 and 4 as in Sloan 2008,
// appendix A2, without his signs.
TEST(SphericalHarmonics, AreThoseOfThePapers) {
    Random random(1);
    for (int i = 0; i < 20; ++i) {
        const Direction d = random_direction(random);
        const auto [x, y, z] = d;
        const double expected[kMostShCoefficients] = {
            .282095,
            .488603 * y,
            .488603 * z,
            .488603 * x,
            1.092548 * x * y,
            1.092548 * y * z,
            .315392 * (3 * z * z - 1),
            1.092548 * x * z,
            .546274 * (x * x - y * y),
            std::sqrt(70 / kPi) / 8 * y * (3 * x * x - y * y),
            std::sqrt(105 / kPi) / 2 * x * y * z,
            std::sqrt(42 / kPi) / 8 * y * (5 * z * z - 1),
            std::sqrt(7 / kPi) / 4 * z * (5 * z * z - 3),
            std::sqrt(42 / kPi) / 8 * x * (5 * z * z - 1),
            std::sqrt(105 / kPi) / 4 * z * (x * x - y * y),
            std::sqrt(70 / kPi) / 8 * x * (x * x - 3 * y * y),
            3 * std::sqrt(35 / kPi) / 4 * x * y * (x * x - y * y),
            3 * std::sqrt(70 / kPi) / 8 * y * z * (3 * x * x - y * y),
            3 * std::sqrt(5 / kPi) / 4 * x * y * (7 * z * z - 1),
            3 * std::sqrt(10 / kPi) / 8 * y * z * (7 * z * z - 3),
            3 / std::sqrt(kPi) / 16 * (35 * z * z * z * z - 30 * z * z + 3),
            3 * std::sqrt(10 / kPi) / 8 * x * z * (7 * z * z - 3),
            3 * std::sqrt(5 / kPi) / 8 * (x * x - y * y) * (7 * z * z - 1),
            3 * std::sqrt(70 / kPi) / 8 * x * z * (x * x - 3 * y * y),
            3 * std::sqrt(35 / kPi) / 16 *
                (x * x * (x * x - 3 * y * y) - y * y * (3 * x * x - y * y))};
        const auto basis = sh_basis(d);
        for (std::size_t k = 0; k < kMostShCoefficients; ++k) {
            EXPECT_NEAR(basis[k], expected[k], 2e-6) << k;
        }
    }
}

TEST(SphericalHarmonics, ProjectionOfAConstantIsExactAtAnySize) {
    for (const int size : {1, 2, 5, 17, 64, 90}) {
        const auto sh = project_to_sh(constant_environment(size, {1, 2, 3}), kMostShBands);
        EXPECT_NEAR(sh.coefficients[0][2], 3 * std::sqrt(4 * kPi), 1e-5);
        for (std::size_t k = 1; k < sh.coefficients.size(); ++k) {
            EXPECT_NEAR(sh.coefficients[k][1], 0, 1e-6) << size << " " << k;
        }
    }
}

// A single lit texel has nothing that averages errors out; against 200 x 200 points.
TEST(SphericalHarmonics, ProjectionIntegratesOverTexels) {
    constexpr int kPoints = 200;
    for (const int size : {1, 4, 20, 70}) {
        const int x = size / 3;
        const auto sh =
            project_to_sh(one_texel_environment(size, 5, x, 0, {0, 1, 0}), kMostShBands);
        std::array<double, kMostShCoefficients> sum = {};
        for (int j = 0; j < kPoints; ++j) {
            for (int i = 0; i < kPoints; ++i) {
                const double s = 2 * (x + (i + .5) / kPoints) / size - 1;
                const double t = 2 * (0 + (j + .5) / kPoints) / size - 1;
                const auto basis = sh_basis(direction_of({5, s, t}));
                const double weight =
                    std::pow(1 + s * s + t * t, -1.5) * 4 / (size * size * kPoints * kPoints);
                for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * basis[k];
            }
        }
        const double solid_angle_sr = texel_solid_angle_sr(x, 0, size);
        for (std::size_t k = 0; k < sum.size(); ++k) {
            EXPECT_NEAR(sh.coefficients[k][1] / solid_angle_sr, sum[k] / solid_angle_sr, 5e-5)
                << size << " " << k;
        }
    }
}

TEST(SphericalHarmonicsSlow, LargeMapsWithOnePointPerTexelAreLikeSmallOnes) {
    // Both maps are the same function: each texel of the small one is 16 x 16 of the large one.
    const CubeMap small = sun_environment(64);
    CubeMap large(64 * 16);
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < large.size(); ++y) {
            for (int c = 0; c < 3; ++c) {
                for (int x = 0; x < large.size(); ++x) {
                    large.at(face, x, y, c) = small.at(face, x / 16, y / 16, c);
                }
            }
        }
    }
    const auto a = project_to_sh(small, 3);
    const auto b = project_to_sh(large, 3);
    for (std::size_t k = 0; k < a.coefficients.size(); ++k) {
        EXPECT_NEAR(a.coefficients[k][0], b.coefficients[k][0], 1e-5 * a.coefficients[0][0]) << k;
    }
}

TEST(SphericalHarmonics, EvaluateWhatWasProjected) {
    const auto function = [](const Direction& d) {
        return Radiance{static_cast<float>(1 + d.x * d.y - .5 * d.z * d.z * d.x)};
    };
    const auto sh = project_to_sh(make_environment(128, function), 4);
    Random random(2);
    for (int i = 0; i < 50; ++i) {
        const Direction d = random_direction(random);
        EXPECT_NEAR(evaluate_sh(sh, d)[0], function(d)[0], 1e-4);
    }
}

// Ramamoorthi & Hanrahan 2001: nine coefficients give the irradiance of ordinary maps to 1 % of its
// largest value.
TEST(SphericalHarmonics, ThreeBandsGiveTheIrradianceOfSmoothMaps) {
    const CubeMap map = overcast_environment(64);
    const auto sh = irradiance_of_sh(project_to_sh(map, 3));
    Irradiance exact(map.size());
    exact.prepare(map);
    Random random(3);
    double largest = 0;
    double worst = 0;
    for (int i = 0; i < 300; ++i) {
        const Direction n = random_direction(random);
        const double expected = exact.at(n)[1];
        largest = std::max(largest, expected);
        worst = std::max(worst, std::abs(evaluate_sh(sh, n)[1] - expected));
    }
    EXPECT_LT(worst, .01 * largest);
}

// The fifth band is of a different sign; a fourth one gives nothing.
TEST(SphericalHarmonics, MoreBandsOfIrradianceAreBetterEvenWithASun) {
    const CubeMap map = sun_environment(64);
    Irradiance exact(map.size());
    exact.prepare(map);
    const auto rms = [&](int bands) {
        const auto sh = irradiance_of_sh(project_to_sh(map, bands));
        Random random(4);
        double sum = 0;
        for (int i = 0; i < 500; ++i) {
            const Direction n = random_direction(random);
            const double error = evaluate_sh(sh, n)[0] - exact.at(n)[0];
            sum += error * error;
        }
        return std::sqrt(sum);
    };
    const double three = rms(3);
    EXPECT_LT(three, .3 * rms(2));
    EXPECT_NEAR(rms(4), three, 1e-9 * three);
    EXPECT_LT(rms(5), .6 * three);
}

TEST(SphericalHarmonics, WindowsKeepTheMeanAndWeakenTheRest) {
    const auto sh = project_to_sh(sun_environment(32), 5);
    for (const ShWindow window : {ShWindow::kHann, ShWindow::kLanczos}) {
        const auto soft = windowed(sh, window, 4);
        const auto softer = windowed(sh, window, 2.5);
        EXPECT_EQ(soft.coefficients[0], sh.coefficients[0]);
        for (std::size_t k = 1; k < 16; ++k) {
            const double whole = std::abs(sh.coefficients[k][1]);
            EXPECT_LT(std::abs(soft.coefficients[k][1]), whole);
            EXPECT_LE(std::abs(softer.coefficients[k][1]), std::abs(soft.coefficients[k][1]));
        }
        for (std::size_t k = 16; k < 25; ++k) EXPECT_EQ(soft.coefficients[k][1], 0);
    }
    EXPECT_NEAR(windowed(sh, ShWindow::kHann, 4).coefficients[6][0], .5 * sh.coefficients[6][0],
                1e-12);
    EXPECT_NEAR(windowed(sh, ShWindow::kLanczos, 4).coefficients[6][0],
                2 / kPi * sh.coefficients[6][0], 1e-12);
    EXPECT_EQ(windowed(sh, ShWindow::kNone, 1).coefficients, sh.coefficients);
}

TEST(SphericalHarmonics, DeringingIsTheWeakestThatIsEnough) {
    const auto least = [](const SphericalHarmonics& sh) {
        Random random(5);
        double value = 1e9;
        for (int i = 0; i < 20000; ++i) {
            value = std::min(value, evaluate_sh(sh, random_direction(random))[0]);
        }
        return value / sh.coefficients[0][0];
    };
    const auto sun =
        irradiance_of_sh(project_to_sh(one_texel_environment(8, 2, 3, 3, {1, 1, 1}), 3));
    ASSERT_LT(least(sun), -.01);
    for (const ShWindow window : {ShWindow::kHann, ShWindow::kLanczos}) {
        const double cutoff = deringing_cutoff(sun, window);
        EXPECT_GT(least(windowed(sun, window, cutoff)), -5e-4);
        EXPECT_LT(least(windowed(sun, window, 1.05 * cutoff)), -1e-4);
    }
    const auto sky = irradiance_of_sh(project_to_sh(overcast_environment(16), 3));
    EXPECT_EQ(deringing_cutoff(sky, ShWindow::kHann), 48);
}

TEST(SphericalHarmonics, AreTheSameWithAnyNumberOfThreads) {
    const CubeMap map = studio_environment(48);
    const auto several = project_to_sh(map, 5);
    const ThreadLimit one(1);
    EXPECT_EQ(several.coefficients, project_to_sh(map, 5).coefficients);
}

TEST(SphericalHarmonics, RefuseWhatTheyCannotDo) {
    EXPECT_THROW(project_to_sh(CubeMap(), 3), InvalidArgument);
    EXPECT_THROW(project_to_sh(CubeMap(2), 0), InvalidArgument);
    EXPECT_THROW(project_to_sh(CubeMap(2), 6), InvalidArgument);
    const auto sh = project_to_sh(CubeMap(2), 3);
    EXPECT_THROW(windowed(sh, ShWindow::kHann, 0), InvalidArgument);
    EXPECT_THROW(windowed(sh, ShWindow::kHann, std::nan("")), InvalidArgument);
    EXPECT_THROW(deringing_cutoff(sh, ShWindow::kNone), InvalidArgument);
}

}  // namespace
}  // namespace aureole::ibl
