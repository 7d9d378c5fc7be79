#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <utility>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace corpuscle::lanes {

/// A zero-initialised array of plain data, aligned to a cache line. Arrays of 4 MB and more are aligned to 2 MB and request huge pages,
/// because with pages of 4 kB, each such page of force costs a look-up in the page table.
template <class V>
class AlignedBuffer {
    V* data_ = nullptr;
    std::size_t size_ = 0;
    static constexpr std::size_t large_page = std::size_t{1} << 21;

    std::align_val_t alignment() const { return std::align_val_t{size_ * sizeof(V) >= 2 * large_page ? large_page : 64}; }

public:
    AlignedBuffer() = default;
    explicit AlignedBuffer(std::size_t size) : size_(size) {
        data_ = static_cast<V*>(::operator new(size * sizeof(V), alignment()));
#ifdef __linux__
        if (alignment() == std::align_val_t{large_page}) (void)madvise(data_, size * sizeof(V), MADV_HUGEPAGE);
#endif
        std::fill_n(data_, size_, V{});
    }
    AlignedBuffer(AlignedBuffer&& other) noexcept : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
    AlignedBuffer& operator=(AlignedBuffer&& other) noexcept {
        std::swap(data_, other.data_), std::swap(size_, other.size_);
        return *this;
    }
    ~AlignedBuffer() { ::operator delete(data_, alignment()); }

    V* data() const { return data_; }
    std::size_t size() const { return size_; }
};

}  // namespace corpuscle::lanes
