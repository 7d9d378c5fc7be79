#pragma once
// The classes of afferents in a population file.

#include "skin/plan.hpp"
#include "skin/said_numbers.hpp"

namespace corpuscle::skins {

Result<std::vector<SkinClass>> classes_of(const SkinText&, const Sites&, const SaidNumbers&);

std::vector<Sourced> sources_of(std::span<const LocatedSetting>);

}  // namespace corpuscle::skins
