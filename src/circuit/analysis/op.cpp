// .op: the operating point, the quantities of each device, and a search for other equilibria.

#include <algorithm>
#include <cmath>

#include "circuit/analysis/equilibria.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

// In characters.
constexpr std::size_t page_width = 100, min_cell_width = 12, min_name_width = 24;

/// The quantities of successive devices of one kind, as a table.
struct DeviceTable {
    struct DeviceRow {
        std::string name, region;
        std::vector<std::string> cells;
    };
    std::vector<std::string_view> quantities;
    std::vector<DeviceRow> rows;

    template <class Length>
    std::size_t max_length(std::size_t minimum, const Length& length) const {
        for (const auto& r : rows) minimum = std::max(minimum, length(r));
        return minimum;
    }

    /// Several tables below one another, so that no line exceeds page_width: each has a header and a row for each device. The
    /// operating region of a device follows its last quantity.
    std::string text() const {
        const auto name_width = max_length(min_name_width, [](const DeviceRow& r) { return r.name.size(); });
        const auto region_width = max_length(0, [](const DeviceRow& r) { return r.region.empty() ? 0 : r.region.size() + 2; });
        std::vector<std::size_t> widths;
        for (std::size_t k = 0; k < quantities.size(); ++k)
            widths.push_back(
                max_length(std::max(min_cell_width, quantities[k].size() + 1), [k](const DeviceRow& r) { return r.cells[k].size() + 1; }));
        std::string out;
        for (std::size_t from = 0, to = 0; from < quantities.size(); from = to) {
            auto width = name_width + widths[to++];
            const auto region_column = [&] { return to + 1 == quantities.size() ? region_width : 0; };  // for the next quantity
            while (to < quantities.size() && width + widths[to] + region_column() <= page_width) width += widths[to++];
            out += fmt::format("\n{:{}}", "", name_width);
            for (std::size_t k = from; k < to; ++k) out += fmt::format("{:>{}}", quantities[k], widths[k]);
            for (const auto& r : rows) {
                out += fmt::format("\n{:{}}", r.name, name_width);
                for (std::size_t k = from; k < to; ++k) out += fmt::format("{:>{}}", r.cells[k], widths[k]);
                if (to == quantities.size() && !r.region.empty()) out += "  " + r.region;
            }
            out += '\n';
        }
        return out;
    }
};

/// All unknowns, then the devices with their quantities.
std::string operating_point_table(const System& system, std::span<const double> x) {
    std::string out;
    for (const auto& n : system.names()) {
        const auto at = static_cast<std::size_t>(&n - system.names().data());
        out += fmt::format("{:24} {:>14}\n", n, format_quantity(x[at], system.is_voltage(static_cast<int>(at)) ? "V" : "A"));
    }
    DeviceTable table;
    for (const auto& d : system.devices()) {
        const auto v = system.terminal_values(*d, x);
        const auto quantities = d->operating_info(v);
        if (quantities.empty()) continue;
        std::vector<std::string_view> names;
        DeviceTable::DeviceRow row{d->name, std::string(d->operating_region(v)), {}};
        for (const auto& r : quantities) names.push_back(r.name), row.cells.push_back(format_quantity(r.value, r.unit));
        if (names != table.quantities) {
            out += table.text();
            table = {std::move(names), {}};
        }
        table.rows.push_back(std::move(row));
    }
    return out + table.text();
}

