#include "signal/error.hpp"

namespace corpuscle {

std::string Error::text() const {
    std::string at = place.file;
    if (place.line > 0) at += (at.empty() ? "line " : ":") + std::to_string(place.line);
    if (place.line > 0 && place.column > 0) at += ":" + std::to_string(place.column);
    return at.empty() ? sentence : at + ": " + sentence;
}

}  // namespace corpuscle
