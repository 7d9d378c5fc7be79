#pragma once

#include <fmt/format.h>
#include <map>
#include <ranges>
#include <string>

#include "core/parameter.hpp"

namespace corpuscle::circuit {

/// The error for bad input at a location in a netlist. The message is formatted as by fmt::format().
template <class... Arguments>
Error error_at(SourceLocation location, fmt::format_string<Arguments...> message, Arguments&&... arguments) {
    return bad_input(fmt::format(message, std::forward<Arguments>(arguments)...), std::move(location));
}

/// The same as in core/parameter.hpp, for names in a range of any kind. "" for one letter, which resembles too many names of a netlist.
template <std::ranges::input_range Names>
std::string did_you_mean(std::string_view typed, Names&& names) {
    if (typed.size() < 2) return "";
    std::vector<std::string_view> views;
    for (const auto& name : names) views.emplace_back(name);
    return corpuscle::did_you_mean(typed, views);
}

/// did_you_mean() for input with many unknown names. Each search compares all known names, so only the first names are searched for, each
/// once: 100,000 unknown names among as many known ones would take many minutes.
class Suggestions {
    static constexpr std::size_t max_searches = 20;
    std::map<std::string, std::string, std::less<>> found_;  // by the unknown name

public:
    /// The suggestion for a name. `known_names()` returns the names that it can be.
    template <class KnownNames>
    std::string for_name(std::string_view typed, KnownNames&& known_names) {
        if (const auto at = found_.find(typed); at != found_.end()) return at->second;
        if (found_.size() == max_searches) return "";
        return found_[std::string(typed)] = did_you_mean(typed, known_names());
    }
};

}  // namespace corpuscle::circuit
