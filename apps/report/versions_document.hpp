#pragma once

#include <nlohmann/json.hpp>

#include "study/comparisons.hpp"

namespace corpuscle {

/// The page's table of versions: of each receptor and channel a row for what the others are held against, then one for each of them.
nlohmann::ordered_json versions_document(const Comparisons&);

}  // namespace corpuscle
