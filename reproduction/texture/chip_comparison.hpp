#pragma once
// The texture task with chips: what they tell, and what their models tell in the same windows and on the same taxels.

#include "reproduction/claims/study.hpp"
#include "reproduction/texture/texture_surfaces.hpp"

namespace corpuscle {

inline constexpr double chip_duration = 17;  ///< s, of each recording; the chips take most of the study's time
inline constexpr std::size_t chip_taxels = 8;

/// Compares chips with models on the slow recordings of surfaces, and adds claims and a plot. `part_name` names the part in texts.
/// `progress`: called with the finished fraction; must return false to stop.
Result<void> compare_texture_chips(StudyResult&, const TextureSurfaces&, SlidePart, const char* part_name,
                                   const std::function<bool(double)>& progress);

}  // namespace corpuscle
