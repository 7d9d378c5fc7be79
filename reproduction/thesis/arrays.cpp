#include "reproduction/thesis/arrays.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/cost/area.hpp"
#include "circuit/device/inversion_charge.hpp"
#include "circuit/device/physical_constants.hpp"
#include "reproduction/claims/sample_statistics.hpp"
#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle {
namespace {

constexpr double um2 = 1e-12, half_volt = 0.5;  // m^2; V, the gate and drain voltage of all tables
constexpr int chips = 2000;                     // sampled for the mismatch; the thesis has 1000

/// The netlist has three copies of each array, with drain currents i(vg), i(vd) and i(vb). Source vi is added to the gate of the first
/// copy, the drain of the second and the bulk of the third. Source vh is V_G and V_D of the third copy.
std::string slope_directives(const std::string& array) {
    return fmt::format(".tf i({0}.vg) vi\n.tf i({0}.vd) vi\n.tf i({0}.vb) vi\n.tf i({0}.vb) vh\n", array);
}

double value(const circuit::Element& e, const char* name, double otherwise) {
    const auto found = e.values.find(name);
    return found == e.values.end() ? otherwise : found->second;
}

/// Reads the sizes from the transistors (mg1, mg2, ...) of the copy whose gate is varied. They are in series, beginning at the drain.
void measure_size(SimulatedArray& out, const circuit::Circuit& circuit, const std::string& array) {
    double inverse_S = 0;
    for (const auto& e : circuit.elements) {
        if (!e.name.starts_with(array + ".mg")) continue;
        const double m = value(e, "m", 1), n = value(e, "stack", 1), L = value(e, "l", 0);
        out.lengths.insert(out.lengths.end(), static_cast<std::size_t>(m * n), L);
        const auto& card = circuit.models[static_cast<std::size_t>(e.model)].values;
        out.A_VT = card.at("avt"), out.A_IS = card.at("ais");
        const double W = out.W = value(e, "w", 0);
        inverse_S += n * L / (m * W), out.A += m * n * W * L;
    }
    out.S = 1 / inverse_S;
    const double rows = out.published->rows, columns = out.published->columns;
    out.A_T = circuit::rectangle_area(out.W, out.A / (out.W * rows * columns), rows, columns);
}

/// g_mg/I_D in saturation by the equations of appendix A if the printed V_T is taken as V_T0.
double g_by_I_with_published_threshold(const PublishedArray& p) {
    const double v_t = circuit::thermal_voltage(300.15), n = 1 + p.bulk_ratio;
    const double q = circuit::inversion_charge((half_volt - 1e-3 * p.V_T) / (n * v_t) + 1);
    return 2 / (n * v_t * (q + 2));
}

std::string early_voltage_reason(const SimulatedArray&) {
    return "V_A = V_E L with a single V_E, fitted to the seven arrays of the shortest unit transistor, is simpler than the foundry's model";
}

/// V_T has no verdict: the printed one is another quantity than the equations' V_T0.
std::string threshold_note(const SimulatedArray& a, const PublishedArrays& all) {
    return fmt::format(
        "{} prints {:.1f} mV, by another definition of the threshold. Used as V_T0 in the equations of appendix A it would give g_mg/I_D = "
        "{:.1f} 1/V, but {:.2f} 1/V is printed",
        all.small_signal_table, a.published->V_T, g_by_I_with_published_threshold(*a.published), a.published->g_by_I);
}

}  // namespace

const PublishedArray& find_published(const PublishedArrays& all, std::string_view name) {
    return *std::find_if(all.arrays.begin(), all.arrays.end(), [&](const auto& a) { return a.name == name; });
}

const SimulatedArray& SimulatedArrays::operator()(std::string_view name) const {
    return *std::find_if(begin(), end(), [&](const auto& a) { return a.published->name == name; });
}

std::vector<ArrayMatch> all_matches(const PublishedArrays& all) {
    std::vector<ArrayMatch> out;
    for (const auto& a : all.arrays) out.push_back({&a, a.subcircuit});
    return out;
}

double SimulatedArray::gain() const { return 20 * std::log10(g_mg / g_md); }

double SimulatedArray::predicted_mismatch(double with_g_by_I) const { return 100 * std::hypot(A_VT * with_g_by_I, A_IS) / std::sqrt(A); }

double mismatch_uncertainty() { return 100 / std::sqrt(2.0 * chips); }

