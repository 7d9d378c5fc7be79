#pragma once
// A skin's answer as a page to look at: maps that move, rasters, rates, first spikes. One HTML file, no network.

#include <string>

#include "report/skin_report.hpp"
#include "study/skin_summary.hpp"

namespace corpuscle {

/// Of what both listened to. The innervation must still be there.
std::string skin_page(const SkinSummary&, const SkinReport&, const SkinTold&, const std::string& command);

}  // namespace corpuscle
