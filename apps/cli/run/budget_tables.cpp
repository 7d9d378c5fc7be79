// The power, area and leakage of a circuit as printed tables.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "cli/output/terminal.hpp"
#include "cli/run/variant_printer.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

using namespace circuit;

/// Published measurements of the most similar chip, for comparison.
constexpr std::string_view published_silicon =
    "For comparison, measured silicon (0.18 um): 12.33 nW per taxel, 25 taxels per mm2 (Alea et al. 2024,\n"
    "doi:10.1109/TBCAS.2024.3387545). Its piezoelectric taxels generate their own charge and respond to changes only, so compare\n"
    "the power without the sensor current. Areas here exclude wells, wires and pads.\n";

/// A number with three significant digits below 100 and as an integer above, so that a column can be added up by eye.
std::string cell(double x) { return x == 0 ? "0" : std::abs(x) < 100 ? fmt::format("{:.3g}", x) : fmt::format("{:.0f}", x); }
/// An area in m^2 as a number in um^2.
std::string um2(double area) { return cell(area * 1e12); }

using PowerOf = std::function<double(const PowerBreakdown&)>;

/// Adds a row with a power in nW for each column of Cost::power: "op", "mean" ... `power_of` selects the power (W) from a PowerBreakdown.
void add_row(TableRows& rows, const Cost& cost, std::string name, const PowerOf& power_of) {
    rows.push_back({std::move(name)});
    for (const auto& [when, p] : cost.power) rows.back().push_back(cell(power_of(p) * 1e9));
}

/// Adds the row if its power exceeds 1e-6 of the delivered power in any column.
void add_visible_row(TableRows& rows, const Cost& cost, std::string name, const PowerOf& power_of) {
    constexpr double visible = 1e-6;
    if (std::any_of(cost.power.begin(), cost.power.end(),
                    [&](const auto& column) { return std::abs(power_of(column.second)) > visible * std::abs(column.second.supplies); }))
        add_row(rows, cost, std::move(name), power_of);
}

std::string power_table(const Cost& cost) {
    TableRows rows = {{"power, nW"}};
    for (const auto& [when, p] : cost.power) rows[0].push_back(when == "op" ? ".op" : when);
    add_row(rows, cost, "delivered", &PowerBreakdown::supplies);
    for (std::size_t k = 0; k < cost.sources.size(); ++k)
        add_visible_row(rows, cost, "  by " + cost.sources[k], [k](const PowerBreakdown& p) { return p.sources[k]; });
    if (cost.has_sensor) {
        add_row(rows, cost, "  for the sensor current", &PowerBreakdown::sensor);
        add_row(rows, cost, "  without the sensor", &PowerBreakdown::without_sensor);
    }
    for (std::size_t k = 0; k < cost.blocks.size(); ++k)
        add_visible_row(rows, cost, "dissipated in " + cost.blocks[k].name, [k](const PowerBreakdown& p) { return p.blocks[k]; });
    return format_table(rows);
}

std::string area_table(const Cost& cost) {
    TableRows rows = {
        {"area, um2", "transistors", "elements", "gates", "arrays", "capacitors", "total", "isolated", "leakage, pA", "largest leak"}};
    const auto row = [&](const std::string& name, std::size_t transistors, std::size_t elements, const Area& a) {
        rows.push_back(
            table_row(name, transistors, elements, um2(a.gates), um2(a.arrays), um2(a.capacitors), um2(a.total()), um2(a.islands)));
    };
    std::size_t transistors = 0, elements = 0;
    for (const auto& b : cost.blocks) {
        transistors += b.transistors, elements += b.unit_transistors;
        if (b.area.total() == 0) continue;
        row(b.name, b.transistors, b.unit_transistors, b.area);
        rows.back().push_back(b.worst_leak.name.empty() ? "" : cell(b.worst_leak.current * 1e12));
        rows.back().push_back(b.worst_leak.name);
    }
    if (rows.size() == 1) return "";
    row("total", transistors, elements, cost.area());
    const auto unsized = cost.unknown_areas == 0
                             ? ""
                             : fmt::format("Not counted: {} device{} of unknown area (resistors, inductors, diodes, charge expressions)\n",
                                           cost.unknown_areas, cost.unknown_areas == 1 ? "" : "s");
    return "\n" + format_table(rows) + unsized;
}

std::string leaks_table(const Cost& cost) {
    if (cost.smallest_bias == 0) return "";
    const auto bias = format_quantity(cost.smallest_bias, "A");
    if (cost.leaks.empty())
        return fmt::format("\nNo transistor that is off leaks more than a tenth of the smallest bias current ({}).\n", bias);
    TableRows rows = {{"off in .op", "leakage, pA", "%", "into"}};
    for (std::size_t k = 0; k < cost.leaks.size(); ++k)
        rows.push_back({cost.leaks[k].name, cell(cost.leaks[k].current * 1e12), cell(100 * cost.leaks[k].current / cost.smallest_bias),
                        cost.leaks[k].capacitor_node});
    return fmt::format(
        "\nTransistors that are off but leak more than a tenth of the smallest bias current ({}), with V_GS = 0 and V_DS = {}:\n{}", bias,
        format_quantity(cost.supply, "V"), format_table(rows));
}

/// The mean power of a transient, or the power in .op if there is none.
const PowerBreakdown& typical_power(const Cost& cost) {
    const auto* mean = cost.powers("mean");
    return mean ? *mean : cost.power[0].second;
}

/// The number of afferents per area and per power; "" if the circuit is not an afferent.
std::string afferent_density(const Cost& cost) {
    if (!cost.is_afferent) return "";
    const auto& p = typical_power(cost);
    std::string out = "\nafferents";
    if (cost.area().total() > 0) out += fmt::format(" per mm2: {:.3g};", cost.per_mm2());
    if (p.without_sensor > 0) out += fmt::format(" per mW: {:.3g}", 1e-3 / p.without_sensor);
    if (cost.has_sensor && p.supplies > 0) out += fmt::format(", {:.3g} with the sensor current", 1e-3 / p.supplies);
    return out + (cost.powers("mean") ? " (mean power)\n" : " (power in .op)\n") + std::string(published_silicon);
}

}  // namespace

std::string budget_tables(const Cost& cost) { return power_table(cost) + area_table(cost) + leaks_table(cost) + afferent_density(cost); }

std::string budget_line(const Cost& cost) {
    const auto& p = typical_power(cost);
    return fmt::format("  power {}  of which sensor {}  area {:.4g} um2", format_quantity(p.supplies, "W"), format_quantity(p.sensor, "W"),
                       cost.area().total() * 1e12);
}

}  // namespace corpuscle
