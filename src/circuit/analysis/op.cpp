// .op: the operating point, each device at it, and whether there is another.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/analyses.hpp"
#include "signal/quantity.hpp"

namespace corpuscle::circuit {
namespace {

/// Devices of a kind with their readings: a header, a row a device.
std::string table_of(const System& system, std::span<const double> x) {
    std::string out;
    for (const auto& n : system.names()) {
        const auto at = static_cast<std::size_t>(&n - system.names().data());
        out += fmt::format("{:24} {:>14}\n", n, format_quantity(x[at], system.is_voltage(static_cast<int>(at)) ? "V" : "A"));
    }
    std::vector<std::string_view> header;
    for (const auto& d : system.devices()) {
        const auto v = system.terminals(*d, x);
        const auto readings = d->readings(v);
        if (readings.empty()) continue;
        std::vector<std::string_view> names;
        for (const auto& r : readings) names.push_back(r.name);
        if (names != header) {
            header = names;
            out += fmt::format("\n{:24}", "");
            for (const auto& name : names) out += fmt::format(" {:>11}", name);
            out += '\n';
        }
        out += fmt::format("{:24}", d->name);
        for (const auto& r : readings) out += fmt::format(" {:>11}", format_quantity(r.value, r.unit));
        if (const auto state = d->state(v); !state.empty()) out += fmt::format("  {}", state);
        out += '\n';
    }
    return out;
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

}  // namespace

Result<Findings> analyse_op(TestBench& bench, const Command& c) {
    if (!c.words.empty()) return bad_input(fmt::format(".op takes no words, such as '{}'", c.words[0]), c.place);
    const auto found = bench.rest();
    if (!found) return found.error();
    Findings out;
    Plot plot = plot_of(bench.system, "Operating Point", "", "");
    for (std::size_t n = 0; n < found->x.size(); ++n) plot.curves[n].values.emplace_back(found->x[n]);
    out.plots.push_back(std::move(plot));
    if (bench.brief) return out;
    out.table = fmt::format("found by {} ({} iterations, gmin {:g} S)\n{}", found->how, found->iterations, bench.tolerances.gmin,
                            table_of(bench.system, found->x));
    if (auto other = other_state(bench, *found)) out.remarks.push_back(std::move(*other));
    return out;
}

}  // namespace corpuscle::circuit
