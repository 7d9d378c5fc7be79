#pragma once
// The options and output formats that a kind of population does not have. doc/recordings.md has the same table, which a test compares.

#include <span>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace corpuscle {

enum class PopulationKind { channels, skin };

struct PopulationException {
    PopulationKind population;
    std::string_view option;  ///< the option, or the file that is written without an option
    std::string_view reason;
    std::string_view remedy;
};

std::span<const PopulationException> population_exceptions();

/// The exception of this population for an option or file; null if the population has it.
const PopulationException* find_exception(PopulationKind, std::string_view option);

/// The error for a user who gave the option: option, reason and remedy.
Error exception_error(const PopulationException&);

}  // namespace corpuscle
