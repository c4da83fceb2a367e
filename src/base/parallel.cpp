#include "aureole/base/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <string>

#include "aureole/base/error.h"

namespace aureole {

struct ThreadLimit::Impl {
    tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) : impl_(nullptr) {
    if (threads < 0) {
        throw InvalidArgument("threads", std::to_string(threads), "must be 0 (all) or more");
    }
    if (threads > 0) {
        impl_ = new Impl{
            {tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)}};
    }
}

ThreadLimit::~ThreadLimit() { delete impl_; }

int max_workers() noexcept { return std::max(1, tbb::info::default_concurrency()); }

int thread_count() noexcept {
    const auto limit =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return std::clamp(static_cast<int>(limit), 1, max_workers());
}

void detail::parallel_for(std::size_t count, LoopBody body, void* context) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [=](const tbb::blocked_range<std::size_t>& range) {
            const int worker = std::max(0, tbb::this_task_arena::current_thread_index());
            for (std::size_t i = range.begin(); i != range.end(); ++i) body(context, i, worker);
        },
        tbb::simple_partitioner());
}

}  // namespace aureole
