// Laws of the star around a bright point.
#include "aureole/lens/starburst.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "lens/starburst_aperture.h"

namespace aureole::lens {
namespace {

// One band of the spectrum lies at the geometric mean of its ends.
const double kOneBandMm = mm_from_nm(std::sqrt(380.0 * 770.0));
constexpr StarburstOptions kOneBand{.samples = 1024, .bands = 1};
constexpr StarburstOptions kSmall{.samples = 1024};

// Pixels of q lambda / D.
wave::KernelGrid grid_of(int size, double q, double diameter_mm) {
    return {size, size, deg_from_rad(q * kOneBandMm / diameter_mm), Projection::kConstantPitch};
}

// Sum over pixels of channel c, each times share(dx, dy), dy upwards.
double sum(const wave::Psf& psf, int c, const std::function<double(int, int)>& share) {
    double total = 0;
    const int w = psf.grid.width / 2;
    const int h = psf.grid.height / 2;
    for (int y = -h; y <= h; ++y) {
        for (int x = -w; x <= w; ++x) {
            total += static_cast<double>(psf.kernel.at(x + w, h - y, c)) * share(x, y);
        }
    }
    return total;
}

// The part of a pixel within `radius` pixels of the axis.
double inside_circle(int x, int y, double radius) {
    const double r = std::hypot(x, y);
    if (r < radius - 1) return 1;
    if (r > radius + 1) return 0;
    constexpr int kParts = 32;
    int inside = 0;
    for (int j = 0; j < kParts; ++j) {
        for (int i = 0; i < kParts; ++i) {
            const double dx = x + (i + 0.5) / kParts - 0.5;
            const double dy = y + (j + 0.5) / kParts - 0.5;
            inside += dx * dx + dy * dy < radius * radius ? 1 : 0;
        }
    }
    return static_cast<double>(inside) / (kParts * kParts);
}

double encircled(const wave::Psf& psf, int c, double radius_px) {
    return sum(psf, c, [=](int x, int y) { return inside_circle(x, y, radius_px); });
}

// Mean over the ring [from, to) in pixels.
double ring_mean(const wave::Psf& psf, int c, double from, double to) {
    int pixels = 0;
    const double total = sum(psf, c, [&](int x, int y) {
        const double r = std::hypot(x, y);
        if (r < from || r >= to) return 0.0;
        ++pixels;
        return 1.0;
    });
    return total / pixels;
}

// Energy over directions from the axis, of pixels between two radii; bin 0 begins at +x, bins go
// counter-clockwise. Of the full turn.
std::vector<double> by_direction(const wave::Psf& psf, double from, double to, int bins) {
    std::vector<double> energy(static_cast<std::size_t>(bins), 0.0);
    const int w = psf.grid.width / 2;
    const int h = psf.grid.height / 2;
    for (int y = -h; y <= h; ++y) {
        for (int x = -w; x <= w; ++x) {
            const double r = std::hypot(x, y);
            if (r < from || r >= to) continue;
            const double turn = std::atan2(y, x) / (2 * kPi);
            const auto bin = static_cast<std::size_t>((turn - std::floor(turn)) * bins);
            energy[std::min(bin, energy.size() - 1)] +=
                static_cast<double>(psf.kernel.at(x + w, h - y, 1));
        }
    }
    return energy;
}

// Directions (deg) of bins that hold more than `times` the mean, neighbours joined.
std::vector<double> spikes(const std::vector<double>& energy, double times) {
    double mean = 0;
    for (const double e : energy) mean += e / static_cast<double>(energy.size());
    const std::size_t n = energy.size();
    std::size_t start = 0;
    while (start < n && energy[start] > times * mean) ++start;
    std::vector<double> found;
    double weight = 0;
    double position = 0;
    for (std::size_t k = 0; k <= n; ++k) {
        const double e = k < n ? energy[(start + k) % n] : 0;
        if (e > times * mean) {
            weight += e;
            position += e * (static_cast<double>(start + k) + 0.5);
        } else if (weight > 0) {
            found.push_back(std::fmod(position / weight * 360 / static_cast<double>(n), 360.0));
            weight = position = 0;
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

// Airy: the share inside radius theta is 1 - J0^2(v) - J1^2(v), v = pi D theta / lambda (Rayleigh
// 1881; Born & Wolf 8.5.2).
double airy_outside(double theta_over_lambda_d) {
    const double v = kPi * theta_over_lambda_d;
    const double j0 = std::cyl_bessel_j(0.0, v);
    const double j1 = std::cyl_bessel_j(1.0, v);
    return j0 * j0 + j1 * j1;
}

TEST(Starburst, OfARoundIrisIsAnAiryPattern) {
    constexpr double kDiameterMm = 4;
    // Near the axis, with pixels of a twentieth of lambda / D.
    const auto near = starburst_psf(Iris(), kDiameterMm, grid_of(331, 0.05, kDiameterMm), kOneBand);
    for (const double radius : {1.0, 1.22, 2.0, 2.233, 3.238, 5.0, 8.0}) {
        EXPECT_NEAR(encircled(near, 1, 20 * radius), 1 - airy_outside(radius), 1e-3) << radius;
    }
    // Around and far beyond the end of the raster, which is at 210 lambda / D. The share outside
    // to 1 %, where 2 % per pixel of radius are at stake.
    const auto far = starburst_psf(Iris(), kDiameterMm, grid_of(401, 8, kDiameterMm), kOneBand);
    for (const double radius : {80.0, 150.0, 200.0, 300.0, 600.0, 1500.0}) {
        const double outside = 1 - encircled(far, 1, radius / 8);
        // Between the dark rings J0^2 + J1^2 runs along 2 / (pi v).
        EXPECT_NEAR(outside / (2 / (kPi * kPi * radius)), 1, 0.01) << radius;
    }
}

TEST(Starburst, FirstDarkRingOfARoundIris) {
    constexpr double kDiameterMm = 4;
    const auto psf = starburst_psf(Iris(), kDiameterMm, grid_of(101, 0.05, kDiameterMm), kOneBand);
    int darkest = 1;
    for (int x = 1; x < 40; ++x) {
        if (psf.kernel.at(50 + x, 50, 1) < psf.kernel.at(50 + darkest, 50, 1)) darkest = x;
    }
    // The parabola through the darkest pixel and its neighbours.
    const auto at = [&](int x) { return static_cast<double>(psf.kernel.at(50 + x, 50, 1)); };
    const double left = at(darkest - 1) - at(darkest);
    const double right = at(darkest + 1) - at(darkest);
    const double position = darkest + 0.5 * (left - right) / (left + right);
    EXPECT_NEAR(position * 0.05, 1.2197, 0.01);
}

// Far from the axis a share P lambda / (2 pi^2 A theta) lies outside theta, P being the perimeter
// and A the area of the opening (Clark, Howard & Freniere 1984, Appl. Opt. 23, 353).
TEST(Starburst, ObeysThePerimeterLaw) {
    constexpr double kDiameterMm = 5;
    for (const IrisShape& shape :
         {IrisShape{}, IrisShape{.blades = 6, .rotation_deg = 11}, IrisShape{.blades = 5},
          IrisShape{.blades = 7, .curvature = 0.5}, IrisShape{.blades = 6, .smoothing = 0.1}}) {
        const Iris iris(shape);
        double area = 0;
        double perimeter = 0;
        for (const auto& outline : outline_of(iris, kDiameterMm / 2).outlines) {
            for (std::size_t i = 0; i < outline.size(); ++i) {
                const wave::Point& a = outline[i];
                const wave::Point& b = outline[(i + 1) % outline.size()];
                area += 0.5 * (a.x_mm * b.y_mm - b.x_mm * a.y_mm);
                perimeter += std::hypot(b.x_mm - a.x_mm, b.y_mm - a.y_mm);
            }
        }
        EXPECT_NEAR(area / (kPi * kDiameterMm * kDiameterMm / 4), 1, 1e-4);
        for (const double q : {2.0, 10.0, 60.0}) {
            const auto grid = grid_of(301, q, kDiameterMm);
            const auto psf = starburst_psf(iris, kDiameterMm, grid, kOneBand);
            for (const double radius_px : {30.0, 75.0, 150.0}) {
                const double sine = std::sin(radius_px * rad_from_deg(grid.pitch_deg));
                const double law = perimeter * kOneBandMm / (2 * kPi * kPi * area * sine);
                EXPECT_NEAR((1 - encircled(psf, 1, radius_px)) / law, 1, 0.02)
                    << shape.blades << ' ' << q << ' ' << radius_px;
            }
        }
    }
}

// The same with all wavelengths, ring by ring, right through where raster and law meet.
TEST(Starburst, HasNoSeam) {
    constexpr double kDiameterMm = 6;
    const auto grid = grid_of(401, 8, kDiameterMm);
    const auto psf = starburst_psf(Iris(), kDiameterMm, grid, kSmall);
    const auto bands = color::sample_spectrum(64);
    const double pixel = rad_from_deg(grid.pitch_deg);
    for (int c = 0; c < 3; ++c) {
        double mean_mm = 0;
        for (const auto& band : bands) {
            mean_mm += band.rgb[static_cast<std::size_t>(c)] * mm_from_nm(band.wavelength_nm);
        }
        for (double r = 8; r < 190; r *= 1.12) {
            // Density P lambda / (4 pi^3 A theta^3) = 1 / (pi^3 D theta^3) lambda, over the ring.
            const double low = r * pixel;
            const double high = 1.12 * r * pixel;
            const double energy = 2 * mean_mm / (kPi * kPi * kDiameterMm) * (1 / low - 1 / high);
            const double measured = sum(psf, c, [&](int x, int y) {
                return inside_circle(x, y, 1.12 * r) - inside_circle(x, y, r);
            });
            EXPECT_NEAR(measured / energy, 1, 0.015) << "channel " << c << ", " << r << " px";
        }
    }
}

TEST(Starburst, CountsItsSpikes) {
    constexpr double kDiameterMm = 5;
    // Inside the raster, across its end, and beyond.
    for (const double from : {12.0, 22.0, 90.0}) {
        for (const auto& [blades, expected] : {std::pair{6, 6}, {5, 10}, {8, 8}, {7, 14}}) {
            const Iris iris({.blades = blades, .rotation_deg = 10});
            const auto psf = starburst_psf(iris, kDiameterMm, grid_of(401, 8, kDiameterMm), kSmall);
            const auto found = spikes(by_direction(psf, from, 2 * from, 180), 2);
            ASSERT_EQ(found.size(), static_cast<std::size_t>(expected)) << blades << ' ' << from;
            // Across the edges: half a blade from the corners, counter-clockwise from 10 deg. An
            // odd number of blades sends the light of each to both sides.
            const double step = 360.0 / expected;
            const double first = std::fmod(10 + 180.0 / blades, step);
            for (std::size_t i = 0; i < found.size(); ++i) {
                // A pixel at the inner radius subtends 5 deg.
                EXPECT_NEAR(found[i], first + static_cast<double>(i) * step, 1) << blades;
            }
        }
    }
}

TEST(Starburst, TurnsWithTheIris) {
    constexpr double kDiameterMm = 5;
    const auto grid = grid_of(121, 4, kDiameterMm);
    const auto a = starburst_psf(Iris({.blades = 5, .rotation_deg = 7}), kDiameterMm, grid, kSmall);
    const auto b =
        starburst_psf(Iris({.blades = 5, .rotation_deg = 97}), kDiameterMm, grid, kSmall);
    for (int y = -60; y <= 60; ++y) {
        for (int x = -60; x <= 60; ++x) {
            // A quarter turn counter-clockwise takes (x, y) up to (-y, x).
            const double before = static_cast<double>(a.kernel.at(60 + x, 60 - y, 1));
            const double after = static_cast<double>(b.kernel.at(60 - y, 60 - x, 1));
            ASSERT_NEAR(after, before, 1e-3 * before + 1e-10) << x << ' ' << y;
        }
    }
}

TEST(Starburst, RedSpreadsFartherThanBlue) {
    constexpr double kDiameterMm = 4;
    const auto psf = starburst_psf(Iris(), kDiameterMm, grid_of(401, 0.05, kDiameterMm), kSmall);
    const auto half_energy_px = [&](int c) {
        double radius = 1;
        while (encircled(psf, c, radius) < 0.5) radius += 0.25;
        return radius;
    };
    EXPECT_GT(half_energy_px(0), 1.1 * half_energy_px(1));
    EXPECT_GT(half_energy_px(1), 1.1 * half_energy_px(2));
}

// lambda / D: half the pupil, twice the angle.
TEST(Starburst, FSixteenSpreadsTwiceAsFarAsFEight) {
    const Iris iris({.blades = 6, .rotation_deg = 5});
    wave::KernelGrid grid = grid_of(201, 3, 6.25);
    const auto f8 = starburst_psf(iris, 6.25, grid, kSmall);
    grid.pitch_deg *= 2;
    const auto f16 = starburst_psf(iris, 3.125, grid, kSmall);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < f8.kernel.pixels(); ++i) {
            const double wide = static_cast<double>(f8.kernel.plane(c)[i]);
            ASSERT_NEAR(static_cast<double>(f16.kernel.plane(c)[i]), wide,
                        2e-3 * std::abs(wide) + 1e-9);
        }
    }
}

void expect_sound(const wave::Psf& psf, const char* what) {
    for (int c = 0; c < 3; ++c) {
        double total = psf.off_kernel_energy[static_cast<std::size_t>(c)];
        for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
            ASSERT_TRUE(std::isfinite(psf.kernel.plane(c)[i])) << what;
            total += static_cast<double>(psf.kernel.plane(c)[i]);
        }
        EXPECT_NEAR(total, 1, 1e-6) << what;
        EXPECT_GE(psf.off_kernel_energy[static_cast<std::size_t>(c)], -1e-6) << what;
        EXPECT_LT(psf.off_kernel_energy[static_cast<std::size_t>(c)], 1) << what;
    }
}

TEST(Starburst, HasUnitEnergyOfAnySize) {
    const Iris iris({.blades = 6, .curvature = 0.3, .smoothing = 0.1});
    for (const double diameter_mm : {0.02, 2.0, 400.0}) {
        for (const double pitch_deg : {1e-4, 0.02, 3.0}) {
            for (const auto projection : {Projection::kPerspective, Projection::kConstantPitch}) {
                const wave::KernelGrid grid{41, 23, pitch_deg, projection};
                const auto psf = starburst_psf(iris, diameter_mm, grid, {.samples = 256});
                expect_sound(psf, "small");
            }
        }
    }
}

// Pixels so large that nearly all is in one: white in, white out.
TEST(Starburst, WhiteStaysWhite) {
    const auto psf = starburst_psf(Iris({.blades = 6}), 20, grid_of(41, 100, 20), kSmall);
    expect_sound(psf, "white");
    std::array<double, 3> near = {};
    for (int c = 0; c < 3; ++c) near[static_cast<std::size_t>(c)] = encircled(psf, c, 5);
    EXPECT_GT(near[1], 0.999);
    EXPECT_NEAR(near[0], near[1], 1e-4);
    EXPECT_NEAR(near[2], near[1], 1e-4);
}

// What lies beyond a kernel is what the perimeter law says (here: around a square, by the integral
// of 1 / r^3 outside it, 2 sqrt(2) times the inverse half side over pi times that of a disc).
TEST(Starburst, KnowsWhatLiesBeyondTheKernel) {
    constexpr double kDiameterMm = 3;
    const auto grid = grid_of(101, 6, kDiameterMm);
    const auto psf = starburst_psf(Iris(), kDiameterMm, grid, kOneBand);
    const double half_side = 50.5 * 6;  // lambda / D
    const double law = 2 / (kPi * kPi * half_side) * (2 * std::sqrt(2.0) / kPi);
    EXPECT_NEAR(psf.off_kernel_energy[1] / law, 1, 0.01);
}

// The raster is as small as pixels allow (docs/starburst.md). Against one four times as fine.
TEST(Starburst, DoesNotDependOnTheRaster) {
    constexpr double kDiameterMm = 5;
    for (const double q : {0.3, 1.0, 4.0, 8.0}) {
        const auto grid = grid_of(101, q, kDiameterMm);
        const auto coarse = starburst_psf(Iris(), kDiameterMm, grid, {.samples = 512});
        const auto fine = starburst_psf(Iris(), kDiameterMm, grid, {.samples = 2048});
        for (int c = 0; c < 3; ++c) {
            for (double r = 1; r < 30; r *= 1.5) {
                const double mean = ring_mean(fine, c, r, 1.5 * r);
                EXPECT_NEAR(ring_mean(coarse, c, r, 1.5 * r) / mean, 1, 0.01)
                    << "pixels of " << q << ", channel " << c << ", " << r << " px";
            }
        }
    }
}

// ---- Pictures of irises and of dirt ----

// A line of the given width through the middle of a white picture, along `direction_deg` as seen
// (counter-clockwise, top of the picture up).
Image scratched(int size, double width_px, double direction_deg, float value) {
    Image picture(size, size, 1);
    const double s = std::sin(rad_from_deg(direction_deg));
    const double c = std::cos(rad_from_deg(direction_deg));
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const double dx = x + 0.5 - size / 2.0;
            const double dy = size / 2.0 - y - 0.5;
            picture.at(x, y) = std::abs(-s * dx + c * dy) < width_px / 2 ? value : 1.0F;
        }
    }
    return picture;
}

