#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "circuit/error_at.hpp"

namespace corpuscle::circuit {

/// did_you_mean() for input with many unknown names. Each search compares all known names, so only the first names are searched for, each
/// once: 100,000 unknown names among as many known ones would take many minutes.
class Suggestions {
    static constexpr std::size_t max_searches = 20;
    std::map<std::pair<const void*, std::string>, std::string> found_;  // by the scope and the unknown name

public:
    /// The suggestion for a name in a scope, of which only the address is used. `known_names()` returns the names that it can be there.
    template <class KnownNames>
    std::string for_name(const void* scope, std::string_view typed, KnownNames&& known_names) {
        const std::pair key(scope, std::string(typed));
        if (const auto at = found_.find(key); at != found_.end()) return at->second;
        if (found_.size() == max_searches) return "";
        return found_[key] = did_you_mean(typed, known_names());
    }
};

}  // namespace corpuscle::circuit
