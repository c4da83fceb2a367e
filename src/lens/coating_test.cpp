// Thin films, held to Parratt's recursion with complex angles and to the blog.
#include "aureole/lens/coating.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

#include "aureole/base/error.h"
#include "aureole/base/units.h"

namespace aureole::lens {
namespace {

using Complex = std::complex<double>;

// Parratt 1954: the amplitude of a stack from the back to the front, each face by Fresnel's
// equations; no matrices, and complex numbers throughout.
Reflectance by_recursion(double front, double back, const Coating& layers, double wavelength_nm,
                         double cosine) {
    std::vector<double> n = {front};
    for (const Layer& layer : layers) n.push_back(layer.index);
    n.push_back(back);
    const double sine = std::sqrt(1 - cosine * cosine);
    std::vector<Complex> cosines;
    for (const double index : n) {
        const double s = front * sine / index;
        cosines.push_back(std::sqrt(Complex(1 - s * s, 0.0)));  // +i: decaying
    }
    cosines.front() = cosine;
    double result[2] = {};
    for (const bool p : {false, true}) {
        Complex below = 0;
        for (std::size_t k = n.size() - 1; k-- > 0;) {
            const Complex a = p ? n[k + 1] * cosines[k] : n[k] * cosines[k];
            const Complex b = p ? n[k] * cosines[k + 1] : n[k + 1] * cosines[k + 1];
            const Complex r = (a - b) / (a + b);
            Complex phase = 0;  // there and back through the layer behind this face
            if (k + 2 < n.size()) {
                phase = std::exp(Complex(0, 4 * kPi / wavelength_nm) * n[k + 1] *
                                 layers[k].thickness_nm * cosines[k + 1]);
            }
            below = (r + below * phase) / (1.0 + r * below * phase);
        }
        result[p] = std::norm(below);
    }
    return {result[0], result[1]};
}

TEST(Coating, AgreesWithParrattsRecursion) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> index(1.0, 2.4);
    std::uniform_real_distribution<double> thickness(5, 400);
    std::uniform_int_distribution<int> count(0, 6);
    int evanescent = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const double front = trial % 2 == 0 ? 1.0 : index(random);
        const double back = trial % 3 == 0 ? 1.0 : index(random);
        Coating layers;
        for (int i = count(random); i > 0; --i) {
            layers.push_back({index(random), thickness(random)});
        }
        for (double angle = 0; angle <= 80; angle += 8) {
            const double cosine = std::cos(rad_from_deg(angle));
            for (const Layer& layer : layers) {
                evanescent += front * std::sin(rad_from_deg(angle)) > layer.index;
            }
            for (double wavelength = 380; wavelength <= 770; wavelength += 39) {
                const Reflectance exact = by_recursion(front, back, layers, wavelength, cosine);
                const Reflectance got = reflectance(front, back, layers, wavelength, cosine);
                ASSERT_NEAR(got.s, exact.s, 1e-12);
                ASSERT_NEAR(got.p, exact.p, 1e-12);
            }
        }
    }
    EXPECT_GT(evanescent, 500);  // frustrated total reflection is among them
}

// The function printed in the blog, in double precision.
TEST(Coating, OneLayerAgreesWithTheSeedDocument) {
    for (const double glass : {1.45, 1.62, 1.85}) {
        const Coating coating = quarter_wave(1, glass, 550);
        const double n2 = coating[0].index;
        for (double angle = 0; angle <= 80; angle += 5) {
            const double t1 = rad_from_deg(angle);
            const double c1 = std::cos(t1);
            const double c2 = std::cos(std::asin(std::sin(t1) / n2));
            const double c3 = std::cos(std::asin(std::sin(t1) / glass));
            const auto airy = [&](double r12, double r23, double phase) {
                const double mixed = 2 * r12 * r23 * std::cos(phase);
                return (r12 * r12 + r23 * r23 + mixed) / (1 + r12 * r12 * r23 * r23 + mixed);
            };
            for (double wavelength = 380; wavelength <= 770; wavelength += 30) {
                const double phase = 4 * kPi / wavelength * n2 * coating[0].thickness_nm * c2;
                const double p = airy((n2 * c1 - c2) / (n2 * c1 + c2),
                                      (glass * c2 - n2 * c3) / (glass * c2 + n2 * c3), phase);
                const double s = airy((c1 - n2 * c2) / (c1 + n2 * c2),
                                      (n2 * c2 - glass * c3) / (n2 * c2 + glass * c3), phase);
                const Reflectance got = reflectance(1, glass, coating, wavelength, c1);
                EXPECT_NEAR(got.s, s, 1e-13);
                EXPECT_NEAR(got.p, p, 1e-13);
                EXPECT_DOUBLE_EQ(got.mean(), 0.5 * (got.s + got.p));
            }
        }
    }
}

