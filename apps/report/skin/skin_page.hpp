#pragma once
// The report page of a skin: animated maps, rasters, rates, first spikes. One self-contained HTML file.

#include <string>

#include "report/skin/skin_report.hpp"
#include "run/summary/skin_summary.hpp"

namespace corpuscle {

/// The page as HTML. The summary and the report must be of the same run, whose Innervation must still exist. `command`: the command line.
std::string skin_page(const SkinSummary&, const SkinReport&, const RespondOptions&, const SkinRunNotes&, const std::string& command);

}  // namespace corpuscle
