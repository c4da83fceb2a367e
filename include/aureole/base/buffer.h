// Uninitialised float memory for hot loops: 64-byte aligned, and on huge pages where the system
// offers them (strided passes over large transforms are bound by address translation otherwise).
#pragma once

#include <cstddef>
#include <memory>

namespace aureole {

namespace detail {
// Throws std::bad_alloc.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* data) noexcept;
}  // namespace detail

// The same memory for standard containers.
template <class T>
struct AlignedAllocator {
    using value_type = T;
    AlignedAllocator() = default;
    template <class U>
    AlignedAllocator(const AlignedAllocator<U>&) {}  // NOLINT(google-explicit-constructor)
    T* allocate(std::size_t count) {
        return static_cast<T*>(detail::allocate_aligned(count * sizeof(T)));
    }
    void deallocate(T* data, std::size_t) noexcept { detail::free_aligned(data); }
    bool operator==(const AlignedAllocator&) const = default;
};

class Buffer {
  public:
    Buffer() = default;
    // Room for `count` floats; contents undefined until written.
    explicit Buffer(std::size_t count);

    float* data() noexcept { return data_.get(); }
    const float* data() const noexcept { return data_.get(); }
    std::size_t size() const noexcept { return count_; }
    float& operator[](std::size_t i) noexcept { return data_.get()[i]; }
    float operator[](std::size_t i) const noexcept { return data_.get()[i]; }

  private:
    struct Free {
        void operator()(float* data) const noexcept { detail::free_aligned(data); }
    };
    std::unique_ptr<float[], Free> data_;
    std::size_t count_ = 0;
};

}  // namespace aureole
