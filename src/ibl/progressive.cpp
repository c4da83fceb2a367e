#include "aureole/ibl/progressive.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/ibl/roughness.h"
#include "ibl/bordered_chain.h"
#include "ibl/filter_options.h"
#include "ibl/lobe_taps.h"
#include "ibl/sample_points.h"
#include "ibl/sampling_kernels.h"
#include "ibl/tile.h"

namespace aureole::ibl {
namespace {

constexpr int kMostSamplesPerPass = 1024;
// Samples of one texel of every tile that a thread adds between two looks at the clock; about a
// tenth of a millisecond.
constexpr int kTileSamplesPerStep = 512;

void check(int size, const ProgressiveOptions& options) {
    check_levels(size, options.roughness);
    check_count("samples", options.samples, kMostSamples);
    check_count("samples_per_pass", options.samples_per_pass, kMostSamplesPerPass);
    if (!(options.tolerance >= 0 && options.tolerance < 1)) {
        throw InvalidArgument("tolerance", fmt::format("{}", options.tolerance),
                              "must be in [0, 1)");
    }
    check_fis(options.fis_overlap, options.fis_bias);
}

double fraction(double value) { return value - std::floor(value); }

int power_of_2(int least) { return static_cast<int>(std::bit_ceil(static_cast<unsigned>(least))); }

// Samples first to first + count of a texel.
struct Pass {
    int number = 0;
    int first = 0;
    int count = 0;
};

// What a pass needs that is shared by all levels.
class Sequence {
  public:
    Sequence() = default;
    Sequence(SampleSequence kind, int samples) : kind_(kind), samples_(samples) {
        if (kind != SampleSequence::kHammersley) return;
        const auto count = static_cast<std::uint32_t>(samples);
        const int digits = std::bit_width(count - 1);
        for (std::uint32_t place = 0; place < std::bit_ceil(count); ++place) {
            const std::uint32_t index = hammersley_index(place, digits);
            if (index < count) order_.push_back(index);
        }
    }

    SquarePoint point(const Pass& pass, int i) const noexcept {
        const auto index = static_cast<std::uint32_t>(i);
        const auto count = static_cast<std::uint32_t>(pass.count);
        switch (kind_) {
            case SampleSequence::kHammersley:
                return hammersley(order_[static_cast<std::size_t>(pass.first + i)],
                                  static_cast<std::uint32_t>(samples_));
            case SampleSequence::kRotated: {
                // 1 / p and 1 / p^2 of p^3 = p + 1.
                constexpr double kTurn = 0.75487766624669276;
                constexpr double kShift = 0.56984029099805327;
                const SquarePoint point = hammersley(index, count);
                return {fraction(point.x + kTurn * pass.number),
                        fraction(point.y + kShift * pass.number)};
            }
            case SampleSequence::kMultiJittered:
                break;
        }
        return multi_jittered(index, count, static_cast<std::uint32_t>(pass.number));
    }

  private:
    SampleSequence kind_ = SampleSequence::kHammersley;
    int samples_ = 1;
    std::vector<std::uint32_t> order_;  // of Hammersley's set
};

struct Level {
    std::size_t index = 0;  // in the chain
    int size = 0;
    Lobe lobe;
    std::vector<LobeTap> taps;  // of the pass; room for the longest
};

// A tile of one level, and how much the last pass changed it.
struct Work {
    std::size_t level = 0;
    Tile tile;
    double change2 = 0;
    double sum = 0;
};

// Moves the means in `out` by `share` of what is missing to `colors`.
void move_means(const TileColors& colors, float share, Work& work, CubeMap& out) {
    const Tile& tile = work.tile;
    double change2 = 0;
    double sum = 0;
    for (int y = 0; y < tile.height; ++y) {
        for (int c = 0; c < 3; ++c) {
            float* row = out.row(tile.face, tile.y + y, c) + tile.x;
            for (int x = 0; x < tile.width; ++x) {
                const float color = colors.rgb[y * tile.width + x][c];
                const float step = share * (color - row[x]);
                // The first samples replace what was there, of which rounding would leave a trace.
                row[x] = share == 1 ? color : row[x] + step;
                change2 += static_cast<double>(step) * static_cast<double>(step);
                sum += static_cast<double>(row[x]);
            }
        }
    }
    work.change2 = change2;
    work.sum = sum;
}

}  // namespace

struct ProgressiveFilter::Impl {
    int size = 0;
    ProgressiveOptions options;
    Sequence sequence;
    EnvironmentMips mips;
    FisLevel fis;
    std::vector<Level> filtered;
    std::vector<Work> works;  // level by level
    CubeChain result;

    int samples = 0;       // of complete passes
    Pass pass;             // count 0: none is open
    std::size_t next = 0;  // of works, in the open pass
    int passes = 0;        // complete ones
    double change = 1;

    // Levels as they are without samples.
    void restart() noexcept {
        samples = passes = 0;
        pass = {};
        next = 0;
        change = 1;
        for (std::size_t k = 0; k < result.size(); ++k) {
            const BorderedLevel& level = mips.chain().levels()[k];
            CubeMap& out = result[k];
            parallel_for(static_cast<std::size_t>(kFaces * level.size), [&](std::size_t row, int) {
                const int face = static_cast<int>(row) / level.size;
                const int y = static_cast<int>(row) % level.size;
                const float* texel =
                    mips.chain().texels() + std::size_t{kTexelFloats} * level.texel(face, 0, y);
                for (int x = 0; x < level.size; ++x, texel += kTexelFloats) {
                    for (int c = 0; c < 3; ++c) out.row(face, y, c)[x] = texel[c];
                }
            });
        }
    }

