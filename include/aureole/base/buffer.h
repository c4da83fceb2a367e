// Uninitialised float memory for hot loops: 64-byte aligned, and on huge pages where the system
// offers them (strided passes over large transforms are bound by address translation otherwise).
#pragma once

#include <cstddef>
#include <memory>

namespace aureole {

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
        void operator()(float* data) const noexcept;
    };
    std::unique_ptr<float[], Free> data_;
    std::size_t count_ = 0;
};

}  // namespace aureole
