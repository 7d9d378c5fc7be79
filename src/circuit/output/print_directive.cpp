#include "circuit/output/print_directive.hpp"

#include <fmt/format.h>
#include <cmath>
#include <iterator>

#include "circuit/analyses.hpp"
#include "circuit/measure/measurement.hpp"

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

Result<void> TablePrinter::begin(const Plot& plot) {
    for (const auto& c : circuit_.directives) {
        const auto columns = columns_of(c, analysis_, plot);
        if (columns.empty()) continue;
        if (const double rows = std::floor((times_.stop - times_.start) / times_.step) + 1; times_.step > 0 && rows > max_rows)
            return error_at(
                c.location,
                ".print tran: {:g} rows (one every {:g} s over {:g} s) exceed the limit of {:g}; use a longer STEP of .tran, or --out",
                rows, times_.step, times_.stop - times_.start, max_rows);
        tables_.push_back({{}, column_heads(columns)});
        for (const auto& column : columns) tables_.back().views.push_back(column.view);
    }
    return {};
}

/// Appends a row to each table, at a time between the previous point and the point `row`.
void TablePrinter::print_at_next_time(std::span<const double> row) {
    const double t = next_time();
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

Result<void> TablePrinter::add_point(const PlotRow& row) {
    if (times_.step == 0) {
        for (auto& table : tables_) {
            for (const auto& view : table.views) append_number(table.text, view.value(row));
            table.text += '\n';
        }
        return {};
    }
    if (tables_.empty()) return {};
    const double t = row.real[0];
    if (previous_.empty()) {
        previous_.assign(row.real.begin(), row.real.end());
        // Skips rows before the first point. The tolerance keeps a row that is at this point up to rounding.
        while (next_time() <= t - 1e-9 * times_.step) ++rows_;
    }
    while (next_time() <= t) print_at_next_time(row.real);
    previous_.assign(row.real.begin(), row.real.end());
    return {};
}

/// The time of the last row may exceed the end of the analysis by a rounding error.
Result<void> TablePrinter::end() {
    if (!previous_.empty() && next_time() <= previous_[0] + 1e-9 * times_.step) print_at_next_time(std::vector(previous_));
    return {};
}

std::string TablePrinter::text() const {
    std::string out;
    for (const auto& table : tables_) out += table.text;
    return out;
}

}  // namespace corpuscle::circuit