/// Searches again, from a start with all nodes at the largest node voltage of the operating point. Returns a warning if the result differs
/// from the operating point by more than 1 mV at a node.
std::optional<Error> check_second_state(AnalysisContext& context, const OperatingPoint& found) {
    if (context.system.is_linear() || !context.circuit->nodesets.empty()) return {};
    const auto nodes = static_cast<std::size_t>(context.system.nodes());
    double high = 0;
    for (std::size_t n = 0; n < nodes; ++n) high = std::max(high, std::abs(found.x[n]));
    std::vector<double> start(found.x.size());
    std::fill_n(start.begin(), nodes, high);
    context.system.reset_states();
    const auto again = find_operating_point(context.newton, std::move(start));
    context.system.set_states(found.states);
    if (!again) return {};
    for (std::size_t n = 0; n < nodes; ++n)
        if (std::abs(again->x[n] - found.x[n]) > 1e-3)
            return Error{
                ErrorCode::not_converged,
                fmt::format(
                    "more than one stable state: {} is {} if the search starts from 0 V, {} if it starts from {}; choose with .nodeset",
                    context.system.names()[n], format_quantity(found.x[n], "V"), format_quantity(again->x[n], "V"),
                    format_quantity(high, "V")),
                SourceLocation{context.circuit->file}};
    return {};
}

/// The words of .op [states [RISE]].
struct OpOptions {
    bool states = false;  // true if given
    double rise = 1e-3;   // s: rise time of the sources at power-on
};
Result<OpOptions> read_op_options(const Directive& c) {
    OpOptions out;
    if (c.words.empty()) return out;
    if (c.words[0] == "trace") return out;  // of gnucap; see warn_about_op_words()
    if (c.words[0] != "states") return error_at(c.location_of(0), ".op: '{}' is not an option; the only one is 'states'", c.words[0]);
    if (c.words.size() > 2) return error_at(c.location_of(2), ".op: unexpected '{}'; expected .op states [RISE]", c.words[2]);
    out.states = true;
    if (c.words.size() == 1) return out;
    const auto rise = TRY(read_number(c, 1, "the rise time of the sources"));
    if (!(rise > 0 && rise <= 1e3)) return error_at(c.location_of(1), ".op: the rise time {:g} s must be above 0 and at most 1000 s", rise);
    return out.rise = rise, out;
}

/// Adds the counts of states, which .mc evaluates over its chips, and a table of the states.
Result<void> report_states(AnalysisContext& context, const OpOptions& options, AnalysisResult& out) {
    const auto states = TRY(find_equilibria(context, options.rise));
    double stable = 0, elsewhere = 1;  // elsewhere: 1 if the circuit does not reach the state of .op at power-on, otherwise 0
    for (const auto& s : states) stable += s.is_stable, elsewhere -= s.is_default && s.is_power_on;
    out.numbers = {
        {"stable_states", stable}, {"unstable_states", static_cast<double>(states.size()) - stable}, {"power_on_elsewhere", elsewhere}};
    out.table = describe(context, states);
    return {};
}

Result<AnalysisResult> analyse_op(AnalysisContext& context, const Directive& c) {
    const auto options = TRY(read_op_options(c));
    const auto found = TRY(context.operating_point());
    AnalysisResult out;
    Plot plot = make_plot(context.system, "Operating Point", "", "");
    for (std::size_t n = 0; n < found.x.size(); ++n) plot.curves[n].values.emplace_back(found.x[n]);
    out.plots.push_back(std::move(plot));
    if (options.states) TRY(report_states(context, options, out));
    context.system.set_states(found.states);
    if (context.is_brief) return out;
    out.table = fmt::format("found by {} ({} iterations, gmin {:g} S)\n{}{}", found.method, found.iterations, context.tolerances.gmin,
                            out.table, operating_point_table(context.system, found.x));
    if (options.states) return out;
    if (auto other = check_second_state(context, found)) out.warnings.push_back(std::move(*other));
    return out;
}

Plot expected_op_plot(const System& system, const Directive&) { return make_plot(system, "Operating Point", "", ""); }

constexpr std::string_view op_numbers[] = {"stable_states", "unstable_states", "power_on_elsewhere"};

}  // namespace

extern constexpr Analysis op_analysis = {.name = "op",
                                         .usage = ".op [states [RISE]]",
                                         .description = "the operating point, the state of every device, and other stable states",
                                         .run = analyse_op,
                                         .expected_plot = expected_op_plot,
                                         .numbers = op_numbers,
                                         .ngspice_order = 3};

}  // namespace corpuscle::circuit
