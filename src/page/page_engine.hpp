#pragma once
// The engine behind the live page. Requests and answers are described in doc/page-protocol.md, which is the reference of their keys.

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace corpuscle::page {

/// One session: the afferents that the page simulates, their states, and the spikes since the start. Sessions are independent of each
/// other; one session must not be used by two threads at once.
class PageEngine {
public:
    PageEngine();
    ~PageEngine();
    PageEngine(PageEngine&&) noexcept;

    /// Answers a request: JSON text, or a message (message.hpp) whose head is the request. The answer is a message. After an error it is a
    /// message with the key "error" (a sentence), and the session is as before the request. It throws nothing but std::bad_alloc.
    std::vector<std::byte> request(std::span<const std::byte>);
    std::vector<std::byte> request(std::string_view json) {
        return request(std::as_bytes(std::span<const char>(json.data(), json.size())));
    }

    /// Ends the request that another thread makes at this time, with an error. All later requests end with an error, too.
    void stop();

    struct Impl;

private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace corpuscle::page
