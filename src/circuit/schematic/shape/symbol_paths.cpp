#include "circuit/schematic/shape/symbol_paths.hpp"

namespace corpuscle::circuit::schematic {
namespace {

SymbolPath mos_path(const Part& part) {
    const bool is_p = part.symbol == Symbol::pmos;
    SymbolPath out;
    out.lines = "M0-30V-12H-10M-10-17V17M-10 12H0V30M-15-12V12";
    const int gate = part.is_high_threshold ? -18 : -15;
    if (part.is_high_threshold) out.lines += "M-18-12V12";
    out.lines += is_p ? fmt::format("M{} 0a3 3 0 1 0-6 0a3 3 0 1 0 6 0M{} 0H-30", gate, gate - 6) : fmt::format("M{} 0H-30", gate);
    if (part.pins.size() > 3) out.lines += "M-10 0H10";
    out.solid = is_p ? "M-9-12l7-3v6z" : "M-1 12l-7-3v6z";
    return out;
}

SymbolPath bipolar_path(const Part& part) {
    const bool is_p = part.symbol == Symbol::pnp;
    SymbolPath out;
    out.lines = "M-30 0H-12M-12-15V15M-12-6L0-16V-30M-12 6L0 16V30";
    if (part.pins.size() > 3) out.lines += "M-6 0H10";  // the substrate, apart from the base
    out.solid = is_p ? "M-10-7.6l8-2.6l-4-4.2z" : "M-1 15.2l-8.200-2.600l4-4.600z";
    return out;
}

/// A circle or a diamond with signs of a voltage, or with the arrow of a current.
SymbolPath source_path(const Part& part) {
    const bool is_controlled = part.symbol == Symbol::controlled_voltage || part.symbol == Symbol::controlled_current;
    const bool is_voltage = part.symbol == Symbol::voltage_source || part.symbol == Symbol::controlled_voltage;
    SymbolPath out;
    out.lines = is_controlled ? "M0-30V-16L14 0L0 16V30M0-16L-14 0L0 16" : "M0-30V-14M0 14V30M0-14a14 14 0 1 1 0 28a14 14 0 1 1 0-28";
    if (is_voltage)
        out.signs = {{{0, -6}, true}, {{0, 6}, false}};
    else
        out.lines += "M0-8V4", out.solid = "M0 9l-4-7h8z";
    return out;
}

}  // namespace

SymbolPath symbol_path(const Part& part) {
    SymbolPath out;
    switch (part.symbol) {
        case Symbol::nmos:
        case Symbol::pmos:
            return mos_path(part);
        case Symbol::npn:
        case Symbol::pnp:
            return bipolar_path(part);
        case Symbol::resistor:
            out.lines = "M0-30V-18L6-15L-6-9L6-3L-6 3L6 9L-6 15L0 18V30";
            break;
        case Symbol::capacitor:
            out.lines = "M0-30V-3M-11-3H11M-11 3H11M0 3V30";
            break;
        case Symbol::inductor:
            out.lines = "M0-30V-18a6 6 0 0 1 0 12a6 6 0 0 1 0 12a6 6 0 0 1 0 12V30";
            break;
        case Symbol::diode:
            out.lines = "M0-30V-8M0 8V30M-9 8H9", out.solid = "M-9-8h18l-9 16z";
            break;
        case Symbol::switch_contact:
            out.lines = "M0-30V-10L10 8M0 10V30";
            break;
        case Symbol::voltage_source:
        case Symbol::current_source:
        case Symbol::controlled_voltage:
        case Symbol::controlled_current:
            out = source_path(part);
            break;
        default:
            break;
    }
    for (std::size_t k = 2; k < part.pins.size(); ++k) {  // controlling nodes
        const int others = static_cast<int>(part.pins.size()) - 2, place = static_cast<int>(k) - 2;
        const int y = others == 2 ? 20 * place - 10 : (place - (others - 1) / 2) * 10;
        out.lines += fmt::format("M-30 {}H-16", y);
    }
    if (part.has_controlling_pair) out.signs.push_back({{-22, -15}, true}), out.signs.push_back({{-22, 15}, false});
    return out;
}

}  // namespace corpuscle::circuit::schematic
