#pragma once
// Values as bytes: saved states, checkpoints, and messages to other processes. The bytes are those in memory, so that both sides must run
// on the same kind of machine.

#include <bit>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/checksum.hpp"

namespace corpuscle {

static_assert(std::endian::native == std::endian::little, "saved states are little-endian");

/// True for types whose bytes are copied as they are. For a structure with other members, byte_fields(x) must return std::tie() of them.
template <class T>
inline constexpr bool is_copied_as_bytes = std::is_trivially_copyable_v<T>;
template <class T>
inline constexpr bool is_copied_as_bytes<std::optional<T>> = false;
template <class... T>
inline constexpr bool is_copied_as_bytes<std::tuple<T...>> = false;

/// Appends values to a list of bytes. A text or a list is preceded by its length, as a number of 64 bits, and an optional value by a byte
/// that says whether there is one.
template <class Bytes = std::string>
class ByteWriter {
    Bytes bytes_;

    template <class T>
    void put_one(const T& x) {
        if constexpr (is_copied_as_bytes<T>) {
            put_raw(&x, sizeof x);
        } else if constexpr (requires { x.has_value(); }) {
            put_one(static_cast<std::uint8_t>(x.has_value()));
            if (x) put_one(*x);
        } else if constexpr (requires { x.size(); }) {
            put_one(std::uint64_t{x.size()});
            if constexpr (is_copied_as_bytes<typename T::value_type>)
                put_raw(x.data(), x.size() * sizeof(typename T::value_type));
            else
                for (const auto& element : x) put_one(element);
        } else if constexpr (requires { std::tuple_size<T>::value; }) {
            std::apply([this](const auto&... fields) { this->put(fields...); }, x);
        } else {
            put_one(byte_fields(const_cast<T&>(x)));  // it is read only; one function serves reader and writer
        }
    }

public:
    void put_raw(const void* data, std::size_t size) {
        const auto before = bytes_.size();
        bytes_.resize(before + size);
        if (size > 0) std::memcpy(bytes_.data() + before, data, size);
    }
    template <class... T>
    void put(const T&... x) {
        (put_one(x), ...);
    }
    /// Appends the checksum of all bytes so far.
    void put_checksum() { put(checksum_of(std::as_bytes(std::span(bytes_)))); }
    const Bytes& bytes() const { return bytes_; }
    Bytes take() { return std::move(bytes_); }
};

/// Reads values in the order in which a ByteWriter wrote them. Each function returns false if too few bytes are left. The bytes are not
/// trusted: any of them give values or false.
class ByteReader {
    std::span<const std::byte> in_;

    template <class T>
    bool get_one(T& x) {
        if constexpr (std::is_same_v<T, bool>) {
            std::uint8_t byte = 2;
            return get_one(byte) && byte < 2 && (x = byte == 1, true);
        } else if constexpr (is_copied_as_bytes<T>) {
            return get_raw(&x, sizeof x);
        } else if constexpr (requires { x.has_value(); }) {
            bool has_value = false;
            return get_one(has_value) && (!has_value || get_one(x.emplace()));
        } else if constexpr (requires { x.size(); }) {
            return get_list(x);
        } else if constexpr (requires { std::tuple_size<T>::value; }) {
            return std::apply([this](auto&... fields) { return this->get(fields...); }, x);
        } else {
            auto fields = byte_fields(x);
            return get_one(fields);
        }
    }
    template <class T>
    bool get_list(T& x) {
        using Element = typename T::value_type;
        std::uint64_t size = 0;
        if (!get_one(size)) return false;
        if constexpr (is_copied_as_bytes<Element>) {
            if (size > in_.size() / sizeof(Element)) return false;
            x.resize(size);
            return get_raw(x.data(), size * sizeof(Element));
        } else {
            for (std::uint64_t k = 0; k < size; ++k)  // without a reservation, because the size may be wrong
                if (Element element; get_one(element))
                    x.push_back(std::move(element));
                else
                    return false;
            return true;
        }
    }

public:
    explicit ByteReader(std::span<const std::byte> in) : in_(in) {}
    explicit ByteReader(std::string_view in) : in_(std::as_bytes(std::span(in.data(), in.size()))) {}
    bool get_raw(void* data, std::size_t size) {
        if (in_.size() < size) return false;
        if (size > 0) std::memcpy(data, in_.data(), size);
        in_ = in_.subspan(size);
        return true;
    }
    template <class... T>
    bool get(T&... x) {
        return (get_one(x) && ...);
    }
    /// Removes a checksum, the last eight bytes. Returns false if it is not that of all bytes before it. `all`: the complete bytes, of
    /// which this reader has read the beginning.
    bool check_checksum(std::span<const std::byte> all) {
        std::uint64_t sum = 0;
        if (in_.size() < sizeof sum) return false;
        std::memcpy(&sum, all.data() + all.size() - sizeof sum, sizeof sum);
        in_ = in_.first(in_.size() - sizeof sum);
        return sum == checksum_of(all.first(all.size() - sizeof sum));
    }
    std::span<const std::byte> rest() const { return in_; }
    bool ended() const { return in_.empty(); }
};

/// The version in the bytes of a saved state, which begin with a magic text of six letters, then the version and a line break. Version 1
/// has no checksum; later ones end with a checksum of all bytes before it. nullopt: these bytes do not begin so.
inline std::optional<char> read_magic(ByteReader& in, std::string_view letters) {
    char head[8] = {};
    if (!in.get(head) || std::string_view(head, 6) != letters) return {};
    return head[7] == '\n' ? head[6] : '\0';
}

}  // namespace corpuscle
