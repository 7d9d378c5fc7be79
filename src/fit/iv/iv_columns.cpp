#include "fit/iv/iv_columns.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "io/table/heading.hpp"

namespace corpuscle {
namespace {

struct Alias {
    IvQuantity quantity;
    double sign;
    std::string_view names;  // separated by blanks; in small letters without blanks, '_' and '-'
};
using enum IvQuantity;
constexpr Alias aliases[] = {
    {v_gs, 1, "vgs v(g,s)"},
    {v_gs, -1, "vsg"},
    {v_ds, 1, "vds v(d,s)"},
    {v_ds, -1, "vsd"},
    {v_bs, 1, "vbs v(b,s)"},
    {v_bs, -1, "vsb"},
    {v_g, 1, "vg v(g) v(gate) vgate gatev gatevoltage"},
    {v_d, 1, "vd v(d) v(drain) vdrain drainv drainvoltage"},
    {v_s, 1, "vs v(s) v(source) vsource sourcev sourcevoltage"},
    {v_b, 1, "vb v(b) v(bulk) vbulk vsub bulkv subv bulkvoltage"},
    {i_d, 1, "id ids idrain draini draincurrent id(m1) i(m1) @m1[id]"},
    {i_d, -1, "i(vd) i(vdd) i(vds) i(vdrain) vd#branch vdd#branch vds#branch vdrain#branch i(@vd[i])"},
    {i_b, 1, "ib ibulk isub bulki subi bulkcurrent ib(m1) @m1[ib]"},
    {i_b, -1, "i(vb) i(vbs) i(vbulk) vb#branch vbs#branch vbulk#branch"},
    {temperature, 1, "t temp temperature tempsweep temp(c)"},
    {width, 1, "w width"},
    {length, 1, "l length"},
    {device, 1, "device deviceid dut chip chipnumber die sample"},
};

std::string normalized(std::string_view text) {
    std::string out;
    for (const char c : trimmed(text))
        if (c != ' ' && c != '_' && c != '-') out += lower(c);
    return out;
}

const Alias* alias_of(std::string_view heading) {
    const auto name = normalized(heading);
    for (const auto& a : aliases)
        if (const auto names = split(a.names, ' '); std::find(names.begin(), names.end(), name) != names.end()) return &a;
    return nullptr;
}

constexpr std::string_view si_unit(IvQuantity q) {
    return q == width || q == length ? "m" : q == i_d || q == i_b ? "A" : q == temperature ? "C" : q == device ? "" : "V";
}

/// The conversion from a unit as written in a heading; "" is SI.
Result<IvColumn> conversion(IvQuantity q, std::string_view unit, std::string_view heading) {
    if (q == device || unit.empty()) return IvColumn{};
    if (q == temperature) {
        const auto name = lower(unit);
        if (name == "k" || name == "kelvin") return IvColumn{0, 1, -273.15};
        if (name == "c" || name == "degc" || name == "celsius" || name.ends_with("\u00b0c") || name == "deg") return IvColumn{};
        return bad_input(fmt::format("'{}': temperatures are in C or K, such as 'T (C)'", heading.substr(0, 60)));
    }
    const auto parsed = parse_unit(unit), expected = parse_unit(si_unit(q));
    if (!parsed || !parsed->has_same_dimension(*expected))
        return bad_input(fmt::format("'{}': the unit of {} must be one of {}, such as '{} (u{})'", heading.substr(0, 60),
                                     iv_quantity_names[static_cast<std::size_t>(q)], si_unit(q),
                                     iv_quantity_names[static_cast<std::size_t>(q)], si_unit(q)));
    return IvColumn{0, parsed->factor, 0};
}

/// The unit of a heading whose name is known without it; the whole heading can be a name: "v_s" is not v in seconds.
std::string unit_of(std::string_view heading) { return alias_of(heading) ? "" : parse_heading(heading).unit; }

Result<IvColumn> chosen_column(std::span<const std::string> headings, const IvColumnChoice& choice) {
    for (std::size_t k = 0; k < headings.size(); ++k) {
        const auto& heading = headings[k];
        const bool is_whole = equal_ignoring_case(heading, choice.heading);
        if (!is_whole && !equal_ignoring_case(parse_heading(heading).name, choice.heading)) continue;
        auto column = TRY(conversion(choice.quantity, unit_of(heading), heading));
        column.index = k, column.factor *= choice.sign;
        return column;
    }
    return bad_input(fmt::format("--column {}={}: there is no such column; the file has: {}",
                                 iv_quantity_names[static_cast<std::size_t>(choice.quantity)], choice.heading, joined(headings)));
}

}  // namespace

Result<IvColumnChoice> parse_column_choice(const std::string& text) {
    const auto equals = text.find('=');
    const auto name = lower(trimmed(std::string_view(text).substr(0, equals)));
    for (std::size_t q = 0; q < iv_quantities && equals != text.npos; ++q) {
        if (name != iv_quantity_names[q]) continue;
        auto heading = trimmed(std::string_view(text).substr(equals + 1));
        const bool is_negative = heading.starts_with('-');
        if (is_negative) heading.remove_prefix(1);
        if (heading.empty()) break;
        return IvColumnChoice{static_cast<IvQuantity>(q), std::string(heading), is_negative ? -1.0 : 1.0};
    }
    return bad_usage(fmt::format("'{}': write NAME=HEAD, such as i_d=-i(vx); NAME is one of {}", text, joined(iv_quantity_names)));
}

Result<IvColumns> find_iv_columns(std::span<const std::string> headings, const std::vector<IvColumnChoice>& choices) {
    IvColumns out;
    for (std::size_t k = 0; k < headings.size(); ++k) {
        const auto* alias = alias_of(headings[k]);
        if (!alias) alias = alias_of(parse_heading(headings[k]).name);
        if (!alias) continue;
        auto& column = out[static_cast<std::size_t>(alias->quantity)];
        if (column) continue;  // the first of several
        column = TRY(conversion(alias->quantity, unit_of(headings[k]), headings[k]));
        column->index = k, column->factor *= alias->sign;
    }
    for (const auto& choice : choices) out[static_cast<std::size_t>(choice.quantity)] = TRY(chosen_column(headings, choice));
    const auto has = [&](IvQuantity q) { return out[static_cast<std::size_t>(q)].has_value(); };
    const auto missing = [&](std::string_view what, std::string_view example) {
        return bad_input(fmt::format("no column holds {}; this file has: {}. Name one: --column {}", what, joined(headings), example));
    };
    if (!has(i_d)) return missing("the drain current", "i_d=HEAD");
    if (!has(v_g) && !has(v_gs)) return missing("the gate voltage", "v_gs=HEAD");
    return out;
}

}  // namespace corpuscle
