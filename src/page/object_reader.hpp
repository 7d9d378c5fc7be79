#pragma once
// Reads the members of a JSON object of a request, and the arrays of the request. All must be read: check_all_read() refuses the others, so
// that a mistyped name is an error.

#include <optional>

#include "page/message.hpp"

namespace corpuscle::page {

class ObjectReader {
    const Json& object_;
    std::string name_;                       // for messages: "advance", "row 2"
    std::span<const MessageArray> arrays_;   // of the request; none if the object is a part of its head
    std::vector<std::string> known_;         // keys that were asked for
    std::vector<std::string> known_arrays_;  // likewise

    const Json* find(const char* key);

public:
    /// `object` must be a JSON object; it and the arrays must outlive the reader.
    ObjectReader(const Json& object, std::string name, std::span<const MessageArray> arrays = {})
        : object_(object), name_(std::move(name)), arrays_(arrays) {}

    const std::string& name() const { return name_; }
    bool has(const char* key) { return find(key) != nullptr; }
    /// A number in [low, high]. Without a default the key must be there.
    Result<double> number(const char* key, double low, double high, std::optional<double> default_value = {});
    /// An integer in [low, high]; high is at most 2^53.
    Result<std::uint64_t> integer(const char* key, std::uint64_t low, std::uint64_t high, std::optional<std::uint64_t> default_value = {});
    Result<bool> flag(const char* key);  ///< false if the key is not there
    Result<std::string> text(const char* key, std::optional<std::string> default_value = {});
    Result<std::vector<std::string>> texts(const char* key);    ///< a list of texts; empty if the key is not there
    Result<std::vector<const Json*>> objects(const char* key);  ///< a list of objects; empty if the key is not there
    Result<const Json*> object(const char* key);                ///< null if the key is not there
    const MessageArray* array(const char* name);                ///< null if the request has no such array
    /// Returns an error that lists the known keys, or arrays, if the request has others.
    Result<void> check_all_read() const;
};

/// For each of `samples` samples, the array or the number with this name; `default_value` if the request has neither.
Result<std::vector<double>> signal(ObjectReader&, const char* name, std::size_t samples, double default_value);

/// The error of a request that another thread has stopped.
inline Error stopped_error() { return {ErrorCode::interrupted, "the request was stopped"}; }

}  // namespace corpuscle::page
