// .op: the operating point, each device at it, and whether there is another.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "circuit/analyses.hpp"
#include "circuit/analysis/rest_states.hpp"
#include "signal/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::size_t page_width = 100, least_cell_width = 12, least_name_width = 24;

/// Devices that follow one another and have the same readings.
struct DeviceGroup {
    struct Row {
        std::string name, state;
        std::vector<std::string> cells;
    };
    std::vector<std::string_view> readings;
    std::vector<Row> rows;

    template <class Length>
    std::size_t longest(std::size_t least, const Length& length) const {
        for (const auto& r : rows) least = std::max(least, length(r));
        return least;
    }

    /// A header, a row a device: as often as it takes for all readings on lines of 100 letters. The state stands behind the last of them.
    std::string table() const {
        const auto name_width = longest(least_name_width, [](const Row& r) { return r.name.size(); });
        const auto state_width = longest(0, [](const Row& r) { return r.state.empty() ? 0 : r.state.size() + 2; });
        std::vector<std::size_t> widths;
        for (std::size_t k = 0; k < readings.size(); ++k)
            widths.push_back(
                longest(std::max(least_cell_width, readings[k].size() + 1), [k](const Row& r) { return r.cells[k].size() + 1; }));
        std::string out;
        for (std::size_t from = 0, to = 0; from < readings.size(); from = to) {
            auto width = name_width + widths[to++];
            const auto behind = [&] { return to + 1 == readings.size() ? state_width : 0; };  // the reading that is next
            while (to < readings.size() && width + widths[to] + behind() <= page_width) width += widths[to++];
            out += fmt::format("\n{:{}}", "", name_width);
            for (std::size_t k = from; k < to; ++k) out += fmt::format("{:>{}}", readings[k], widths[k]);
            for (const auto& r : rows) {
                out += fmt::format("\n{:{}}", r.name, name_width);
                for (std::size_t k = from; k < to; ++k) out += fmt::format("{:>{}}", r.cells[k], widths[k]);
                if (to == readings.size() && !r.state.empty()) out += "  " + r.state;
            }
            out += '\n';
        }
        return out;
    }
};

/// All unknowns, then the devices with their readings.
std::string table_of(const System& system, std::span<const double> x) {
    std::string out;
    for (const auto& n : system.names()) {
        const auto at = static_cast<std::size_t>(&n - system.names().data());
        out += fmt::format("{:24} {:>14}\n", n, format_quantity(x[at], system.is_voltage(static_cast<int>(at)) ? "V" : "A"));
    }
    DeviceGroup group;
    for (const auto& d : system.devices()) {
        const auto v = system.terminals(*d, x);
        const auto readings = d->readings(v);
        if (readings.empty()) continue;
        std::vector<std::string_view> names;
        DeviceGroup::Row row{d->name, std::string(d->state(v)), {}};
        for (const auto& r : readings) names.push_back(r.name), row.cells.push_back(format_quantity(r.value, r.unit));
        if (names != group.readings) {
            out += group.table();
            group = {std::move(names), {}};
        }
        group.rows.push_back(std::move(row));
    }
    return out + group.table();
}

/// A second look from elsewhere: all nodes high. Its answer, if it is another one.
std::optional<Error> other_state(TestBench& bench, const OperatingPoint& found) {
    if (bench.system.linear() || !bench.circuit->nodesets.empty()) return {};
    double high = 0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(bench.system.nodes()); ++n) high = std::max(high, std::abs(found.x[n]));
    std::vector<double> start(found.x.size());
    for (std::size_t n = 0; n < static_cast<std::size_t>(bench.system.nodes()); ++n) start[n] = high;
    const auto again = operating_point(bench.newton, std::move(start));
    if (!again) return {};
    for (std::size_t n = 0; n < static_cast<std::size_t>(bench.system.nodes()); ++n)
        if (std::abs(again->x[n] - found.x[n]) > 1e-3)
            return Error{
                Code::not_converged,
                fmt::format("more than one state is stable: {} is {} from 0 V on, {} from {} on; .nodeset chooses", bench.system.names()[n],
                            format_quantity(found.x[n], "V"), format_quantity(again->x[n], "V"), format_quantity(high, "V")),
                Place{bench.circuit->file}};
    return {};
}

/// .op [states [RISE]]
struct OpWords {
    bool states = false;
    double rise = 1e-3;  // s
};
Result<OpWords> op_words(const Command& c) {
    OpWords out;
    if (c.words.empty()) return out;
    if (c.words[0] != "states") return error_at(c, 0, fmt::format(".op takes no word but 'states', not '{}'", c.words[0]));
    if (c.words.size() > 2) return error_at(c, 2, fmt::format(".op: '{}' is one word too many; it is .op states [RISE]", c.words[2]));
    out.states = true;
    if (c.words.size() == 1) return out;
    const auto rise = number_of(c, 1, "a time in which the sources rise");
    if (!rise) return rise.error();
    if (!(*rise > 0 && *rise <= 1e3))
        return error_at(c, 1, fmt::format(".op: the sources rise within {:g} s; above 0, at most 1000", *rise));
    return out.rise = *rise, out;
}

/// Numbers, so that .mc counts them over its chips; and a table.
Result<void> tell_states(TestBench& bench, const OpWords& asked, Findings& out) {
    const auto states = rest_states(bench, asked.rise);
    if (!states) return states.error();
    double stable = 0, unusual = 1;  // unusual: switched on, it comes elsewhere, or nowhere
    for (const auto& s : *states) stable += s.stable, unusual -= s.usual && s.power_on;
    out.numbers = {
        {"stable_states", stable}, {"unstable_states", static_cast<double>(states->size()) - stable}, {"power_on_elsewhere", unusual}};
    out.table = told(bench, *states);
    return {};
}

}  // namespace

Result<Findings> analyse_op(TestBench& bench, const Command& c) {
    const auto asked = op_words(c);
    if (!asked) return asked.error();
    const auto found = bench.rest();
    if (!found) return found.error();
    Findings out;
    Plot plot = plot_of(bench.system, "Operating Point", "", "");
    for (std::size_t n = 0; n < found->x.size(); ++n) plot.curves[n].values.emplace_back(found->x[n]);
    out.plots.push_back(std::move(plot));
    if (asked->states)
        if (auto done = tell_states(bench, *asked, out); !done) return done.error();
    if (bench.brief) return out;
    out.table = fmt::format("found by {} ({} iterations, gmin {:g} S)\n{}{}", found->how, found->iterations, bench.tolerances.gmin,
                            out.table, table_of(bench.system, found->x));
    if (asked->states) return out;
    if (auto other = other_state(bench, *found)) out.remarks.push_back(std::move(*other));
    return out;
}

}  // namespace corpuscle::circuit
