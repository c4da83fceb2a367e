#include "aureole/base/buffer.h"

#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace aureole {

void* detail::allocate_aligned(std::size_t bytes) {
    constexpr std::size_t kHugePage = std::size_t{1} << 21U;
    const std::size_t alignment = bytes >= kHugePage ? kHugePage : 64;
    void* data = nullptr;
    if (posix_memalign(&data, alignment, bytes == 0 ? alignment : bytes) != 0) {
        throw std::bad_alloc();
    }
#if defined(__linux__)
    // A hint: failure is harmless. The rest beyond whole huge pages takes small ones.
    if (bytes >= kHugePage) madvise(data, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
    return data;
}

void detail::free_aligned(void* data) noexcept { std::free(data); }

Buffer::Buffer(std::size_t count)
    : data_(static_cast<float*>(detail::allocate_aligned(count * sizeof(float)))), count_(count) {}

}  // namespace aureole
