#pragma once
// A session of the native engine for one page: requests in, answers out.

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// One session must not be used by two threads at once, except for stop().
class PageSession {
public:
    virtual ~PageSession() = default;
    /// Answers a message of the page. An error ends the connection; an error in the request is an answer that says so.
    virtual Result<std::vector<std::byte>> request(std::span<const std::byte> message) = 0;
    /// Ends the request that is being answered, soon and with any answer. No request follows. Any thread may call it.
    virtual void stop() {}
};

using PageSessionFactory = std::function<std::unique_ptr<PageSession>()>;

}  // namespace corpuscle
