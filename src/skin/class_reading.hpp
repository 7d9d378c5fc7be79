#pragma once
// The classes of afferents in a population file.

#include "skin/number_reader.hpp"
#include "skin/skin_plan.hpp"

namespace corpuscle::skins {

Result<std::vector<SkinClass>> read_classes(const SkinSpec&, const Sites&, const NumberReader&);

std::vector<SourceNote> read_sources(std::span<const LocatedSetting>);

}  // namespace corpuscle::skins
