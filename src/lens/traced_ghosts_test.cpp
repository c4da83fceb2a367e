// Traced ghosts as pictures: laws that hold whatever the lens.
#include "lens/traced_ghosts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/parallel.h"
#include "aureole/color/spectrum.h"
#include "aureole/lens/paraxial.h"
#include "lens/traced_test_support.h"

namespace aureole::lens {
namespace {

double sum_of_differences(const Image& a, const Image& b) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < a.pixels(); ++k) {
            sum += std::abs(static_cast<double>(a.plane(c)[k]) - b.plane(c)[k]);
        }
    }
    return sum;
}

bool is_finite(const Image& image) {
    for (int c = 0; c < image.channels(); ++c) {
        const float* plane = image.plane(c);
        if (!std::all_of(plane, plane + image.pixels(), [](float v) { return std::isfinite(v); })) {
            return false;
        }
    }
    return true;
}

struct Moments {
    double sum = 0, x = 0, y = 0, xx = 0, yy = 0;
};

Moments moments_of(const Image& image) {
    Moments m;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const double v = image.at(x, y, 0) + image.at(x, y, 1) + image.at(x, y, 2);
            m.sum += v;
            m.x += v * x;
            m.y += v * y;
            m.xx += v * x * x;
            m.yy += v * y * y;
        }
    }
    m.x /= m.sum;
    m.y /= m.sum;
    m.xx = m.xx / m.sum - m.x * m.x;
    m.yy = m.yy / m.sum - m.y * m.y;
    return m;
}

TEST(TracedGhosts, AreTheSameOnAnyNumberOfThreads) {
    FlareOptions options;
    options.wavelengths = 2;
    options.rays_per_side = 48;
    Bench bench("heliar", 320, options);
    for (const double diameter_deg : {0.0, 0.6}) {
        const sources::Light light = bench.light(4, 3, diameter_deg);
        const Image many = bench.draw(light, bench.all(1));
        Image one;
        {
            const ThreadLimit limit(1);
            one = bench.draw(light, bench.all(1));
        }
        for (int c = 0; c < 3; ++c) {
            EXPECT_TRUE(std::equal(one.plane(c), one.plane(c) + one.pixels(), many.plane(c)));
        }
    }
}

// The single ghost of a thin lens at a small stop is what linear optics says: a disc of one
// brightness, (T_g / T_0) L W f^2 / (A^2 A_EP).
TEST(TracedGhosts, OfASingleLensMatchLinearOptics) {
    FlareOptions options;
    options.wavelengths = 1;
    LensSettings settings;
    settings.f_number = 32;
    settings.coating = "none";
    Bench bench(Lens(shipped_lens("biconvex"), settings), 960, options);
    ASSERT_EQ(bench.list.size(), 1U);
    sources::Light light = bench.light(0, 0);
    const Image ghost = bench.draw(light, 0);

    const double wavelength_nm = color::sample_spectrum(1).front().wavelength_nm;
    const double a = ghost_matrices(bench.lens, bench.list[0], wavelength_nm).to_sensor.x.a;
    // Bare glass reflects nearly the same at all wavelengths.
    const double index = bench.lens.indices(wavelength_nm)[2];
    const double r = std::pow((index - 1) / (index + 1), 2);
    const double pixel = bench.film.mm_per_px;
    const double radiance =
        r * r * light.solid_angle_sr / (a * a * bench.film.irradiance_per_radiance);
    const double radius_px = std::abs(a) * bench.lens.stop_radius_mm() / pixel;
    ASSERT_GT(radius_px, 20);
    const auto in_middle =
        ghost.at(static_cast<int>(bench.film.axis_x), static_cast<int>(bench.film.axis_y), 1);
    EXPECT_NEAR(in_middle / radiance, 1, 0.01);
    EXPECT_NEAR(sum_of(ghost) / (3 * radiance * kPi * radius_px * radius_px), 1, 0.02);
}

TEST(TracedGhosts, ConvergeWithTheNumberOfRays) {
    FlareOptions options;
    options.wavelengths = 2;
    const auto render = [&](int rays) {
        options.rays_per_side = rays;
        Bench bench("biotar", 320, options);
        return bench.draw(bench.light(5, 2), bench.all());
    };
    const Image reference = render(300);
    const double total = sum_of(reference);
    const double coarse = sum_of_differences(render(32), reference) / total;
    const double middle = sum_of_differences(render(64), reference) / total;
    const double fine = sum_of_differences(render(128), reference) / total;
    EXPECT_LT(coarse, 0.06);
    EXPECT_LT(middle, 0.03);
    EXPECT_LT(fine, 0.015);
}