Result<SimulatedArrays> simulate_arrays(const PublishedArrays& all) { return simulate_arrays(all.circuit, all_matches(all)); }

Result<SimulatedArrays> simulate_arrays(const char* circuit, std::span<const ArrayMatch> matches) {
    std::string directives = ".op\n";
    for (const auto& match : matches) directives += slope_directives(match.subcircuit);
    const auto found = TRY(run_study_netlist({circuit, {}, directives}));
    SimulatedArrays out;
    for (const auto& [published, array] : matches) {
        const auto g = [&](char terminal, const char* by) { return found.derivative(fmt::format("i({}.v{})", array, terminal), by); };
        SimulatedArray a{.published = published, .g_md = g('d', "vi"), .g_mg = g('g', "vi"), .g_mb = g('b', "vi")};
        a.g_ms = g('b', "vh") + a.g_mb;  // raising gate, drain and bulk together is the same as lowering the source
        a.I_D = found.operating_point(fmt::format("i({}.vg)", array));
        // F's two transistors have different thresholds; mg2 is the one at the source. An array of one transistor has only mg1.
        a.V_T = found.operating_info(array + ".mg2", "v_t");
        if (std::isnan(a.V_T)) a.V_T = found.operating_info(array + ".mg1", "v_t");
        measure_size(a, *found.circuit, array);
        out.push_back(a);
    }
    return out;
}

Result<std::vector<double>> simulate_mismatch(const char* circuit, std::span<const ArrayMatch> matches) {
    const auto found = TRY(run_study_variants({circuit, {}, fmt::format(".op\n.mc {} process=0", chips)}));
    std::vector<double> out;
    for (const auto& match : matches) out.push_back(sample_statistics(found, fmt::format("i({}.vg)", match.subcircuit)).cv_percent());
    return out;
}

Result<std::vector<double>> simulate_mismatch(const PublishedArrays& all) { return simulate_mismatch(all.circuit, all_matches(all)); }

void add_column(StudyResult& out, const TableColumn& column, const SimulatedArrays& ours, const std::string& source) {
    for (const auto& a : ours) {
        auto& c = out.claim(fmt::format("{}: {}", a.published->name, column.quantity), column.computed(a), column.unit);
        c.published_as(column.factor * a.published->*column.published,
                       *column.source_note == 0 ? source : source + ", " + column.source_note);
        if (c.needs_explanation() && column.reason != nullptr) c.explain(column.reason(a));
    }
}

void add_sizes(StudyResult& out, const PublishedArrays& all, const SimulatedArrays& ours) {
    using P = PublishedArray;
    const TableColumn columns[] = {
        {"S_eq", "", [](const SimulatedArray& a) { return a.S; }, &P::S},
        {"A", "um^2", [](const SimulatedArray& a) { return a.A / um2; }, &P::A},
        {"A_T", "um^2", [](const SimulatedArray& a) { return a.A_T / um2; }, &P::A_T},
        {"A/A_T", "", [](const SimulatedArray& a) { return a.A / a.A_T; }, &P::area_ratio},
    };
    for (const auto& column : columns) add_column(out, column, ours, all.sizes_table);
}

void add_small_signals(StudyResult& out, const PublishedArrays& all, const SimulatedArrays& ours) {
    using P = PublishedArray;
    const TableColumn columns[] = {
        {"g_md", "S", [](const SimulatedArray& a) { return a.g_md; }, &P::g_md, all.g_md_unit, early_voltage_reason, all.g_md_note},
        {"g_mg", "S", [](const SimulatedArray& a) { return a.g_mg; }, &P::g_mg, 1e-6},
        {"g_ms", "S", [](const SimulatedArray& a) { return a.g_ms; }, &P::g_ms, 1e-6},
        {"g_mb", "S", [](const SimulatedArray& a) { return a.g_mb; }, &P::g_mb, 1e-6},
        {"I_D", "A", [](const SimulatedArray& a) { return a.I_D; }, &P::I_D, 1e-6},
    };
    for (const auto& column : columns) add_column(out, column, ours, all.small_signal_table);
    for (const auto& a : ours) out.claim(fmt::format("{}: V_T", a.published->name), a.V_T, "V").explain(threshold_note(a, all));
}

