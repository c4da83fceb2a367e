#include "aureole/base/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <string>

#include "aureole/base/error.h"

#if defined(AUREOLE_THREAD_SANITIZER)
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace aureole {
namespace {

// libtbb is not instrumented, so the thread sanitizer does not see its threads hand work to each
// other. This file is therefore not instrumented either (CMakeLists.txt), and says itself what it
// promises: what precedes a loop happens before its bodies, these before what follows the loop.
// Between the bodies nothing is promised, so a race there is found.
struct Moment {
#if defined(AUREOLE_THREAD_SANITIZER)
    void announce() { __tsan_release(this); }
    void observe() { __tsan_acquire(this); }
#else
    void announce() {}
    void observe() {}
#endif
};

// At the end of the scope, also when an exception leaves it.
struct AnnounceAtExit {
    Moment& moment;
    ~AnnounceAtExit() { moment.announce(); }
};
struct ObserveAtExit {
    Moment& moment;
    ~ObserveAtExit() { moment.observe(); }
};

}  // namespace

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

namespace {

// Of our own, so that worker indices stay below max_workers() whatever arena the caller is in.
tbb::task_arena& arena() {
    static tbb::task_arena own(max_workers());
    return own;
}

}  // namespace

void detail::parallel_for(std::size_t count, LoopBody body, void* context) {
    Moment begin;
    Moment end;
    const ObserveAtExit after{end};
    begin.announce();
    const auto run = [&](const tbb::blocked_range<std::size_t>& range) {
        begin.observe();
        const AnnounceAtExit body_done{end};
        const int worker = std::max(0, tbb::this_task_arena::current_thread_index());
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(context, i, worker);
    };
    arena().execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1), run,
                          tbb::simple_partitioner());
    });
}

}  // namespace aureole
