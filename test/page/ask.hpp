#pragma once
// Requests to a PageEngine, and their answers as values.

#include <gtest/gtest.h>

#include "page/message.hpp"
#include "page/page_engine.hpp"

namespace corpuscle::page {

/// An answer, with its bytes.
struct PageAnswer {
    std::vector<std::byte> bytes;
    Message message;  // refers to `bytes`

    const Json& operator[](const char* key) const { return message.head.at(key); }
    std::string error() const { return message.head.value("error", ""); }
    bool has(const char* array) const { return message.find(array) != nullptr; }
    std::vector<double> numbers(const char* array) const { return *numbers_of(*message.find(array)); }
    std::vector<std::uint32_t> units() const {
        const auto* array = message.find("unit");
        std::vector<std::uint32_t> out(array->count);
        if (!out.empty()) std::memcpy(out.data(), array->data.data(), array->data.size());
        return out;
    }
};

inline PageAnswer answer_of(std::vector<std::byte> bytes) {
    PageAnswer out{std::move(bytes), {}};
    auto message = read_message(out.bytes);
    if (!message) throw std::runtime_error(message.error().message);
    out.message = std::move(*message);
    return out;
}

inline PageAnswer ask(PageEngine& engine, std::string_view json) { return answer_of(engine.request(json)); }

/// A request with one array.
template <class V>
PageAnswer ask(PageEngine& engine, std::string_view json, std::string_view array, const std::vector<V>& values) {
    MessageWriter request;
    request.head = Json::parse(json);
    request.add(array, std::span<const V>(values));
    return answer_of(engine.request(std::span<const std::byte>(request.finish())));
}

/// An answer that must not be an error.
inline PageAnswer ask_well(PageEngine& engine, std::string_view json) {
    auto out = ask(engine, json);
    EXPECT_EQ(out.error(), "") << json;
    return out;
}

}  // namespace corpuscle::page
