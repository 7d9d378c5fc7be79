#pragma once
// File formats of plots: ngspice's .raw, binary or ASCII, and CSV.

#include <span>
#include <string>

#include "circuit/output/point_sink.hpp"

namespace corpuscle::circuit {

/// All plots one after another, as ngspice's `write` does. `binary` selects the binary format, with little-endian doubles, or ASCII.
std::string raw_text(std::string_view title, std::span<const Plot>, bool binary);

/// The parts of such a file for a plot that arrives point by point: header, points (numbered from 0), footer. The header contains a point
/// count of 0. At the end of the plot it must be overwritten by raw_count(), which has the same width.
struct RawHeader {
    std::string text;
    std::size_t count_offset;  ///< offset of the point count in the text, bytes
};
RawHeader raw_header(std::string_view title, const Plot&, bool binary);
std::string raw_count(std::size_t points);
void append_raw_point(std::string&, std::size_t number, const PlotRow&, bool binary);
std::string_view raw_footer(bool binary);

/// One plot as CSV: a header of names, then one row per point. In a complex plot each curve but the frequency has two columns, name.re and
/// name.im.
std::string csv_header(const Plot&);
std::string csv_rows(const Plot&, std::string_view prefix = {});  ///< each row begins with `prefix`
void append_csv_row(std::string&, std::span<const double> row);   ///< appends one point of a real plot

}  // namespace corpuscle::circuit
