#include "core/error.hpp"

namespace corpuscle {

Error::Error(ErrorCode c, std::string m, SourceLocation l) : code(c), message(std::move(m)), location(std::move(l)) {}
Error::Error(const Error&) = default;
Error::Error(Error&&) noexcept = default;
Error& Error::operator=(const Error&) = default;
Error& Error::operator=(Error&&) noexcept = default;
Error::~Error() = default;

std::string Error::text() const {
    std::string at = location.file;
    if (location.line > 0) at += (at.empty() ? "line " : ":") + std::to_string(location.line);
    if (location.line > 0 && location.column > 0) at += ":" + std::to_string(location.column);
    return at.empty() ? message : at + ": " + message;
}

Error bad_input(std::string message, SourceLocation location) {
    return Error{ErrorCode::bad_input, std::move(message), std::move(location)};
}

Error bad_usage(std::string message) { return Error{ErrorCode::bad_usage, std::move(message)}; }
Error interrupted_error() { return {ErrorCode::interrupted, "interrupted"}; }

}  // namespace corpuscle
