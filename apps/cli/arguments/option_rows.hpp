#pragma once
// Adds the rows of option tables to the command line.

#include <stdexcept>

#include "core/text/option.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

/// A reader refused the text of an option.
struct OptionError : std::runtime_error {
    Error error;
    explicit OptionError(const Error& refusal) : std::runtime_error(refusal.message), error(refusal) {}
};

/// Adds a group to the part of the command line that belongs to a verb.
void add_options(CLI::App& part, const OptionGroup&);

}  // namespace corpuscle
