#pragma once
// An uninterpreted configuration value: its text and its location in the file.

#include <optional>
#include <string>

#include "signal/error.hpp"

namespace corpuscle {

struct Said {
    std::string text;
    Place place;

    /// An error at this location.
    Error wrong(std::string message) const { return bad_input(std::move(message), place); }
};
using MaybeSaid = std::optional<Said>;

/// A setting of a configuration file.
struct SaidSetting {
    std::string name;  ///< "press.F_max"
    Said value;
};

}  // namespace corpuscle
