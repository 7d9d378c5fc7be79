// Any bytes as requests of the live page, one after another: each is preceded by its size, two bytes. Expected: an answer that is a
// message, and that is an error with a sentence if it is one.

#include <cstdint>
#include <cstring>

#include "page/message.hpp"
#include "page/page_engine.hpp"
#include "require.hpp"

using namespace corpuscle;

namespace {

/// True for requests that are valid but slow: those that simulate circuits or large skins, or simulate for long.
bool is_slow(std::string_view request) {
    for (const std::string_view name : {"circuit", "macro", "biased", "hand", "grid", "catalogue", "kim", "lee", "substep", "t_"})
        if (request.find(name) != std::string_view::npos) return true;
    return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    page::PageEngine engine;
    for (int requests = 0; size > 2 && requests < 8; ++requests) {
        const auto length = std::min<std::size_t>(data[0] + 256U * data[1], size - 2);
        const std::span request(reinterpret_cast<const std::byte*>(data + 2), length);
        data += 2 + length, size -= 2 + length;
        if (is_slow({reinterpret_cast<const char*>(request.data()), request.size()})) continue;
        const auto answer = engine.request(request);
        const auto message = page::read_message(answer);
        fuzz::require(static_cast<bool>(message));
        if (message->head.contains("error")) fuzz::require(!message->head["error"].get<std::string>().empty());
    }
    return 0;
}
