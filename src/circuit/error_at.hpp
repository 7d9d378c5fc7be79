#pragma once

#include <fmt/format.h>
#include <ranges>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

}  // namespace corpuscle::circuit
