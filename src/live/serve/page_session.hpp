#pragma once
// A session of the native engine for one page: requests in, answers out.

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// One session must not be used by two threads at once.
class PageSession {
public:
    virtual ~PageSession() = default;
    /// Answers a message of the page. An error ends the connection; an error in the request is an answer that says so.
    virtual Result<std::vector<std::byte>> request(std::span<const std::byte> message) = 0;
};

using PageSessionFactory = std::function<std::unique_ptr<PageSession>()>;

}  // namespace corpuscle
