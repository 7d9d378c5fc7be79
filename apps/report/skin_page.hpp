#pragma once
// The report page of a skin: animated maps, rasters, rates, first spikes. One self-contained HTML file.

#include <string>

#include "report/skin_report.hpp"
#include "study/skin_summary.hpp"

namespace corpuscle {

/// The summary and the report must be of the same run, and its Innervation must still exist.
std::string skin_page(const SkinSummary&, const SkinReport&, const SkinRunNotes&, const std::string& command);

}  // namespace corpuscle