void add_ratios(StudyResult& out, const PublishedArrays& all, const SimulatedArrays& ours) {
    using P = PublishedArray;
    const TableColumn columns[] = {
        {"g_mg/I_D", "1/V", [](const SimulatedArray& a) { return a.g_by_I(); }, &P::g_by_I},
        {"I_D/g_md", "V", [](const SimulatedArray& a) { return a.V_A(); }, &P::V_A, 1, early_voltage_reason},
        {"g_mg/g_md", "dB", [](const SimulatedArray& a) { return a.gain(); }, &P::gain},
        {"g_mb/g_mg",
         "",
         [](const SimulatedArray& a) { return a.bulk_ratio(); },
         &P::bulk_ratio,
         1,
         {},
         "the column g_mg/g_mb is inverted: errata U5"},
        {"g_mg/A", "S/um^2", [](const SimulatedArray& a) { return a.g_by_A(); }, &P::g_by_A, all.g_by_A_unit, {}, all.g_by_A_note},
    };
    for (const auto& column : columns) add_column(out, column, ours, all.ratios_table);
}

namespace {

std::string mismatch_reason(const SimulatedArray& a) {
    const std::string name = a.published->name;
    if (name == "G3")
        return "in the equations the unit transistor at the source is not fully saturated (i_r is one eighth of i_f), so the seven above "
               "it contribute to the mismatch";
    if (name == "F")
        return "the short transistor at the drain has a large mismatch and contributes to the total; at the source it contributes "
               "less";
    return fmt::format(
        "one A_VT is used for all arrays. For a single transistor of this area the model card's A_VT and A_IS give {:.2f} % with the "
        "published g_mg/I_D and {:.2f} % with the simulated one. The statistical uncertainty of a standard deviation is {:.1f} % here, 2.2 "
        "% with 1000 chips",
        a.predicted_mismatch(a.published->g_by_I), a.predicted_mismatch(a.g_by_I()), mismatch_uncertainty());
}

}  // namespace

void add_mismatch(StudyResult& out, const PublishedArrays& all, const SimulatedArrays& ours, const std::vector<double>& sigmas) {
    for (std::size_t k = 0; k < sigmas.size(); ++k) {
        auto& c = out.claim(fmt::format("{}: standard deviation of I_D over its mean", ours[k].published->name), sigmas[k], "%");
        c.published_as(ours[k].published->sigma, all.ratios_table);
        if (c.needs_explanation()) c.explain(mismatch_reason(ours[k]));
    }
}

namespace {

/// How much the printed numbers violate g_mg + g_md + g_mb = g_ms, as a fraction of g_ms, if the column g_md is in g_md_unit (S).
double sum_residual(const PublishedArray& a, double g_md_unit) {
    return std::abs(1e-6 * (a.g_mg + a.g_mb - a.g_ms) + g_md_unit * a.g_md) / (1e-6 * a.g_ms);
}

/// Relative difference of I_D/g_md from the printed column V_A, if the column g_md is in g_md_unit (S).
double ratio_residual(const PublishedArray& a, double g_md_unit) { return std::abs(1e-6 * a.I_D / (g_md_unit * a.g_md * a.V_A) - 1); }

void add_rule(StudyResult& out, const PublishedArrays& all, double printed_unit, const std::string& erratum, const std::string& statement,
              double (*residual)(const PublishedArray&, double)) {
    double with_corrected = 0, with_printed = 0;  // largest residuals with either unit of g_md
    bool all_closer = true;
    for (const auto& a : all.arrays) {
        with_corrected = std::max(with_corrected, residual(a, all.g_md_unit)),
        with_printed = std::max(with_printed, residual(a, printed_unit));
        all_closer = all_closer && residual(a, all.g_md_unit) < residual(a, printed_unit);
    }
    auto& c = out.claim_true(
        fmt::format("Published numbers only: {} by up to {:.2g} % with the corrected unit of g_md, and by up to {:.2g} % with the unit "
                    "in the table's head. The difference is smaller with the corrected unit in every row",
                    statement, 100 * with_corrected, 100 * with_printed),
        all_closer, erratum);
    c.of_kind(ClaimKind::arithmetic);
}

}  // namespace

void add_sum_rule(StudyResult& out, const PublishedArrays& all, double printed_unit, const std::string& erratum) {
    add_rule(out, all, printed_unit, erratum, "g_mg + g_md + g_mb differs from g_ms", sum_residual);
}

void add_ratio_rule(StudyResult& out, const PublishedArrays& all, double printed_unit, const std::string& erratum) {
    add_rule(out, all, printed_unit, erratum, "I_D/g_md differs from its printed column", ratio_residual);
}

}  // namespace corpuscle