TEST(Starburst, ScratchesSpreadLightAcrossThemselves) {
    constexpr double kDiameterMm = 6;
    const auto grid = grid_of(301, 4, kDiameterMm);
    const Occluder occluder(scratched(1024, 6, 30, 0).view(), 8);
    const auto clean = starburst_psf(Iris(), kDiameterMm, grid, kSmall);
    const auto dirty = starburst_psf(Iris(), kDiameterMm, grid, kSmall, &occluder);
    expect_sound(dirty, "dirty");
    EXPECT_EQ(spikes(by_direction(clean, 15, 45, 180), 2).size(), 0u);
    const auto found = spikes(by_direction(dirty, 15, 45, 180), 2);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0], 120, 1);
    EXPECT_NEAR(found[1], 300, 1);
}

// A scratch that blocks a share b of the light takes 1 - b of the amplitude from the axis; so much
// is left of the intensity there when the light that passes is made 1 again.
TEST(Starburst, ScratchesTakeWhatTheyBlock) {
    constexpr double kDiameterMm = 6;
    const wave::KernelGrid axis = grid_of(3, 0.02, kDiameterMm);
    constexpr StarburstOptions kOptions{.samples = 2048, .bands = 1};
    const Occluder occluder(scratched(1024, 48, 90, 0).view(), 8);
    const auto clean = starburst_psf(Iris(), kDiameterMm, axis, kOptions);
    const auto dirty = starburst_psf(Iris(), kDiameterMm, axis, kOptions, &occluder);
    // A strip of 48 of the 768 pixels across the pupil.
    const double a = 48.0 / 768;
    const double blocked = 2 / kPi * (a * std::sqrt(1 - a * a) + std::asin(a));
    // Between pixels transmission is interpolated: of each edge, 1 pixel wide, 1/6 of a pixel
    // passes as amplitude but not as energy.
    const double lost = blocked * (2.0 / 6) / 48;
    EXPECT_NEAR(static_cast<double>(dirty.kernel.at(1, 1, 1)) /
                    static_cast<double>(clean.kernel.at(1, 1, 1)),
                (1 - blocked) * (1 - blocked) / (1 - blocked - lost), 1e-3);
}

