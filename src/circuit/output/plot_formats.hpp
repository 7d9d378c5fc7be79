#pragma once
// File formats of plots: ngspice's .raw, binary or ASCII, and CSV.

#include "circuit/output/point_sink.hpp"

namespace corpuscle::circuit {

// ngspice's .raw file, as its `write` makes it: for each plot a header, its points (numbered from 0), a footer. `binary` selects the binary
// format, with little-endian doubles, or ASCII. The header contains a point count of 0. At the end of the plot it must be overwritten by
// raw_count(), which has the same width. Its date is that of the environment variable SOURCE_DATE_EPOCH, or 1 January 1970.
struct RawHeader {
    std::string text;
    std::size_t count_offset;  ///< offset of the point count in the text, bytes
};
RawHeader raw_header(std::string_view title, const Plot&, bool binary);
std::string raw_count(std::size_t points);
void append_raw_point(std::string&, std::size_t number, const PlotRow&, bool binary);
std::string_view raw_footer(bool binary);

// A plot as CSV: a header of names, then one row per point. In a complex plot each curve but the frequency has two columns, name.re and
// name.im.
std::string csv_header(const Plot&);
/// `head`: the plot without values.
void append_csv_row(std::string&, const Plot& head, const PlotRow&);

}  // namespace corpuscle::circuit
