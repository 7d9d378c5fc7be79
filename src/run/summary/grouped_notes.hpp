#pragma once
// Notes about many inputs, such as trials, of which many say the same.

#include <span>
#include <string>
#include <vector>

namespace corpuscle {

/// Makes one of the notes "NAME: TEXT" with the same text: "press_1 and 4 more: no unit for 'fz': assuming newtons". The order is that of
/// the first ones.
std::vector<std::string> grouped_notes(std::span<const std::string>);

/// The names of the inputs of a run, at most four: "press_1, press_2, press_3 and 5 more".
std::string short_list(std::span<const std::string> names);

}  // namespace corpuscle
