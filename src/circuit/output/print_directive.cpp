#include "circuit/output/print_directive.hpp"

#include <fmt/format.h>
#include <cmath>
#include <iterator>

#include "circuit/analyses.hpp"
#include "circuit/measure/line_segment.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double max_rows = 1e6;  // of one table of a .tran

struct Column {
    std::string name;
    CurveView view;
};

/// The columns of a directive, the swept quantity first. Empty if it is not a .print line, names another analysis, or names no curve of the
/// plot.
std::vector<Column> columns_of(const Directive& c, std::string_view analysis, const Plot& plot) {
    std::vector<Column> out;
    const bool names_analysis = !c.words.empty() && find_analysis(c.words[0]) != nullptr;
    if (c.name != "print" || (names_analysis && c.words[0] != analysis)) return out;
    if (plot.has_sweep) out.push_back({plot.curves[0].name, *CurveView::find(plot, plot.curves[0].name)});
    for (std::size_t w = names_analysis ? 1 : 0; w < c.words.size(); ++w)
        if (c.words[w] == "all")
            for (std::size_t k = plot.has_sweep; k < plot.curves.size(); ++k)
                out.push_back({plot.curves[k].name, *CurveView::find(plot, plot.curves[k].name)});
        else if (const auto view = CurveView::find(plot, c.words[w]))
            out.push_back({c.words[w], *view});
    if (out.size() < (plot.has_sweep ? 2U : 1U)) out.clear();
    return out;
}

std::string column_heads(const std::vector<Column>& columns) {
    std::string out;
    for (const auto& c : columns) fmt::format_to(std::back_inserter(out), "{:>16}", c.name);
    return out + '\n';
}

void append_number(std::string& out, std::complex<double> x) {
    const auto to = std::back_inserter(out);
    x.imag() == 0 ? fmt::format_to(to, "{:16.7e}", x.real()) : fmt::format_to(to, " {:.7e},{:.7e}", x.real(), x.imag());
}

}  // namespace

std::string print_tables(const Circuit& circuit, std::string_view analysis, const Plot& plot) {
    std::string out;
    for (const auto& c : circuit.directives) {
        const auto columns = columns_of(c, analysis, plot);
        if (columns.empty()) continue;
        out += column_heads(columns);
        std::vector<std::vector<std::complex<double>>> values;
        for (const auto& column : columns) values.push_back(column.view.all_values(plot));
        for (std::size_t point = 0; point < plot.point_count(); ++point) {
            for (const auto& v : values) append_number(out, v[point]);
            out += '\n';
        }
    }
    return out;
}

Result<void> TransientPrinter::begin(const Plot& plot) {
    for (const auto& c : circuit_.directives) {
        const auto columns = columns_of(c, "tran", plot);
        if (columns.empty()) continue;
        if (const double rows = std::floor((stop_ - start_) / step_) + 1; rows > max_rows)
            return bad_input(
                fmt::format(
                    ".print tran: {:g} rows (one every {:g} s over {:g} s) exceed the limit of {:g}; use a longer STEP of .tran, or --out",
                    rows, step_, stop_ - start_, max_rows),
                c.location);
        tables_.push_back({{}, column_heads(columns)});
        for (const auto& column : columns) tables_.back().views.push_back(column.view);
    }
    return {};
}

/// Appends a row to each table, at time t between the previous point and the point `row`.
void TransientPrinter::print(std::span<const double> row, double t) {
    for (auto& table : tables_) {
        for (const auto& view : table.views) {
            const double before = view.value(PlotRow(previous_)).real(), now = view.value(PlotRow(row)).real();
            const bool is_time = &view == &table.views[0];
            append_number(table.text, is_time ? t : LineSegment{previous_[0], before, row[0], now}.at(t));
        }
        table.text += '\n';
    }
    ++rows_;
}

void TransientPrinter::add_point(std::span<const double> row) {
    if (tables_.empty()) return;
    if (previous_.empty()) {
        previous_.assign(row.begin(), row.end());
        // Skips rows before the first point. The tolerance keeps a row that is at this point up to rounding.
        while (is_row_due(row[0] - 1e-9 * step_)) ++rows_;
    }
    while (is_row_due(row[0])) print(row, start_ + rows_ * step_);
    previous_.assign(row.begin(), row.end());
}

// The time of the last row may exceed the end of the analysis by a rounding error.
std::string TransientPrinter::end() {
    if (!previous_.empty() && is_row_due(previous_[0] + 1e-9 * step_)) print(std::vector(previous_), start_ + rows_ * step_);
    std::string out;
    for (auto& table : tables_) out += table.text;
    tables_.clear();
    return out;
}

}  // namespace corpuscle::circuit
