#pragma once
// The messages of the live page: a head of JSON, then arrays of numbers. Requests, answers and the stream of a sensor have this form.
//
//   bytes 0 to 3   length L of the head, little-endian
//   4 to 3 + L     the head: a JSON object in UTF-8, padded with spaces so that 4 + L is a multiple of 8
//   from 4 + L     the arrays, little-endian, each padded with zeros to a multiple of 8 bytes
//
// If there are arrays, the head lists them in their order: "arrays": [{"name": "force", "type": "f64", "count": 160}, ...].
// A request without arrays may also be the JSON text alone: no message begins with '{'.

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle::page {

using Json = nlohmann::ordered_json;

/// Builds a message.
class MessageWriter {
    Json arrays_ = Json::array();
    std::vector<std::byte> bytes_;  // of the arrays

    void add_bytes(std::string_view name, std::string_view type, const void* data, std::size_t count, std::size_t bytes);

public:
    Json head = Json::object();  ///< "arrays" is added by finish()

    void add(std::string_view name, std::span<const float> values) { add_bytes(name, "f32", values.data(), values.size(), 4); }
    void add(std::string_view name, std::span<const double> values) { add_bytes(name, "f64", values.data(), values.size(), 8); }
    void add(std::string_view name, std::span<const std::uint32_t> values) { add_bytes(name, "u32", values.data(), values.size(), 4); }
    void add(std::string_view name, std::span<const std::uint8_t> values) { add_bytes(name, "u8", values.data(), values.size(), 1); }
    void add(std::string_view name, std::string_view text) { add_bytes(name, "u8", text.data(), text.size(), 1); }

    /// The complete message.
    std::vector<std::byte> finish() const;
};

/// An array of a message that was read.
struct MessageArray {
    std::string name, type;           ///< type: "f32", "f64", "u32", "u8"
    std::size_t count = 0;            ///< number of elements
    std::span<const std::byte> data;  ///< its bytes, in those of the message
};

/// A message that was read. It refers to the bytes that were read.
struct Message {
    Json head;
    std::vector<MessageArray> arrays;

    const MessageArray* find(std::string_view name) const;  ///< null: there is no such array
};

/// Reads a message, or the text of a JSON object. Any bytes give a message or an error.
Result<Message> read_message(std::span<const std::byte>);

/// The numbers of an array of type f64 or f32. A number that is not finite, and another type, are errors.
Result<std::vector<double>> numbers_of(const MessageArray&);

}  // namespace corpuscle::page
