#pragma once
// Interprets the classes of afferents in a population file.

#include "skin/plan/number_reader.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle::skins {

/// The classes of a population file whose sites have been read. Errors name file, line and column.
Result<std::vector<SkinClass>> read_classes(const SkinSpec&, const Sites&, const NumberReader&);

/// The keys and texts of a `source` table.
std::vector<SourceNote> read_sources(std::span<const LocatedSetting>);

}  // namespace corpuscle::skins