// Of the reference: ((n1 n3 - n2^2) / (n1 n3 + n2^2))^2 for a quarter wave.
TEST(Coating, QuarterWaveOfMagnesiumFluoride) {
    const auto at_normal = [](double glass) {
        return reflectance(1, glass, quarter_wave(1, glass, 550), 550, 1).mean();
    };
    EXPECT_NEAR(at_normal(1.62), 0.0065, 0.00005);
    EXPECT_NEAR(at_normal(1.85), 0.00021, 0.000005);
    EXPECT_NEAR(at_normal(1.62), std::pow((1.62 - 1.9044) / (1.62 + 1.9044), 2), 1e-15);
    // Dense enough a glass: an index of its own that extinguishes the reflection.
    EXPECT_NEAR(at_normal(2.1), 0, 1e-15);
    const Coating thin = quarter_wave(1, 1.5, 500);
    EXPECT_DOUBLE_EQ(thin[0].index, 1.38);
    EXPECT_DOUBLE_EQ(thin[0].thickness_nm, 500 / (4 * 1.38));
}

// At the design wavelength the half wave is not there, and the two quarters turn the admittance of
// the glass, n, into 1.38^2 n / 1.63^2 (Macleod, 4.1).
TEST(Coating, BroadbandAtItsDesignWavelength) {
    const Coating coating = coating_from_name("broadband:520", 1, 1.52);
    ASSERT_EQ(coating.size(), 3u);
    const double y = 1.38 * 1.38 * 1.52 / (1.63 * 1.63);
    EXPECT_NEAR(reflectance(1, 1.52, coating, 520, 1).mean(), std::pow((1 - y) / (1 + y), 2),
                1e-14);
    // What it is for: less over the visible than one layer.
    double one = 0, three = 0;
    const Coating single = coating_from_name("mgf2:520", 1, 1.52);
    for (double wavelength = 430; wavelength <= 680; wavelength += 10) {
        one += reflectance(1, 1.52, single, wavelength, 1).mean();
        three += reflectance(1, 1.52, coating, wavelength, 1).mean();
    }
    EXPECT_LT(three, 0.6 * one);
}

TEST(Coating, BareFacesFollowFresnel) {
    EXPECT_NEAR(reflectance(1, 1.5, {}, 550, 1).mean(), 0.04, 1e-15);
    EXPECT_NEAR(reflectance(1, 1.5, {}, 550, std::cos(std::atan(1.5))).p, 0, 1e-30);  // Brewster
    EXPECT_EQ(reflectance(1.6, 1.6, {}, 550, 0.3).s, 0);
    EXPECT_EQ(reflectance(1.6, 1.6, {}, 550, 0).mean(), 0);  // and grazing along nothing
    EXPECT_NEAR(reflectance(1, 1.5, {}, 550, 0).mean(), 1, 1e-15);
}

TEST(Coating, TotalReflectionIsOne) {
    const Coating coating = quarter_wave(1.7, 1, 550);
    const double critical = std::asin(1 / 1.7);
    for (double past = 1e-9; critical + past < kPi / 2; past += 0.01) {
        for (const Coating& layers : {Coating{}, coating}) {
            const Reflectance r = reflectance(1.7, 1, layers, 550, std::cos(critical + past));
            EXPECT_EQ(r.s, 1);
            EXPECT_EQ(r.p, 1);
        }
    }
    EXPECT_LT(reflectance(1.7, 1, {}, 550, std::cos(critical - 0.01)).mean(), 0.8);
}

