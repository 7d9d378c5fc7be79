#pragma once
// The catalogues as JSON.

#include <nlohmann/json_fwd.hpp>

#include "run/catalogue/catalogue_sections.hpp"

namespace corpuscle {

/// True if at least one limit is not the largest double, which means no limit.
bool has_range(const ParameterInfo&);
/// {"name", "default", "unit", "low", "high", "description", "source", "component"}; low and high are null without a range.
nlohmann::ordered_json document_of(const AfferentParameter&);
nlohmann::ordered_json document_of(const ListEntry&);

}  // namespace corpuscle
