#pragma once
// A value of a text file before anybody knows what it means: its text, and where it stands.

#include <optional>
#include <string>

#include "signal/error.hpp"

namespace corpuscle {

struct Said {
    std::string text;
    Place place;

    Error wrong(std::string sentence) const { return bad_input(std::move(sentence), place); }
};
using MaybeSaid = std::optional<Said>;

/// Something set by name.
struct SaidSetting {
    std::string name;  ///< "press.F_max"
    Said value;
};

}  // namespace corpuscle
