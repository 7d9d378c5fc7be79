#include "circuit/output/plot_formats.hpp"

#include <fmt/format.h>
#include <bit>
#include <cstdint>
#include <iterator>

#include "core/text/csv_field.hpp"

namespace corpuscle::circuit {
namespace {

void append_bytes(std::string& out, double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    for (int k = 0; k < 8; ++k) out += static_cast<char>(bits >> (8 * k));
}

bool has_two_columns(const Plot& plot, const Curve& c) { return plot.is_complex && c.type != "frequency"; }

}  // namespace

std::string raw_count(std::size_t points) { return fmt::format("{:<20}", points); }

RawHeader raw_header(std::string_view title, const Plot& plot, bool binary) {
    RawHeader out;
    out.text = fmt::format("Title: {}\nPlotname: {}\nFlags: {}\nNo. Variables: {}\nNo. Points: ", title, plot.name,
                           plot.is_complex ? "complex" : "real", plot.curves.size());
    out.count_offset = out.text.size();
    out.text += raw_count(0) + "\nVariables:\n";
    for (std::size_t k = 0; k < plot.curves.size(); ++k)
        out.text += fmt::format("\t{}\t{}\t{}\n", k, plot.curves[k].name, plot.curves[k].type);
    out.text += binary ? "Binary:\n" : "Values:\n";
    return out;
}

void append_raw_point(std::string& out, std::size_t number, const PlotRow& row, bool binary) {
    const auto to = std::back_inserter(out);
    if (!binary) fmt::format_to(to, " {}", number);
    for (std::size_t k = 0; k < row.size(); ++k) {
        const auto x = row[k];
        if (binary) {
            append_bytes(out, x.real());
            if (row.is_complex()) append_bytes(out, x.imag());
        } else if (row.is_complex()) {
            fmt::format_to(to, "\t{:.15e},{:.15e}\n", x.real(), x.imag());
        } else {
            fmt::format_to(to, "\t{:.15e}\n", x.real());
        }
    }
}

std::string_view raw_footer(bool binary) { return binary ? "" : "\n"; }

std::string csv_header(const Plot& plot) {
    std::string out;
    for (const auto& c : plot.curves) {
        if (&c != &plot.curves[0]) out += ",";
        out += has_two_columns(plot, c) ? quote_csv_field(c.name + ".re") + "," + quote_csv_field(c.name + ".im") : quote_csv_field(c.name);
    }
    return out + '\n';
}

void append_csv_row(std::string& out, const Plot& head, const PlotRow& row) {
    const auto to = std::back_inserter(out);
    for (std::size_t k = 0; k < row.size(); ++k) {
        if (k > 0) out += ',';
        const auto x = row[k];
        has_two_columns(head, head.curves[k]) ? fmt::format_to(to, "{},{}", x.real(), x.imag()) : fmt::format_to(to, "{}", x.real());
    }
    out += '\n';
}

}  // namespace corpuscle::circuit
