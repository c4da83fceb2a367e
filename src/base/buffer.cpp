#include "aureole/base/buffer.h"

#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace aureole {

Buffer::Buffer(std::size_t count) : count_(count) {
    constexpr std::size_t kHugePage = std::size_t{1} << 21U;
    const std::size_t bytes = count * sizeof(float);
    const std::size_t alignment = bytes >= kHugePage ? kHugePage : 64;
    const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    void* data = std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded);
    if (data == nullptr) throw std::bad_alloc();
#if defined(__linux__)
    if (bytes >= kHugePage) madvise(data, rounded, MADV_HUGEPAGE);  // a hint: failure is harmless
#endif
    data_.reset(static_cast<float*>(data));
}

void Buffer::Free::operator()(float* data) const noexcept { std::free(data); }

}  // namespace aureole