// Coarse levels keep the energy of what lies inside the picture.
TEST(TracedGhosts, KeepTheirEnergyAtAnyLevel) {
    FlareOptions options;
    options.wavelengths = 1;
    LensSettings settings;
    settings.f_number = 16;
    // A picture so wide that it holds most ghosts.
    Bench bench(Lens(shipped_lens("tessar"), settings), 480, options, {}, 200);
    const sources::Light light = bench.light(3, 1);
    int checked = 0;
    for (std::size_t g = 0; g < bench.list.size(); ++g) {
        const Image fine = bench.draw(light, static_cast<int>(g));
        const Moments m = moments_of(fine);
        const double reach = 3 * std::sqrt(std::max(m.xx, m.yy)) + 16;
        if (!(m.sum > 0) || m.x < reach || m.x > 480 - reach || m.y < reach || m.y > 270 - reach) {
            continue;
        }
        for (const int level : {1, 2}) {
            EXPECT_NEAR(sum_of(bench.draw(light, static_cast<int>(g), level)) / m.sum, 1, 2e-3)
                << g << " at level " << level;
        }
        ++checked;
    }
    EXPECT_GT(checked, 3);
}

// A light of finite size makes what as many points would make together. What cannot be had by a
// blur is that the shape of a ghost changes over the light; such ghosts are known by their energy.
TEST(TracedGhosts, AreBlurredByTheSizeOfTheLight) {
    FlareOptions options;
    options.wavelengths = 1;
    options.rays_per_side = 48;
    LensSettings settings;
    settings.f_number = 22;
    Bench bench(Lens(shipped_lens("tessar"), settings), 480, options, {}, 200);
    const sources::Light point = bench.light(2, 1);
    sources::Light disc = bench.light(2, 1, 3);
    disc.solid_angle_sr = point.solid_angle_sr;  // the same energy
    const double radius = 2 * std::sqrt(disc.moment_xx);
    int checked = 0;
    for (std::size_t g = 0; g < bench.list.size(); ++g) {
        const Moments sharp = moments_of(bench.draw(point, static_cast<int>(g)));
        if (!(sharp.sum > 0)) continue;
        const Moments blurred = moments_of(bench.draw(disc, static_cast<int>(g)));
        Image mean(bench.view.width, bench.view.height, 3);
        int points = 0;
        bool even = true;
        for (int j = -3; j <= 3; ++j) {
            for (int i = -3; i <= 3; ++i) {
                if (i * i + j * j > 12) continue;
                sources::Light one = point;
                one.tan_x += radius * i / 3.5;
                one.tan_y += radius * j / 3.5;
                const Image of_one = bench.draw(one, static_cast<int>(g));
                even = even && std::abs(sum_of(of_one) / sharp.sum - 1) < 0.01;
                for (int c = 0; c < 3; ++c) {
                    for (std::size_t k = 0; k < mean.pixels(); ++k) {
                        mean.plane(c)[k] += of_one.plane(c)[k];
                    }
                }
                ++points;
            }
        }
        ASSERT_EQ(points, 37);
        const Moments expected = moments_of(mean);
        EXPECT_NEAR(blurred.sum / sharp.sum, 1, 2e-3) << g;
        if (!even) continue;
        EXPECT_NEAR(blurred.x, expected.x, 0.5) << g;
        EXPECT_NEAR(blurred.y, expected.y, 0.5) << g;
        // Coarse levels, on which large blurs are drawn, add up to a pixel of theirs.
        EXPECT_NEAR(blurred.xx, expected.xx, 4 + 0.1 * (expected.xx - sharp.xx)) << g;
        EXPECT_NEAR(blurred.yy, expected.yy, 4 + 0.1 * (expected.yy - sharp.yy)) << g;
        ++checked;
    }
    EXPECT_GT(checked, 7);
}

TEST(TracedGhosts, MoveContinuouslyWithTheirLight) {
    FlareOptions options;
    options.wavelengths = 1;
    options.rays_per_side = 64;
    LensSettings settings;
    settings.f_number = 5.6;
    Bench bench("heliar", 320, options, settings);
    double before = 0;
    for (int step = 0; step < 12; ++step) {
        // Across the picture's edge.
        const sources::Light light =
            sources::light_at(bench.view, 319.6 + 0.1 * step, 100, {1, 1, 1});
        const double now = sum_of(bench.draw(light, bench.all()));
        if (step > 0) {
            EXPECT_NEAR(now / before, 1, 0.01) << step;
        }
        before = now;
    }
}

