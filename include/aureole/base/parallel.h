// Parallel loops over independent items. Results never depend on the number of threads: each
// item writes its own output, and reductions are made over fixed chunks in a fixed order.
#pragma once

#include <cstddef>
#include <type_traits>

namespace aureole {

// Threads that parallel_for uses at most; every `worker` index is below it.
int thread_count() noexcept;

// Limits thread_count() for as long as the object lives (the --threads option). 0 means all
// hardware threads. Limits nest; the smallest wins.
class ThreadLimit {
  public:
    explicit ThreadLimit(int threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

  private:
    struct Impl;
    Impl* impl_;
};

namespace detail {
using LoopBody = void (*)(void* context, std::size_t index, int worker);
void parallel_for(std::size_t count, LoopBody body, void* context);
}  // namespace detail

// Calls body(index, worker) for every index in [0, count), in any order, on several threads.
// `worker` is in [0, max_workers()) and no two concurrent calls share it: use it to pick scratch
// memory that was allocated before. Bodies must not start loops of their own: a thread that waits
// inside one could pick up another item, with the same worker index. If a body throws, one of the
// exceptions is rethrown.
template <class Body>
void parallel_for(std::size_t count, Body&& body) {
    using Fn = std::remove_reference_t<Body>;
    detail::parallel_for(
        count,
        [](void* context, std::size_t index, int worker) {
            (*static_cast<Fn*>(context))(index, worker);
        },
        const_cast<void*>(static_cast<const void*>(&body)));
}

// Upper bound of `worker` over the life of the process, whatever limits come and go: how many
// scratch areas an object needs that is built once and run later.
int max_workers() noexcept;

}  // namespace aureole
