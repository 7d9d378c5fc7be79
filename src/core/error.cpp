#include "core/error.hpp"

namespace corpuscle {

std::string Error::text() const {
    std::string at = location.file;
    if (location.line > 0) at += (at.empty() ? "line " : ":") + std::to_string(location.line);
    if (location.line > 0 && location.column > 0) at += ":" + std::to_string(location.column);
    return at.empty() ? message : at + ": " + message;
}

}  // namespace corpuscle
