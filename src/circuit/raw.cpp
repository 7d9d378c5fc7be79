#include "circuit/raw.hpp"

#include <fmt/format.h>
#include <bit>
#include <cstdint>
#include <iterator>

namespace corpuscle::circuit {
namespace {

void append_bytes(std::string& out, double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    for (int k = 0; k < 8; ++k) out += static_cast<char>(bits >> (8 * k));
}

void append_plot(std::string& out, std::string_view title, const Plot& plot, bool binary) {
    const auto to = std::back_inserter(out);
    fmt::format_to(to, "Title: {}\nPlotname: {}\nFlags: {}\nNo. Variables: {}\nNo. Points: {}\nVariables:\n", title, plot.name,
                   plot.is_complex ? "complex" : "real", plot.curves.size(), plot.points());
    for (std::size_t k = 0; k < plot.curves.size(); ++k) fmt::format_to(to, "\t{}\t{}\t{}\n", k, plot.curves[k].name, plot.curves[k].type);
    out += binary ? "Binary:\n" : "Values:\n";
    for (std::size_t point = 0; point < plot.points(); ++point) {
        for (std::size_t k = 0; k < plot.curves.size(); ++k) {
            const auto x = plot.curves[k].values[point];
            if (binary) {
                append_bytes(out, x.real());
                if (plot.is_complex) append_bytes(out, x.imag());
                continue;
            }
            if (k == 0) fmt::format_to(to, " {}", point);
            if (plot.is_complex)
                fmt::format_to(to, "\t{:.15e},{:.15e}\n", x.real(), x.imag());
            else
                fmt::format_to(to, "\t{:.15e}\n", x.real());
        }
    }
    if (!binary) out += '\n';
}

}  // namespace

std::string raw_text(std::string_view title, std::span<const Plot> plots, bool binary) {
    std::string out;
    for (const auto& plot : plots) append_plot(out, title, plot, binary);
    return out;
}

namespace {
bool two_columns(const Plot& plot, const Curve& c) { return plot.is_complex && c.type != "frequency"; }
}  // namespace

std::string csv_header(const Plot& plot) {
    std::string out;
    for (const auto& c : plot.curves) {
        const auto name = c.name.find(',') == std::string::npos ? c.name : '"' + c.name + '"';
        out += &c == &plot.curves[0] ? "" : ",";
        out += two_columns(plot, c) ? fmt::format("{}.re,{}.im", name, name) : name;
    }
    return out + '\n';
}

std::string csv_rows(const Plot& plot, std::string_view before) {
    std::string out;
    const auto to = std::back_inserter(out);
    for (std::size_t point = 0; point < plot.points(); ++point) {
        out += before;
        for (const auto& c : plot.curves) {
            if (&c != &plot.curves[0]) out += ',';
            const auto x = c.values[point];
            two_columns(plot, c) ? fmt::format_to(to, "{},{}", x.real(), x.imag()) : fmt::format_to(to, "{}", x.real());
        }
        out += '\n';
    }
    return out;
}

}  // namespace corpuscle::circuit
