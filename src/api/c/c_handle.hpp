#pragma once
// Handles: the pointers that C code has of our objects. They are numbers of a slot in a table, not addresses, so that a handle of a
// destroyed object, or of another kind of object, is recognised and never dereferenced.

#include <array>
#include <atomic>
#include <deque>
#include <memory>
#include <mutex>

#include "api/c/c_error.hpp"

namespace corpuscle::api {

/// The objects of one type. `kind`, from 1 to 3, tells the handles of types apart. find() takes no lock.
template <class T, unsigned kind>
class HandleTable {
    static_assert(kind > 0 && kind < 4);
    static constexpr unsigned kind_bits = 2, index_bits = 20, chunk_bits = 10;
    static constexpr std::size_t chunk_size = std::size_t{1} << chunk_bits, max_size = std::size_t{1} << index_bits;
    static constexpr std::uintptr_t generation_limit = ~std::uintptr_t{0} >> (kind_bits + index_bits);

    struct Slot {
        std::atomic<std::uintptr_t> generation = 0;  // of the object that is or was last in this slot
        std::atomic<T*> object = nullptr;
    };
    std::array<std::atomic<Slot*>, max_size / chunk_size> chunks_ = {};  // never freed
    std::mutex changes_;
    std::deque<std::size_t> free_;  // the slot that became free first is used first
    std::size_t size_ = 0;          // slots in use or free

    Slot* slot(std::size_t index) const {
        auto* const chunk = chunks_[index >> chunk_bits].load(std::memory_order_acquire);
        return chunk ? chunk + (index & (chunk_size - 1)) : nullptr;
    }
    /// The slot of a handle, or null if no object of this type has or had it.
    Slot* slot_of(const void* handle) const {
        const auto bits = reinterpret_cast<std::uintptr_t>(handle);
        if ((bits & ((1U << kind_bits) - 1)) != kind) return nullptr;
        auto* const found = slot((bits >> kind_bits) & (max_size - 1));
        return found && found->generation.load(std::memory_order_acquire) == bits >> (kind_bits + index_bits) ? found : nullptr;
    }
    /// A slot without an object.
    std::size_t take_slot() {
        if (!free_.empty()) {
            const auto index = free_.front();
            free_.pop_front();
            return index;
        }
        if (size_ == max_size) throw BadCall("there are " + std::to_string(max_size) + " objects; destroy those that are no longer needed");
        if (!slot(size_)) chunks_[size_ >> chunk_bits].store(new Slot[chunk_size], std::memory_order_release);
        return size_++;
    }

public:
    /// The table of this type. It is never destroyed, so that handles are valid until the process ends.
    static HandleTable& all() {
        static auto& table = *new HandleTable;
        return table;
    }

    void* add(std::unique_ptr<T> object) {
        const std::lock_guard lock(changes_);
        const auto index = take_slot();
        auto& at = *slot(index);
        const auto generation = at.generation.load() % generation_limit + 1;
        at.object.store(object.release(), std::memory_order_release);
        at.generation.store(generation, std::memory_order_release);
        return reinterpret_cast<void*>(((generation << index_bits | index) << kind_bits) | kind);
    }
    /// The object of a handle, or null.
    T* find(const void* handle) const {
        const auto* const at = slot_of(handle);
        return at ? at->object.load(std::memory_order_acquire) : nullptr;
    }
    /// Takes the object of a handle out of the table; null if there is none.
    std::unique_ptr<T> take(const void* handle) {
        const std::lock_guard lock(changes_);
        auto* const at = slot_of(handle);
        std::unique_ptr<T> object(at ? at->object.exchange(nullptr) : nullptr);
        if (object) free_.push_back((reinterpret_cast<std::uintptr_t>(handle) >> kind_bits) & (max_size - 1));
        return object;
    }
};

/// The object of a handle. Throws BadCall; `name` is that of the argument.
template <class Table>
auto& object_of(const void* handle, const char* name) {
    if (auto* const object = Table::all().find(handle)) return *object;
    throw BadCall(std::string(name) + (handle ? " is not an object of this library, or has been destroyed" : " is NULL"));
}

/// Destroys the object of a handle. NULL is allowed. For any other value without an object only the failure is stored.
template <class Table>
void destroy(const void* handle, const char* name) noexcept {
    if (!handle) return;
    or_failed(false, [&] {
        if (!Table::all().take(handle)) throw BadCall(std::string(name) + " is not an object of this library, or has been destroyed");
        return true;
    });
}

}  // namespace corpuscle::api
