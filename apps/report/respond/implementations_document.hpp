#pragma once

#include <nlohmann/json.hpp>

#include "run/compare/implementation_comparison.hpp"

namespace corpuscle {

/// The table of implementations: for each afferent type and channel a row of the reference, then a row for each other implementation.
nlohmann::ordered_json implementations_document(const ImplementationComparisons&);

}  // namespace corpuscle
