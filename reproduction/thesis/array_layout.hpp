#pragma once
// Layout sketches of arrays: the channels of each array, within the rectangle that counts as its total area.

#include "reproduction/thesis/arrays.hpp"

namespace corpuscle {

/// A drawing of the arrays side by side; both axes in um.
StudyPlot layout_plot(const SimulatedArrays&, std::string title);

/// The result of a layout figure ("fig. 43"): each array's areas beside the published ones, and the drawing. `remark` is the end of
/// the note, and explains differences.
Result<StudyResult> report_layout(const PublishedArrays&, const std::string& figure, const std::string& remark);

}  // namespace corpuscle
