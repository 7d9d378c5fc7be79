#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <utility>

namespace corpuscle::lanes {

/// Memory on a cache line, zero at first; of plain data.
template <class V>
class Buffer {
    static constexpr std::align_val_t line{64};
    V* data_ = nullptr;
    std::size_t size_ = 0;

public:
    Buffer() = default;
    explicit Buffer(std::size_t size) : data_(static_cast<V*>(::operator new(size * sizeof(V), line))), size_(size) {
        std::fill_n(data_, size_, V{});
    }
    Buffer(Buffer&& other) noexcept : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
    Buffer& operator=(Buffer&& other) noexcept {
        std::swap(data_, other.data_), std::swap(size_, other.size_);
        return *this;
    }
    ~Buffer() { ::operator delete(data_, line); }

    V* data() const { return data_; }
    std::size_t size() const { return size_; }
};

}  // namespace corpuscle::lanes
