#include "study/thesis/arrays.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/cost/area.hpp"
#include "circuit/device/constants.hpp"
#include "circuit/device/inversion.hpp"
#include "study/deck.hpp"
#include "study/spread.hpp"

namespace corpuscle {
namespace {

constexpr double um2 = 1e-12, half_volt = 0.5;
constexpr int chips = 2000;  // of the thesis 1000

/// Each array is there thrice: its gate, its drain or its bulk moves with vi; with vh gate and drain do.
std::string slopes_of(const std::string& array) {
    return fmt::format(".tf i({0}.vg) vi\n.tf i({0}.vd) vi\n.tf i({0}.vb) vi\n.tf i({0}.vb) vh\n", array);
}

double value(const circuit::Element& e, const char* name, double otherwise) {
    const auto found = e.values.find(name);
    return found == e.values.end() ? otherwise : found->second;
}

/// Of the copy whose gate moves: its transistors stand one above the other.
void size(OurArray& out, const circuit::Circuit& circuit, const std::string& array) {
    double per_S = 0;
    for (const auto& e : circuit.elements) {
        if (!e.name.starts_with(array + ".mg")) continue;
        const double m = value(e, "m", 1), n = value(e, "stack", 1), L = value(e, "l", 0);
        out.lengths.insert(out.lengths.end(), static_cast<std::size_t>(m * n), L);
        const auto& card = circuit.models[static_cast<std::size_t>(e.model)].values;
        out.A_VT = card.at("avt"), out.A_IS = card.at("ais");
        const double W = out.W = value(e, "w", 0);
        per_S += n * L / (m * W), out.A += m * n * W * L;
    }
    out.S = 1 / per_S;
    const double rows = out.printed->rows, columns = out.printed->columns;
    out.A_T = circuit::rectangle_area(out.W, out.A / (out.W * rows * columns), rows, columns);
}

/// What V_T as printed, taken for V_T0 of the plain equations, makes of g_mg/I_D in saturation.
double g_by_I_with_printed_threshold(const PrintedArray& p) {
    const double v_t = circuit::thermal_voltage(300.15), n = 1 + p.slope;
    const double q = circuit::inversion((half_volt - 1e-3 * p.V_T) / (n * v_t) + 1);
    return 2 / (n * v_t * (q + 2));
}

std::string of_early_voltage(const OurArray&) {
    return "V_A = V_E L with one V_E, fitted to the seven arrays of the shortest unit, is too simple for what the foundry's model does";
}

std::string of_threshold(const OurArray& a) {
    return fmt::format(
        "another definition: the simulator's V_T at its operating point; taken for V_T0 it would make g_mg/I_D {:.1f} 1/V in the equations "
        "of "
        "appendix A, where {:.2f} 1/V is printed",
        g_by_I_with_printed_threshold(*a.printed), a.printed->g_by_I);
}

}  // namespace

const PrintedArray& printed(const PrintedArrays& all, std::string_view name) {
    return *std::find_if(all.arrays.begin(), all.arrays.end(), [&](const auto& a) { return a.name == name; });
}

const OurArray& OurArrays::operator()(std::string_view name) const {
    return *std::find_if(begin(), end(), [&](const auto& a) { return a.printed->name == name; });
}

std::vector<Meant> all_meant(const PrintedArrays& all) {
    std::vector<Meant> out;
    for (const auto& a : all.arrays) out.push_back({&a, a.ours});
    return out;
}

double OurArray::gain() const { return 20 * std::log10(g_mg / g_md); }

double OurArray::law(double with_g_by_I) const { return 100 * std::hypot(A_VT * with_g_by_I, A_IS) / std::sqrt(A); }

double known_to() { return 100 / std::sqrt(2.0 * chips); }

Result<OurArrays> arrays_of(const PrintedArrays& all) { return arrays_of(all.circuit, all_meant(all)); }

Result<OurArrays> arrays_of(const char* circuit, std::span<const Meant> meant) {
    std::string orders = ".op\n";
    for (const auto& one : meant) orders += slopes_of(one.ours);
    const auto found = found_in({circuit, {}, orders});
    if (!found) return found.error();
    OurArrays out;
    for (const auto& [of, array] : meant) {
        const auto g = [&](char moved, const char* by) { return found->by(fmt::format("i({}.v{})", array, moved), by); };
        OurArray a{.printed = of, .g_md = g('d', "vi"), .g_mg = g('g', "vi"), .g_mb = g('b', "vi")};
        a.g_ms = g('b', "vh") + a.g_mb;  // all but the source moved
        a.I_D = found->at_rest(fmt::format("i({}.vg)", array));
        a.V_T = found->reading(array + ".mg2", "v_t");
        if (std::isnan(a.V_T)) a.V_T = found->reading(array + ".mg1", "v_t");
        size(a, *found->circuit, array);
        out.push_back(a);
    }
    return out;
}

Result<std::vector<double>> mismatch_of(const char* circuit, std::span<const Meant> meant) {
    const auto found = all_found_in({circuit, {}, fmt::format(".op\n.mc {} process=0", chips)});
    if (!found) return found.error();
    std::vector<double> out;
    for (const auto& one : meant) out.push_back(spread_of(*found, fmt::format("i({}.vg)", one.ours)).percent());
    return out;
}

Result<std::vector<double>> mismatch_of(const PrintedArrays& all) { return mismatch_of(all.circuit, all_meant(all)); }

void put_column(Outcome& out, const TableColumn& column, const OurArrays& ours, const std::string& source) {
    for (const auto& a : ours) {
        auto& c = out.claim(fmt::format("{}: {}", a.printed->name, column.what), column.made(a), column.unit);
        c.printed_as(column.factor * a.printed->*column.printed, *column.reading == 0 ? source : source + ", " + column.reading);
        if (c.needs_reason() && column.why != nullptr) c.because(column.why(a));
    }
}

void put_sizes(Outcome& out, const PrintedArrays& all, const OurArrays& ours) {
    using P = PrintedArray;
    const TableColumn columns[] = {
        {"S_eq", "", [](const OurArray& a) { return a.S; }, &P::S},
        {"A", "um^2", [](const OurArray& a) { return a.A / um2; }, &P::A},
        {"A_T", "um^2", [](const OurArray& a) { return a.A_T / um2; }, &P::A_T},
        {"A/A_T", "", [](const OurArray& a) { return a.A / a.A_T; }, &P::share},
    };
    for (const auto& column : columns) put_column(out, column, ours, all.sizes);
}

void put_small_signals(Outcome& out, const PrintedArrays& all, const OurArrays& ours) {
    using P = PrintedArray;
    const TableColumn columns[] = {
        {"g_md", "S", [](const OurArray& a) { return a.g_md; }, &P::g_md, all.g_md, of_early_voltage, all.g_md_is},
        {"g_mg", "S", [](const OurArray& a) { return a.g_mg; }, &P::g_mg, 1e-6},
        {"g_ms", "S", [](const OurArray& a) { return a.g_ms; }, &P::g_ms, 1e-6},
        {"g_mb", "S", [](const OurArray& a) { return a.g_mb; }, &P::g_mb, 1e-6},
        {"I_D", "A", [](const OurArray& a) { return a.I_D; }, &P::I_D, 1e-6},
        {"V_T", "V", [](const OurArray& a) { return a.V_T; }, &P::V_T, 1e-3, of_threshold},
    };
    for (const auto& column : columns) put_column(out, column, ours, all.small_signals);
}

void put_ratios(Outcome& out, const PrintedArrays& all, const OurArrays& ours) {
    using P = PrintedArray;
    const TableColumn columns[] = {
        {"g_mg/I_D", "1/V", [](const OurArray& a) { return a.g_by_I(); }, &P::g_by_I},
        {"I_D/g_md", "V", [](const OurArray& a) { return a.V_A(); }, &P::V_A, 1, of_early_voltage},
        {"g_mg/g_md", "dB", [](const OurArray& a) { return a.gain(); }, &P::gain},
        {"g_mb/g_mg", "", [](const OurArray& a) { return a.slope(); }, &P::slope, 1, {}, "its g_mg/g_mb upside down: errata U5"},
        {"g_mg/A", "S/um^2", [](const OurArray& a) { return a.g_by_A(); }, &P::g_by_A, all.g_by_A, {}, all.g_by_A_is},
    };
    for (const auto& column : columns) put_column(out, column, ours, all.ratios);
}

namespace {

std::string of_mismatch(const OurArray& a) {
    const std::string name = a.printed->name;
    if (name == "G3")
        return "in the equations the unit at the source is not quite saturated, i_r being an eighth of i_f: the seven above it share in "
               "the "
               "deviation";
    if (name == "F") return "the short transistor at the drain, whose deviation is large, has a share; at the source it has less (below)";
    return fmt::format(
        "one A_VT serves all: as a lone transistor of its area the card's law gives it {:.2f} % with the g_mg/I_D that is printed and "
        "{:.2f} % "
        "with ours; the draws here know a deviation to {:.1f} %, 1000 to 2.2 %",
        a.law(a.printed->g_by_I), a.law(a.g_by_I()), known_to());
}

}  // namespace

void put_mismatch(Outcome& out, const PrintedArrays& all, const OurArrays& ours, const std::vector<double>& sigmas) {
    for (std::size_t k = 0; k < sigmas.size(); ++k) {
        auto& c = out.claim(fmt::format("{}: deviation of I_D over its mean", ours[k].printed->name), sigmas[k], "%");
        c.printed_as(ours[k].printed->sigma, all.ratios);
        if (c.needs_reason()) c.because(of_mismatch(ours[k]));
    }
}

namespace {

double sum_misses(const PrintedArray& a, double g_md) {
    return std::abs(1e-6 * (a.g_mg + a.g_mb - a.g_ms) + g_md * a.g_md) / (1e-6 * a.g_ms);
}

double ratio_misses(const PrintedArray& a, double g_md) { return std::abs(1e-6 * a.I_D / (g_md * a.g_md * a.V_A) - 1); }

void put_rule(Outcome& out, const PrintedArrays& all, double head, const std::string& erratum, const std::string& what,
              double (*misses)(const PrintedArray&, double)) {
    double read = 0, printed = 0;
    bool every = true;
    for (const auto& a : all.arrays) {
        read = std::max(read, misses(a, all.g_md)), printed = std::max(printed, misses(a, head));
        every = every && misses(a, all.g_md) < misses(a, head);
    }
    out.finds(
        fmt::format("Printed alone: {} at most {:.2g} % off with the g_md read here, {:.2g} % with that of the head; nearer in every row",
                    what, 100 * read, 100 * printed),
        every, erratum);
}

}  // namespace

void put_sum_rule(Outcome& out, const PrintedArrays& all, double head, const std::string& erratum) {
    put_rule(out, all, head, erratum, "g_mg + g_md + g_mb is from g_ms", sum_misses);
}

void put_ratio_rule(Outcome& out, const PrintedArrays& all, double head, const std::string& erratum) {
    put_rule(out, all, head, erratum, "I_D over g_md is from its column", ratio_misses);
}

}  // namespace corpuscle
