#include "glare/cost_model.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>

#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/sources/brightness_histogram.h"

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

// Clusters all over what a layer shows, between pixels or on them.
std::vector<sources::Cluster> clusters_over(const SpriteLayer& layer, int count, double fraction,
                                            double energy) {
    std::vector<sources::Cluster> clusters;
    Random random(1);
    for (int i = 0; i < count; ++i) {
        const auto place = [&](int size) {
            const auto pixel = static_cast<int>(random.uniform(0, size)) - layer.margin();
            return layer.scale() * (pixel + 0.5 + fraction);
        };
        sources::Cluster cluster;
        cluster.centroid_x = place(layer.width());
        cluster.centroid_y = place(layer.height());
        cluster.energy.fill(static_cast<float>(energy));
        clusters.push_back(cluster);
    }
    return clusters;
}

class DrawingTimer {
  public:
    DrawingTimer(SpriteLayer& layer, int channels)
        : layer_(layer), channels_(channels), scratch_(static_cast<std::size_t>(max_workers())) {
        for (Buffer& buffer : scratch_) buffer = Buffer(3 * SpriteTiles::kPlane);
        empty_ = seconds({}, 0).seconds;
    }

    struct Drawing {
        double seconds = 0;  // beyond those of empty tiles
        SpriteWork work;
    };
    Drawing seconds(const std::vector<sources::Cluster>& clusters, double level) {
        Drawing drawing;
        drawing.work = layer_.make(clusters, level).work;
        const double all = least_seconds(kRounds, [&] {
            parallel_for(layer_.tiles().size(), [&](std::size_t i, int worker) {
                layer_.draw(i,
                            layer_.tiles().cleared_tile(
                                i, channels_, scratch_[static_cast<std::size_t>(worker)].data()));
            });
        });
        drawing.seconds = std::max(0.05 * all, all - empty_);
        return drawing;
    }

  private:
    SpriteLayer& layer_;
    int channels_;
    std::vector<Buffer> scratch_;
    double empty_ = 0;
};

// Drawing of sprites apart: what the passes over tiles cost.
class PaintingTimer {
  public:
    PaintingTimer()
        : painter_(kWidth, kHeight, 3, wide_kernel(kRadius), options(), nullptr),
          light_(kWidth, kHeight, 3),
          out_(kWidth, kHeight, 3) {
        fill(light_, kLimit / 2);
        fill(out_, 0);
        sprite_ = drawing_speed(painter_.near(), 3);
    }

    void add_square(int x0, int y0, int side) {
        for (int c = 0; c < 3; ++c) {
            for (int y = y0; y < y0 + side; ++y) std::fill_n(&light_.at(x0, y, c), side, 1.0F);
        }
    }

    // Seconds of drawing, without its sprites.
    double seconds() {
        histogram_.look(light_, nullptr);
        plan_seconds =
            least_seconds(kRounds, [&] { plan = painter_.plan(light_, nullptr, histogram_); });
        const double all =
            least_seconds(kRounds, [&] { painter_.draw(light_, out_, nullptr, histogram_); });
        return std::max(0.0, all - sprite_.seconds(plan.near));
    }

    SpritePainter::Plan plan;
    double plan_seconds = 0;

  private:
    static constexpr int kRadius = 32;
    static constexpr float kLimit = 0.5F;
    static SpriteOptions options() {
        SpriteOptions options;
        options.clusters.dim_limit = kLimit;
        options.clusters.max_side = 16;
        return options;
    }

    SpritePainter painter_;
    Image light_;
    Image out_;
    sources::BrightnessHistogram histogram_;
    DrawingSpeed sprite_;
};

void measure_painting(MachineSpeed& speed) {
    PaintingTimer timer;
    speed.pass = timer.seconds() / kPixels;
    // A light in every tile; then two squares.
    for (int y = SpriteTiles::kHeight / 2; y < kHeight; y += SpriteTiles::kHeight) {
        for (int x = SpriteTiles::kWidth / 2; x < kWidth; x += SpriteTiles::kWidth) {
            timer.add_square(x, y, 1);
        }
    }
    const double lit = timer.seconds();
    speed.lit = std::max(0.0, lit / kPixels - speed.pass);
    speed.search = timer.plan_seconds / static_cast<double>(timer.plan.report.bright_pixels);
    const double core_pixels = timer.plan.core_pixels;
    constexpr int kSquare = 64;
    timer.add_square(kWidth / 4, kHeight / 4, kSquare);
    timer.add_square(kWidth / 2, kHeight / 2, kSquare);
    speed.core = std::max(0.0, timer.seconds() - lit) / (timer.plan.core_pixels - core_pixels);
}

