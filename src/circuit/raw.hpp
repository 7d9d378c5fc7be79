#pragma once
// Plots as files: ngspice's .raw, binary or ASCII, and CSV.

#include <span>
#include <string>

#include "circuit/points.hpp"

namespace corpuscle::circuit {

/// All plots one after another, as ngspice's `write` does. Binary numbers are little-endian doubles.
std::string raw_text(std::string_view title, std::span<const Plot>, bool binary);

/// The same of a plot whose points come one after another: its head, the points, its tail. The head counts none; the count stands in it
/// as wide as raw_count() is, so that it can be written over.
struct RawHead {
    std::string text;
    std::size_t count_at;  ///< where the count begins
};
RawHead raw_head(std::string_view title, const Plot&, bool binary);
std::string raw_count(std::size_t points);
void append_raw_point(std::string&, std::size_t number, const PlotRow&, bool binary);
std::string_view raw_tail(bool binary);

/// One plot as CSV: a header of names, a row a point; complex curves as two columns, name.re and name.im.
std::string csv_header(const Plot&);
std::string csv_rows(const Plot&, std::string_view before = {});  ///< `before` stands at the head of each row
void append_csv_row(std::string&, std::span<const double> row);

}  // namespace corpuscle::circuit