    bool converged() const noexcept {
        return works.empty() || samples >= options.samples ||
               (options.tolerance > 0 && passes > 1 && change < options.tolerance);
    }

    void open_pass(int count) noexcept {
        pass = {passes, samples, count};
        next = 0;
        const int fitted = options.levels == SampleLevels::kFinal
                               ? options.samples
                               : std::min(options.samples, power_of_2(samples + count));
        for (Level& level : filtered) {
            level.taps.clear();
            for (int i = 0; i < count; ++i) {
                const Lobe::Sample sample = level.lobe.sample(sequence.point(pass, i));
                level.taps.push_back(
                    make_tap(sample, 1.0 / count, fis.of(sample.density_per_sr, fitted)));
            }
        }
    }

    void close_pass() noexcept {
        samples += pass.count;
        ++passes;
        pass.count = 0;
        change = passes > 1 ? largest_change() : 1;
    }

    double largest_change() const noexcept {
        double largest = 0;
        auto work = works.begin();
        for (std::size_t k = 0; k < filtered.size(); ++k) {
            double change2 = 0;
            double sum = 0;
            for (; work != works.end() && work->level == k; ++work) {
                change2 += work->change2;
                sum += work->sum;
            }
            const double values = 3.0 * kFaces * filtered[k].size * filtered[k].size;
            const double mean = std::abs(sum) / values;
            if (change2 > 0) largest = std::max(largest, std::sqrt(change2 / values) / mean);
        }
        return largest;
    }

    // Some tiles of the open pass.
    void step(std::size_t tiles) noexcept {
        const std::size_t count = std::min(tiles, works.size() - next);
        const auto share =
            static_cast<float>(static_cast<double>(pass.count) / (samples + pass.count));
        parallel_for(count, [&](std::size_t i, int) {
            Work& work = works[next + i];
            const Level& level = filtered[work.level];
            TileColors colors;
            sampling_kernels().sum_taps(mips.chain(), level.taps, work.tile, level.size, colors);
            move_means(colors, share, work, result[level.index]);
        });
        next += count;
        if (next == works.size()) close_pass();
    }
};

ProgressiveFilter::ProgressiveFilter(int size, const ProgressiveOptions& options)
    : impl_(std::make_unique<Impl>()) {
    check(size, options);
    impl_->size = size;
    impl_->options = options;
    impl_->sequence = Sequence(options.sequence, options.samples);
    impl_->mips = EnvironmentMips(size, most_levels(size));
    impl_->fis = {size, most_levels(size), options.fis_overlap, options.fis_bias};
    for (std::size_t k = 0; k < options.roughness.size(); ++k) {
        const int side = std::max(1, size >> k);
        impl_->result.emplace_back(side);
        if (options.roughness[k] == 0) continue;
        Level& level = impl_->filtered.emplace_back(Level{
            k, side, Lobe(alpha_from_roughness(options.roughness[k]), LobeDensity::kLight), {}});
        level.taps.reserve(static_cast<std::size_t>(options.samples_per_pass));
        for (int i = 0; i < tile_count(side); ++i) {
            impl_->works.push_back({impl_->filtered.size() - 1, tile_at(i, side), 0, 0});
        }
    }
    set_environment(CubeMap(size));
}

ProgressiveFilter::~ProgressiveFilter() = default;
ProgressiveFilter::ProgressiveFilter(ProgressiveFilter&&) noexcept = default;
ProgressiveFilter& ProgressiveFilter::operator=(ProgressiveFilter&&) noexcept = default;

int ProgressiveFilter::size() const noexcept { return impl_->size; }
int ProgressiveFilter::levels() const noexcept { return static_cast<int>(impl_->result.size()); }
int ProgressiveFilter::samples() const noexcept { return impl_->samples; }
double ProgressiveFilter::change() const noexcept { return impl_->change; }
bool ProgressiveFilter::converged() const noexcept { return impl_->converged(); }
const CubeChain& ProgressiveFilter::result() const noexcept { return impl_->result; }

void ProgressiveFilter::set_environment(const CubeMap& environment) noexcept {
    impl_->mips.fill(environment);
    impl_->restart();
}

void ProgressiveFilter::advance(int samples_per_texel) noexcept {
    Impl& impl = *impl_;
    for (int left = samples_per_texel; left > 0 && !impl.converged();) {
        if (impl.pass.count == 0) {
            impl.open_pass(std::min(
                {left, impl.options.samples_per_pass, impl.options.samples - impl.samples}));
        }
        left -= impl.pass.count;
        impl.step(impl.works.size());
    }
}

void ProgressiveFilter::advance_for(double milliseconds) noexcept {
    using Clock = std::chrono::steady_clock;
    using Milliseconds = std::chrono::duration<double, std::milli>;
    Impl& impl = *impl_;
    const Clock::time_point start = Clock::now();
    double spent = 0;
    double longest = 0;
    while (!impl.converged() && (spent == 0 || spent + longest < milliseconds)) {
        if (impl.pass.count == 0) {
            impl.open_pass(
                std::min(impl.options.samples_per_pass, impl.options.samples - impl.samples));
        }
        impl.step(static_cast<std::size_t>(thread_count() *
                                           std::max(1, kTileSamplesPerStep / impl.pass.count)));
        const double now = Milliseconds(Clock::now() - start).count();
        longest = std::max(longest, now - spent);
        spent = now;
    }
}

}  // namespace aureole::ibl
