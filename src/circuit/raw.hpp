#pragma once
// Plots as files: ngspice's .raw, binary or ASCII, and CSV.

#include <span>
#include <string>

#include "circuit/plot.hpp"

namespace corpuscle::circuit {

/// All plots one after another, as ngspice's `write` does. Binary numbers are little-endian doubles.
std::string raw_text(std::string_view title, std::span<const Plot>, bool binary);

/// One plot as CSV: a header of names, a row a point; complex curves as two columns, name.re and name.im.
std::string csv_header(const Plot&);
std::string csv_rows(const Plot&, std::string_view before = {});  ///< `before` stands at the head of each row

}  // namespace corpuscle::circuit