TEST(Starburst, APictureOfADiscIsARoundIris) {
    constexpr int kSize = 1024;
    Image picture(kSize, kSize, 1);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const double r = std::hypot(x + 0.5 - kSize / 2.0, y + 0.5 - kSize / 2.0);
            picture.at(x, y) = static_cast<float>(std::clamp(400.5 - r, 0.0, 1.0));
        }
    }
    constexpr double kDiameterMm = 4;
    const auto grid = grid_of(201, 0.25, kDiameterMm);
    const auto drawn = starburst_psf(Iris(picture.view()), kDiameterMm, grid, kOneBand);
    expect_sound(drawn, "picture");
    for (const double radius : {2.0, 6.0, 20.0}) {
        EXPECT_NEAR(encircled(drawn, 1, 4 * radius), 1 - airy_outside(radius), 2e-3) << radius;
    }
}

// A slit that leans by 30 deg, seen through the camera, throws its light across.
TEST(Starburst, APictureIsSeenUpright) {
    Image picture = scratched(512, 40, 30, 0);
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        picture.plane(0)[i] = 1 - picture.plane(0)[i];  // the slit is open, all else is not
    }
    const auto psf = starburst_psf(Iris(picture.view()), 2, grid_of(201, 3, 2), kSmall);
    const auto found = spikes(by_direction(psf, 20, 60, 180), 6);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0], 120, 1);
}