// The estimate of what linear optics gets wrong, against whole pictures of each ghost.
TEST(TracedGhosts, CompareAsWholePicturesDo) {
    for (const char* lens : {"heliar", "biotar"}) {
        FlareOptions options;
        options.wavelengths = 6;
        options.method = GhostMethod::kHybrid;
        Bench bench(lens, 320, options);
        const sources::Light light = bench.light(4, 3);
        MatrixGhosts matrix(bench.lens, bench.iris, bench.film, options, bench.list, nullptr);
        matrix.place(light);
        std::vector<GhostComparison> comparisons(bench.list.size());
        bench.ghosts.compare(light, matrix.placements(), comparisons);
        for (std::size_t g = 0; g < bench.list.size(); ++g) {
            const Image traced = bench.draw(light, static_cast<int>(g));
            Image linear(bench.view.width, bench.view.height, 3);
            bench.canvas.clear();
            const GhostDraw draw = {static_cast<int>(g), 0, {1, 1, 1}};
            matrix.draw({&draw, 1}, bench.canvas);
            bench.canvas.add_to(linear);
            const double energy = sum_of(traced);
            const double difference = sum_of_differences(linear, traced);
            if (!(energy > 0)) continue;
            EXPECT_NEAR(comparisons[g].energy / energy, 1, 0.05) << lens << " " << g;
            const double estimate = comparisons[g].difference / energy;
            const double truth = difference / energy;
            if (truth < 0.7) {
                EXPECT_NEAR(estimate, truth, 0.02 + 0.06 * truth) << lens << " " << g;
            } else {
                // Two pictures that have little in common, whatever the number.
                EXPECT_GT(estimate, 0.6) << lens << " " << g;
            }
        }
    }
}

// Dirt in front of half of the lens takes half of the light of a ghost on the axis.
TEST(TracedGhosts, SeeDirtAndPicturesOfIrises) {
    const Lens lens(shipped_lens("tessar"), {.f_number = 8});
    const View view = view_for(lens, 480);
    const Film film(lens, view);
    FlareOptions options;
    options.wavelengths = 1;
    const auto list = enumerate_ghosts(lens, GhostSet::kAll);
    Image half(64, 64, 1);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) half.at(x, y) = x < 32 ? 0.0F : 1.0F;
    }
    const Occluder dirt(half, 2 * lens.faces().front().semi_aperture_mm);
    Image disc(256, 256, 1);
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            disc.at(x, y) = std::hypot(x - 127.5, y - 127.5) < 90 ? 1.0F : 0.0F;
        }
    }
    const auto render = [&](const Iris& iris, const Occluder* occluder) {
        TracedGhosts ghosts(lens, iris, film, options, list, occluder);
        Canvas canvas(view.width, view.height);
        std::vector<GhostDraw> draws;
        for (std::size_t g = 0; g < list.size(); ++g) {
            draws.push_back({static_cast<int>(g), 0, {1, 1, 1}});
        }
        Image out(view.width, view.height, 3);
        ghosts.draw(
            sources::light_in_direction(0, 0, {1, 1, 1}, 0, view.pixel_solid_angle_sr(240, 135)),
            draws, canvas);
        canvas.add_to(out);
        return out;
    };
    const Image round = render(Iris(), nullptr);
    EXPECT_NEAR(sum_of(render(Iris(), &dirt)) / sum_of(round), 0.5, 0.005);
    const Image pictured = render(Iris(disc.view()), nullptr);
    EXPECT_NEAR(sum_of(pictured) / sum_of(round), 1, 0.01);
}

TEST(TracedGhostsSlow, AreNeverNan) {
    const double angles_deg[] = {0, 12, 35, 60, 80, 89};
    for (const ShippedLens& shipped : shipped_lenses()) {
        for (const double f_number : {0.0, 64.0}) {
            FlareOptions options;
            options.wavelengths = 1;
            options.rays_per_side = f_number > 0 ? 8 : 24;
            LensSettings settings;
            settings.f_number = f_number;
            Bench bench(Lens(shipped_lens(shipped.id), settings), 96, options, {.blades = 7});
            for (const double angle_deg : angles_deg) {
                const sources::Light light = bench.light(angle_deg, 0.2 * angle_deg, 0.3);
                EXPECT_TRUE(is_finite(bench.draw(light, bench.all())))
                    << shipped.id << " f/" << f_number << " at " << angle_deg << " deg";
            }
        }
    }
}

}  // namespace
}  // namespace aureole::lens