void measure_far(MachineSpeed& speed) {
    FarKernel kernel;
    kernel.scale = 4;
    kernel.coarse = wide_kernel(2);
    kernel.roughness.sum = 1;
    FarLayer far(kWidth, kHeight, 3, kernel);
    Image light(kWidth, kHeight, 3);
    fill(light, 0);
    sources::BrightnessHistogram histogram;
    histogram.measure(light, nullptr);
    far.plan(light, nullptr, histogram, {}, 1, 0);
    std::vector<Buffer> scratch(static_cast<std::size_t>(max_workers()));
    for (Buffer& buffer : scratch) buffer = Buffer(3 * SpriteTiles::kPlane);
    const SpriteTiles tiles(kWidth, kHeight);
    const auto add_to = [&](std::size_t i, int worker) {
        far.add_to(tiles.cleared_tile(i, 3, scratch[static_cast<std::size_t>(worker)].data()));
    };
    speed.far = least_seconds(kRounds,
                              [&] {
                                  far.draw();
                                  parallel_for(tiles.size(), add_to);
                              }) /
                kPixels;
}

MachineSpeed measured() {
    MachineSpeed speed;
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

DrawingSpeed drawing_speed(SpriteLayer& layer, int channels) {
    constexpr int kSmallRadius = 8;
    constexpr int kSmallSprites = 2000;
    constexpr int kLeastSprites = 24;
    constexpr double kPixelsDrawn = 1.5e7;
    DrawingTimer timer(layer, channels);
    const double area = typical_work(layer, layer.profile().end(), 0).pixels();
    const int count =
        std::clamp(static_cast<int>(kPixelsDrawn / area), kLeastSprites, kSmallSprites);
    const auto full = timer.seconds(clusters_over(layer, count, 0, 1), 0);
    const auto four = timer.seconds(clusters_over(layer, count, 0.25, 1), 0);
    // Ends of sprites lie where energy * k = 1.
    const double edge =
        layer.profile().largest_from(std::min(kSmallRadius, layer.profile().end() - 1));
    const auto small =
        timer.seconds(clusters_over(layer, kSmallSprites, 0, edge > 0 ? 1 / edge : 1), 1);
    // seconds = one_tap * pixels + row * rows, of large and small ones.
    const double p0 = full.work.one_tap_pixels;
    const double p1 = small.work.one_tap_pixels;
    const double determinant = p0 * small.work.rows - p1 * full.work.rows;
    DrawingSpeed speed;
    if (determinant > 0) {
        speed.row = std::max(0.0, (p0 * small.seconds - p1 * full.seconds) / determinant);
    }
    speed.row = std::min(speed.row, 0.9 * full.seconds / full.work.rows);
    speed.one_tap = (full.seconds - speed.row * full.work.rows) / p0;
    const double four_left = four.seconds - speed.row * four.work.rows;
    speed.four_taps = std::max(four_left / four.work.four_tap_pixels, speed.one_tap);
    return speed;
}

SpriteWork typical_work(const SpriteLayer& layer, double radius, double between_pixels) {
    const double width = std::min(2 * radius, static_cast<double>(layer.width()));
    const double height = std::min(2 * radius, static_cast<double>(layer.height()));
    SpriteWork work;
    const double area = std::min(kPi * radius * radius, width * height);
    work.four_tap_pixels = between_pixels * area;
    work.one_tap_pixels = area - work.four_tap_pixels;
    work.rows = height * (1 + width / SpriteTiles::kWidth);
    return work;
}

double transform_seconds(fourier::Convolver& convolver) {
    Image light(convolver.width(), convolver.height(), convolver.channels());
    fill(light, 1);
    return least_seconds(kRounds, [&] { convolver.run(light, light); });
}

}  // namespace aureole::glare