// ---- Behaviour ----

TEST(Starburst, DoesNotDependOnThreads) {
    const Iris iris({.blades = 6, .rotation_deg = 3});
    const Occluder occluder(scratched(256, 3, 20, 0.5F).view(), 8);
    const wave::KernelGrid grid{401, 301, 0.02, Projection::kPerspective};
    const auto many = starburst_psf(iris, 6, grid, kSmall, &occluder);
    const ThreadLimit one(1);
    const auto single = starburst_psf(iris, 6, grid, kSmall, &occluder);
    EXPECT_EQ(std::memcmp(many.kernel.plane(0), single.kernel.plane(0),
                          3 * many.kernel.pixels() * sizeof(float)),
              0);
    EXPECT_EQ(many.off_kernel_energy, single.off_kernel_energy);
}

TEST(Starburst, LooksTheSameAfterAHalfTurn) {
    const auto psf = starburst_psf(Iris({.blades = 5, .rotation_deg = 3}), 6,
                                   {201, 151, 0.02, Projection::kPerspective}, kSmall);
    for (int y = 0; y < 151; ++y) {
        for (int x = 0; x < 201; ++x) {
            ASSERT_EQ(psf.kernel.at(x, y, 0), psf.kernel.at(200 - x, 150 - y, 0));
        }
    }
}

