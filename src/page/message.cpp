#include "page/message.hpp"

#include <fmt/format.h>
#include <cmath>
#include <cstring>

namespace corpuscle::page {
namespace {

constexpr std::size_t max_head = std::size_t{1} << 20, max_arrays = 64;

constexpr std::size_t padded(std::size_t bytes) { return (bytes + 7) / 8 * 8; }

struct ElementType {
    std::string_view name;
    std::size_t bytes;
};
constexpr ElementType element_types[] = {{"f32", 4}, {"f64", 8}, {"u32", 4}, {"u8", 1}};

Result<Json> read_head(std::span<const std::byte> bytes) {
    constexpr int max_depth = 16;  // because dump() and copies are recursive
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    bool is_too_deep = false;
    auto head = Json::parse(
        text,
        [&](int depth, Json::parse_event_t, Json&) {
            is_too_deep = is_too_deep || depth > max_depth;
            return !is_too_deep;  // false: leave it out
        },
        false);
    if (is_too_deep) return bad_input(fmt::format("values in the head of the message are nested more than {} deep", max_depth));
    if (head.is_discarded()) return bad_input("the head of the message is not JSON");
    if (!head.is_object()) return bad_input("the head of the message is not a JSON object");
    return head;
}

/// Reads one row of "arrays", and takes its bytes from the rest of the message.
Result<MessageArray> take_array(const Json& row, std::span<const std::byte>& rest) {
    const auto has = [&](const char* key) { return row.is_object() && row.contains(key); };
    if (!has("name") || !row["name"].is_string() || !has("type") || !row["type"].is_string() || !has("count") ||
        !row["count"].is_number_unsigned())
        return bad_input(
            "an array of the message has no name, type and count, such as {\"name\": \"force\", \"type\": \"f64\", \"count\": 8}");
    MessageArray out{row["name"], row["type"], row["count"], {}};
    for (const auto& type : element_types)
        if (type.name == out.type) {
            if (out.count > rest.size() / type.bytes || padded(out.count * type.bytes) > rest.size())
                return bad_input(fmt::format("the message ends within the array '{}'", out.name));
            out.data = rest.first(out.count * type.bytes);
            rest = rest.subspan(padded(out.data.size()));
            return out;
        }
    return bad_input(fmt::format("the array '{}' has the type '{}'; types are f32, f64, u32 and u8", out.name, out.type));
}

template <class V>
Result<std::vector<double>> finite_numbers(const MessageArray& array) {
    std::vector<double> out(array.count);
    for (std::size_t k = 0; k < out.size(); ++k) {
        V value;
        std::memcpy(&value, array.data.data() + k * sizeof value, sizeof value);
        if (!std::isfinite(value))
            return bad_input(fmt::format("element {} of the array '{}' is {}, not a finite number", k, array.name, value));
        out[k] = static_cast<double>(value);
    }
    return out;
}

}  // namespace

void MessageWriter::add_bytes(std::string_view name, std::string_view type, const void* data, std::size_t count, std::size_t bytes) {
    arrays_.push_back({{"name", name}, {"type", type}, {"count", count}});
    const auto begin = bytes_.size(), size = count * bytes;
    bytes_.resize(begin + padded(size));
    if (size > 0) std::memcpy(bytes_.data() + begin, data, size);
}

std::vector<std::byte> MessageWriter::finish() const {
    auto complete = head;
    if (!arrays_.empty()) complete["arrays"] = arrays_;
    auto text = complete.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize(padded(4 + text.size()) - 4, ' ');
    const auto length = static_cast<std::uint32_t>(text.size());
    std::vector<std::byte> out(4 + text.size() + bytes_.size());
    for (unsigned k = 0; k < 4; ++k) out[k] = static_cast<std::byte>(length >> (8 * k));
    std::memcpy(out.data() + 4, text.data(), text.size());
    if (!bytes_.empty()) std::memcpy(out.data() + 4 + text.size(), bytes_.data(), bytes_.size());
    return out;
}

const MessageArray* Message::find(std::string_view name) const {
    for (const auto& array : arrays)
        if (array.name == name) return &array;
    return nullptr;
}

Result<Message> read_message(std::span<const std::byte> bytes) {
    if (!bytes.empty() && bytes[0] == std::byte{'{'}) {
        if (bytes.size() > max_head) return bad_input(fmt::format("a request of more than {} bytes of JSON", max_head));
        return Message{TRY(read_head(bytes)), {}};
    }
    if (bytes.size() < 4) return bad_input("a message needs at least 4 bytes, the length of its head");
    std::size_t length = 0;
    for (unsigned k = 0; k < 4; ++k) length |= std::to_integer<std::size_t>(bytes[k]) << (8 * k);
    if (length > max_head) return bad_input(fmt::format("the head of the message has {} bytes; the limit is {}", length, max_head));
    if ((4 + length) % 8 != 0) return bad_input("the head of the message, with the 4 bytes before it, is not a multiple of 8 bytes long");
    if (length > bytes.size() - 4) return bad_input("the message ends within its head");
    Message out{TRY(read_head(bytes.subspan(4, length))), {}};
    auto rest = bytes.subspan(4 + length);
    if (const auto rows = out.head.find("arrays"); rows != out.head.end()) {
        if (!rows->is_array() || rows->size() > max_arrays)
            return bad_input(fmt::format("\"arrays\" is not a list of at most {} arrays", max_arrays));
        for (const auto& row : *rows) out.arrays.push_back(TRY(take_array(row, rest)));
    }
    if (!rest.empty()) return bad_input(fmt::format("{} bytes after the last array of the message", rest.size()));
    out.head.erase("arrays");
    return out;
}

Result<std::vector<double>> numbers_of(const MessageArray& array) {
    if (array.type == "f64") return finite_numbers<double>(array);
    if (array.type == "f32") return finite_numbers<float>(array);
    return bad_input(fmt::format("the array '{}' has the type {}; numbers are f64 or f32", array.name, array.type));
}

}  // namespace corpuscle::page
