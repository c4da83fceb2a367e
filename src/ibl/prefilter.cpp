#include "aureole/ibl/prefilter.h"

#include <algorithm>
#include <cstring>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/ibl/roughness.h"
#include "ibl/filter_options.h"
#include "ibl/level_filter.h"
#include "ibl/shrink.h"

namespace aureole::ibl {
namespace {

constexpr int kReferenceSamples = 1024;
constexpr int kSamples = 32;

void check(int size, const PrefilterOptions& options) {
    check_levels(size, options.roughness);
    for (const int samples : options.samples) check_count("samples", samples, kMostSamples);
    check_fis(options.fis_overlap, options.fis_bias);
}

int samples_of(const PrefilterOptions& options, std::size_t level) {
    if (options.samples.empty()) {
        return options.method == FilterMethod::kReference ? kReferenceSamples : kSamples;
    }
    return options.samples[std::min(level, options.samples.size() - 1)];
}

std::unique_ptr<LevelFilter> make_filter(int size, const std::vector<FilteredLevel>& levels,
                                         const PrefilterOptions& options) {
    switch (options.method) {
        case FilterMethod::kGather:
            return make_gather_filter(size, levels, options.quality);
        case FilterMethod::kExact:
            return make_exact_filter(size, levels);
        default:
            return make_sampling_filter(size, levels, options);
    }
}

// How many tiles are done between two looks at the progress.
constexpr std::size_t kTilesAtOnce = 48;

}  // namespace

struct Prefilter::Impl {
    int size = 0;
    std::vector<int> sizes;  // texels per side of each level
    std::vector<int> index;  // of each level in the filter's list; -1: roughness 0
    std::unique_ptr<LevelFilter> filter;

    std::size_t all_tiles() const {
        std::size_t count = 0;
        for (const int side : sizes) count += static_cast<std::size_t>(tile_count(side));
        return count;
    }

    void fill_tile(const CubeMap& environment, std::size_t level, int number, int worker,
                   CubeMap& out) const noexcept {
        const Tile tile = tile_at(number, sizes[level]);
        if (index[level] >= 0) {
            filter->filter(index[level], tile, worker, out);
        } else {
            shrink_tile(environment, tile, out);
        }
    }

    // Calls after_batch(tiles done) now and then.
    template <class AfterBatch>
    void run(const CubeMap& environment, CubeChain& chain, std::size_t batch,
             const AfterBatch& after_batch) const {
        filter->prepare(environment);
        std::size_t done = 0;
        for (std::size_t level = 0; level < sizes.size(); ++level) {
            CubeMap& out = chain[level];
            const auto tiles = static_cast<std::size_t>(tile_count(sizes[level]));
            if (index[level] < 0 && out.size() == environment.size()) {
                std::memcpy(out.stacked().plane(0), environment.stacked().plane(0),
                            3 * out.stacked().pixels() * sizeof(float));
                done += tiles;
                continue;
            }
            for (std::size_t first = 0; first < tiles; first += batch) {
                const std::size_t count = std::min(batch, tiles - first);
                parallel_for(count, [&](std::size_t i, int worker) {
                    fill_tile(environment, level, static_cast<int>(first + i), worker, out);
                });
                done += count;
                after_batch(done);
            }
        }
    }
};

Prefilter::Prefilter(int size, const PrefilterOptions& options) : impl_(std::make_unique<Impl>()) {
    check(size, options);
    impl_->size = size;
    std::vector<FilteredLevel> filtered;
    for (std::size_t level = 0; level < options.roughness.size(); ++level) {
        const int side = std::max(1, size >> level);
        impl_->sizes.push_back(side);
        if (options.roughness[level] > 0) {
            impl_->index.push_back(static_cast<int>(filtered.size()));
            filtered.push_back(
                {side, alpha_from_roughness(options.roughness[level]), samples_of(options, level)});
        } else {
            impl_->index.push_back(-1);
        }
    }
    impl_->filter = make_filter(size, filtered, options);
}

Prefilter::~Prefilter() = default;
Prefilter::Prefilter(Prefilter&&) noexcept = default;
Prefilter& Prefilter::operator=(Prefilter&&) noexcept = default;

int Prefilter::size() const noexcept { return impl_->size; }
int Prefilter::levels() const noexcept { return static_cast<int>(impl_->sizes.size()); }

CubeChain Prefilter::make_chain() const {
    CubeChain chain;
    for (const int side : impl_->sizes) chain.emplace_back(side);
    return chain;
}

void Prefilter::run(const CubeMap& environment, CubeChain& chain) noexcept {
    impl_->run(environment, chain, impl_->all_tiles(), [](std::size_t) {});
}

void Prefilter::run(const CubeMap& environment, CubeChain& chain, Progress& progress) {
    const auto all = static_cast<double>(impl_->all_tiles());
    impl_->run(environment, chain, kTilesAtOnce, [&](std::size_t done) {
        progress.report("filter", static_cast<double>(done) / all);
        if (progress.cancelled()) throw Cancelled();
    });
}

}  // namespace aureole::ibl