struct Counter : Progress {
    void report(std::string_view, double fraction) override {
        EXPECT_GE(fraction, last);
        last = fraction;
    }
    bool cancelled() const override { return last >= stop_at; }
    double last = 0;
    double stop_at = 2;
};

TEST(Starburst, ReportsAndStops) {
    const wave::KernelGrid grid{31, 31, 0.02, Projection::kPerspective};
    Counter counter;
    starburst_psf(Iris(), 5, grid, {.samples = 256}, nullptr, &counter);
    EXPECT_EQ(counter.last, 1);
    Counter stopping;
    stopping.stop_at = 0.3;
    EXPECT_THROW(starburst_psf(Iris(), 5, grid, {.samples = 256}, nullptr, &stopping), Cancelled);
}

TEST(Starburst, SaysWhatIsWrong) {
    const wave::KernelGrid grid{31, 31, 0.02, Projection::kPerspective};
    const auto with = [&](const StarburstOptions& options) {
        return starburst_psf(Iris(), 5, grid, options);
    };
    EXPECT_THROW(with({.samples = 128}), InvalidArgument);
    EXPECT_THROW(with({.samples = 1023}), InvalidArgument);
    EXPECT_THROW(with({.samples = 1034}), InvalidArgument);  // 2 * 11 * 47
    EXPECT_THROW(with({.samples = 32768}), InvalidArgument);
    EXPECT_THROW(with({.samples = 256, .bands = -1}), InvalidArgument);
    EXPECT_THROW(with({.samples = 256, .bands = 5000}), InvalidArgument);
    for (const double diameter_mm : {0.0, -1.0, std::nan("")}) {
        EXPECT_THROW(starburst_psf(Iris(), diameter_mm, grid), InvalidArgument);
    }
    EXPECT_THROW(starburst_psf(Iris(), 5, {30, 31, 0.02, Projection::kPerspective}),
                 InvalidArgument);
    EXPECT_THROW(starburst_psf(Iris(), 5, {31, 31, 0, Projection::kPerspective}), InvalidArgument);
    const Occluder opaque(Image(8, 8, 1).view(), 10);
    EXPECT_THROW(starburst_psf(Iris(), 5, grid, {.samples = 256}, &opaque), InvalidArgument);
}

}  // namespace
}  // namespace aureole::lens
