#include "glare/cost_model.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>

#include "aureole/base/parallel.h"
#include "aureole/sources/brightness_histogram.h"
#include "glare/hybrid.h"
#include "glare/sprite_painter.h"

namespace aureole::glare {
namespace {

constexpr int kWidth = 1024;
constexpr int kHeight = 512;
constexpr int kRounds = 3;
constexpr double kPixels = double{kWidth} * kHeight;

// The least of a few: what else the machine does only adds.
template <class Body>
double least_seconds(int rounds, const Body& body) {
    double least = INFINITY;
    for (int round = 0; round < rounds; ++round) {
        const double start = clock_seconds();
        body();
        least = std::min(least, clock_seconds() - start);
    }
    return least;
}

Image wide_kernel(int radius) {
    Image kernel(2 * radius + 1, 2 * radius + 1, 1);
    for (int y = 0; y < kernel.height(); ++y) {
        for (int x = 0; x < kernel.width(); ++x) {
            const double r = std::hypot(x - radius, y - radius);
            kernel.at(x, y) = static_cast<float>(1e-3 / (1 + r * r));
        }
    }
    return kernel;
}

void fill(Image& light, float value) {
    for (int c = 0; c < light.channels(); ++c) {
        std::fill_n(light.plane(c), light.pixels(), value);
    }
}

// Clusters in a grid, between pixels or on them.
std::vector<sources::Cluster> clusters_in_grid(double fraction) {
    constexpr int kStep = 64;
    std::vector<sources::Cluster> clusters;
    for (int y = kStep / 2; y < kHeight; y += kStep) {
        for (int x = kStep / 2; x < kWidth; x += kStep) {
            sources::Cluster cluster;
            cluster.centroid_x = x + 0.5 + fraction;
            cluster.centroid_y = y + 0.5 + fraction;
            cluster.energy = {1, 1, 1};
            clusters.push_back(cluster);
        }
    }
    return clusters;
}

// Seconds to draw a layer's sprites, and their work.
struct Drawing {
    double seconds = 0;
    SpriteWork work;
};

Drawing drawing_of(SpriteLayer& layer, double fraction, std::vector<Buffer>& scratch) {
    Drawing drawing;
    drawing.work = layer.make(clusters_in_grid(fraction), 0).work;
    drawing.seconds = least_seconds(kRounds, [&] {
        parallel_for(layer.tiles().size(), [&](std::size_t i, int worker) {
            layer.draw(i, layer.tiles().cleared_tile(
                              i, 3, scratch[static_cast<std::size_t>(worker)].data()));
        });
    });
    return drawing;
}

void measure_drawing(MachineSpeed& speed) {
    std::vector<Buffer> scratch(static_cast<std::size_t>(max_workers()));
    for (Buffer& buffer : scratch) buffer = Buffer(3 * SpriteTiles::kPlane);
    constexpr int kSmall = 8;
    constexpr int kLarge = 100;
    SpriteLayer large(kWidth, kHeight, 3, 1, 0, wide_kernel(kLarge), 1);
    SpriteLayer small(kWidth, kHeight, 3, 1, 0, wide_kernel(kSmall), 1);
    const Drawing one = drawing_of(large, 0, scratch);
    const Drawing four = drawing_of(large, 0.25, scratch);
    const Drawing rows = drawing_of(small, 0, scratch);
    const Drawing none = [&] {
        Drawing drawing;
        large.make({}, 0);
        drawing.seconds = least_seconds(kRounds, [&] {
            parallel_for(large.tiles().size(), [&](std::size_t i, int worker) {
                large.draw(i, large.tiles().cleared_tile(
                                  i, 3, scratch[static_cast<std::size_t>(worker)].data()));
            });
        });
        return drawing;
    }();
    speed.row = std::max(0.0, rows.seconds - none.seconds) / rows.work.rows;
    const auto per_pixel = [&](const Drawing& drawing) {
        const double left = drawing.seconds - none.seconds - speed.row * drawing.work.rows;
        return std::max(left, 0.2 * drawing.seconds) / drawing.work.pixels();
    };
    speed.one_tap = per_pixel(one);
    speed.four_taps = per_pixel(four);
}

void measure_painting(MachineSpeed& speed) {
    constexpr int kRadius = 32;
    SpriteOptions options;
    options.clusters.dim_limit = 0.5F;
    SpritePainter painter(kWidth, kHeight, 3, wide_kernel(kRadius), options, nullptr);
    Image light(kWidth, kHeight, 3);
    Image out(kWidth, kHeight, 3);
    fill(light, 0.25F);
    fill(out, 0);
    sources::BrightnessHistogram histogram;
    speed.histogram = least_seconds(kRounds, [&] { histogram.measure(light, nullptr); }) / kPixels;
    painter.plan(light, nullptr, histogram);
    speed.tile =
        least_seconds(kRounds, [&] { painter.draw(light, out, nullptr, histogram); }) / kPixels;
    // Pixels alone, in one block of three.
    for (int y = 0; y < kHeight; y += 4) {
        for (int x = (y / 16 % 3) * 16; x < kWidth; x += 48) {
            for (int c = 0; c < 3; ++c) light.at(x, y, c) = 1;
        }
    }
    histogram.measure(light, nullptr);
    SpritePainter::Plan plan;
    const double planning =
        least_seconds(kRounds, [&] { plan = painter.plan(light, nullptr, histogram); });
    speed.search = planning / histogram.blocks_above(0.5F);
    const double drawing =
        least_seconds(kRounds, [&] { painter.draw(light, out, nullptr, histogram); });
    speed.core =
        std::max(0.0, drawing - kPixels * speed.tile - drawing_seconds(speed, plan.work, 3)) /
        plan.core_pixels;
}

void measure_far(MachineSpeed& speed) {
    constexpr int kScale = 4;
    FarKernel kernel;
    kernel.scale = kScale;
    kernel.coarse = wide_kernel(2);
    kernel.roughness.sum = 1;
    FarLayer far(kWidth, kHeight, 3, kernel);
    Image light(kWidth, kHeight, 3);
    fill(light, 0);
    light.at(kWidth / 2, kHeight / 2, 0) = 1;
    sources::BrightnessHistogram histogram;
    histogram.measure(light, nullptr);
    far.plan(light, nullptr, histogram, 0, 1, 0);
    std::vector<Buffer> scratch(static_cast<std::size_t>(max_workers()));
    for (Buffer& buffer : scratch) buffer = Buffer(3 * SpriteTiles::kPlane);
    const SpriteTiles tiles(kWidth, kHeight);
    speed.far = least_seconds(kRounds,
                              [&] {
                                  far.draw();
                                  parallel_for(tiles.size(), [&](std::size_t i, int worker) {
                                      far.add_to(tiles.cleared_tile(
                                          i, 3, scratch[static_cast<std::size_t>(worker)].data()));
                                  });
                              }) /
                kPixels;
}

MachineSpeed measured() {
    MachineSpeed speed;
    measure_drawing(speed);
    measure_painting(speed);
    measure_far(speed);
    return speed;
}

}  // namespace

double clock_seconds() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
}

const MachineSpeed& machine_speed() {
    static std::mutex mutex;
    static std::map<int, MachineSpeed> speeds;
    const std::lock_guard lock(mutex);
    const auto found = speeds.find(thread_count());
    if (found != speeds.end()) return found->second;
    return speeds.emplace(thread_count(), measured()).first->second;
}

double transform_seconds(fourier::Convolver& convolver) {
    Image light(convolver.width(), convolver.height(), convolver.channels());
    fill(light, 1);
    constexpr int kRuns = 2;
    return least_seconds(kRuns, [&] { convolver.run(light, light); });
}

double drawing_seconds(const MachineSpeed& speed, const SpriteWork& work, int channels) {
    const double share = channels / 3.0;
    return share * (speed.one_tap * work.one_tap_pixels + speed.four_taps * work.four_tap_pixels +
                    speed.row * work.rows);
}

}  // namespace aureole::glare