// Light tunnels through a thin gap of air between two prisms, and not through a thick one, whose
// hyperbolic functions overflow.
TEST(Coating, FrustratedTotalReflection) {
    const double cosine = std::cos(rad_from_deg(60));
    const auto gap = [&](double nm) {
        return reflectance(1.7, 1.7, Coating{{1.0, nm}}, 550, cosine).mean();
    };
    EXPECT_LT(gap(1), 0.01);
    EXPECT_GT(gap(100), gap(50));
    EXPECT_NEAR(gap(10000), 1, 1e-12);
    EXPECT_NEAR(reflectance(5, 5, Coating(20, Layer{1.0, 10000}), 380, 0.05).mean(), 1, 1e-12);
}

// A lossless stack reflects the same from both sides (Stokes), s and p.
TEST(Coating, IsReciprocal) {
    const Coating there = {{1.38, 90}, {2.1, 140}, {1.63, 40}};
    const Coating back(there.rbegin(), there.rend());
    for (double angle = 0; angle < 90; angle += 3) {
        const double sine = std::sin(rad_from_deg(angle));
        const double inside = std::sqrt(1 - sine * sine / (1.7 * 1.7));
        const Reflectance a = reflectance(1, 1.7, there, 610, std::cos(rad_from_deg(angle)));
        const Reflectance b = reflectance(1.7, 1, back, 610, inside);
        EXPECT_NEAR(a.s, b.s, 1e-12);
        EXPECT_NEAR(a.p, b.p, 1e-12);
    }
}

TEST(Coating, ReflectanceIsAShare) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> index(1, 5);
    std::uniform_real_distribution<double> thickness(0, 10000);
    std::uniform_real_distribution<double> cosine(-0.1, 1.1);  // rounding beyond [0, 1] is clamped
    for (int trial = 0; trial < 20000; ++trial) {
        Coating layers(static_cast<std::size_t>(trial % 5));
        for (Layer& layer : layers) layer = {index(random), thickness(random)};
        const Reflectance r =
            reflectance(index(random), index(random), layers, 380 + trial % 390, cosine(random));
        ASSERT_TRUE(r.s >= 0 && r.s <= 1 && r.p >= 0 && r.p <= 1) << r.s << " " << r.p;
    }
    EXPECT_EQ(reflectance(1, 1.5, {}, 550, 1.1).mean(), reflectance(1, 1.5, {}, 550, 1).mean());
}

TEST(Coating, Names) {
    EXPECT_TRUE(coating_from_name("none", 1, 1.5).empty());
    const Coating mgf2 = coating_from_name("mgf2", 1, 1.5);
    ASSERT_EQ(mgf2.size(), 1u);
    EXPECT_DOUBLE_EQ(mgf2[0].thickness_nm, 550 / (4 * 1.38));
    EXPECT_DOUBLE_EQ(coating_from_name("mgf2:500", 1.5, 1)[0].thickness_nm, 500 / (4 * 1.38));
    // Named from the air side, stored from the front.
    const Coating in_front = coating_from_name("1.38/90,2.05/130.5", 1, 1.5);
    const Coating behind = coating_from_name("1.38/90,2.05/130.5", 1.5, 1);
    ASSERT_EQ(in_front.size(), 2u);
    EXPECT_DOUBLE_EQ(in_front[1].index, 2.05);
    EXPECT_DOUBLE_EQ(in_front[1].thickness_nm, 130.5);
    EXPECT_DOUBLE_EQ(behind[0].index, 2.05);
    // Neither cement nor air in air holds a coating.
    for (const char* name : {"mgf2", "broadband", "1.38/90"}) {
        EXPECT_TRUE(coating_from_name(name, 1.5, 1.7).empty());
        EXPECT_TRUE(coating_from_name(name, 1, 1).empty());
    }
    for (const char* name : {"", "mgf", "mgf2:", "mgf2:x", "mgf2:-5", "mgf2:550x", "none:5",
                             "broadband:nan", "1.38", "1.38/", "1.38/90,", "0.9/90", "5.1/90",
                             "1.38/0", "1.38/10001", "1.38/-1", "a/b", "1.38/90/2"}) {
        EXPECT_THROW(coating_from_name(name, 1, 1.5), InvalidArgument) << name;
        EXPECT_THROW(coating_from_name(name, 1.5, 1.7), InvalidArgument) << name;
    }
}

}  // namespace
}  // namespace aureole::lens
