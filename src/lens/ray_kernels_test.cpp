// Rays in SIMD against the exact tracer in double precision.
#include "lens/ray_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "aureole/base/buffer.h"
#include "aureole/lens/library.h"
#include "aureole/lens/trace.h"
#include "lens/test_lenses.h"
#include "lens/traced_ways.h"

namespace aureole::lens {
namespace {

struct Fields {
    explicit Fields(std::size_t count) : memory(5 * count) {
        float** const all[] = {&fields.x, &fields.y, &fields.u, &fields.v, &fields.clip};
        for (std::size_t k = 0; k < 5; ++k) *all[k] = memory.data() + k * count;
    }
    Buffer memory;
    RayFields fields;
};

RayBundle bundle_over(const Lens& lens, double tan_x, double tan_y, int side) {
    const Ray light = ray_from_light(tan_x, tan_y, 0, 0);
    RayBundle rays;
    for (std::size_t k = 0; k < 3; ++k) rays.direction[k] = static_cast<float>(light.direction[k]);
    const auto radius = static_cast<float>(lens.faces().front().semi_aperture_mm);
    rays.columns = rays.rows = side;
    rays.step_x_mm = rays.step_y_mm = 2 * radius / static_cast<float>(side - 1);
    rays.x_mm = rays.y_mm = -radius;
    return rays;
}

// Half the diagonal of a sheet of 4 x 5 inch film.
constexpr double kLargestSensorMm = 82;

struct Worst {
    double position_mm = 0, stop = 0, clip = 0, throughput = 0;
    int passing = 0, disagreements = 0;
    double mean_error = 0, mean = 0;
};

void compare(const Lens& lens, const Bounces& bounces, double tan_x, double tan_y,
             double wavelength_nm, Worst& worst) {
    const TracedWays ways(lens, std::span(&bounces, 1), std::span(&wavelength_nm, 1));
    const RayBundle rays = bundle_over(lens, tan_x, tan_y, 40);
    const int stride = ray_stride(rays.columns);
    const auto count = static_cast<std::size_t>(stride * rays.rows);
    Fields to(count);
    Buffer energy(count);
    const Iris iris;
    std::vector<RayStep> steps = ways.scratch();
    ray_kernels().trace(ways.way(0, 0, steps), ways.sensor_distance_mm(), rays, iris_field(iris),
                        to.fields);
    ray_kernels().throughput(ways.way(0, 0, steps), rays, energy.data());
    const Tracer tracer(lens, wavelength_nm);
    for (int row = 0; row < rays.rows; ++row) {
        for (int column = 0; column < rays.columns; ++column) {
            const auto at = static_cast<std::size_t>(row * stride + column);
            const Ray ray = ray_from_light(tan_x, tan_y,
                                           rays.x_mm + static_cast<float>(column) * rays.step_x_mm,
                                           rays.y_mm + static_cast<float>(row) * rays.step_y_mm);
            const TracedRay exact = tracer.trace(bounces, ray);
            const bool arrived = to.fields.clip[at] < kLostRay;
            if (arrived != (exact.fate == Fate::kArrived)) {
                // Only rays that pass no aperture anyway may differ: at the brink of total
                // reflection, or far out.
                if (std::min(exact.housing_clip, 2.0) < 0.999 && exact.fate == Fate::kArrived) {
                    ++worst.disagreements;
                }
                continue;
            }
            if (!arrived || exact.housing_clip > 1.2 || exact.stop_clip > 1.2) continue;
            // Rays that leave at grazing angles land metres off any sensor.
            if (std::hypot(exact.x_mm, exact.y_mm) > kLargestSensorMm) continue;
            ++worst.passing;
            worst.position_mm =
                std::max(worst.position_mm,
                         std::hypot(to.fields.x[at] - exact.x_mm, to.fields.y[at] - exact.y_mm));
            const double r = lens.stop_radius_mm();
            worst.stop = std::max(worst.stop, std::hypot(to.fields.u[at] - exact.stop_x_mm / r,
                                                         to.fields.v[at] - exact.stop_y_mm / r));
            const double clip =
                std::max<double>(to.fields.clip[at], std::hypot(to.fields.u[at], to.fields.v[at]));
            worst.clip = std::max(worst.clip,
                                  std::abs(clip - std::max(exact.housing_clip, exact.stop_clip)));
            const double exact_energy = tracer.throughput(bounces, ray);
            worst.mean += exact_energy;
            worst.mean_error += energy[at] - exact_energy;
        }
    }
}

TEST(RayKernels, FollowTheExactTracerThroughAllShippedLenses) {
    for (const ShippedLens& shipped : shipped_lenses()) {
        const Lens lens(shipped_lens(shipped.id));
        const std::vector<Bounces> ghosts = enumerate_ghosts(lens, GhostSet::kAll);
        Worst worst;
        const std::size_t step = ghosts.size() / 12 + 1;
        for (std::size_t g = 0; g < ghosts.size(); g += step) {
            compare(lens, ghosts[g], 0.12, 0.05, 500, worst);
            compare(lens, ghosts[g], 0, 0, 620, worst);
        }
        compare(lens, Bounces{}, 0.12, 0.05, 550, worst);
        EXPECT_GT(worst.passing, 50) << shipped.id;
        EXPECT_EQ(worst.disagreements, 0) << shipped.id;
        // Single precision: at the worst ray a quarter of a pixel of 1080p across the picture of a
        // normal field.
        EXPECT_LT(worst.position_mm, 5e-3 * lens.efl_mm() / 50) << shipped.id;
        EXPECT_LT(worst.stop, 1e-4) << shipped.id;
        EXPECT_LT(worst.clip, 2e-4) << shipped.id;
        EXPECT_LT(std::abs(worst.mean_error), 1e-3 * worst.mean) << shipped.id;
    }
}

}  // namespace
}  // namespace aureole::lens
