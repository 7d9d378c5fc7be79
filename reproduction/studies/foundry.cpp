// The circuits of the thesis in ngspice with the transistors of a kit that the user names, beside the published numbers and
// those of the UICM card.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/arrays.hpp"
#include "reproduction/thesis/ngspice_run.hpp"

namespace corpuscle::studies::foundry {

/// A measure of a circuit, beside the thesis's number.
struct Quantity {
    const char *label, *circuit, *measure, *unit;
    double published;
    const char* source;
};

constexpr Quantity quantities[] = {
    {"INVA without bias: V_Q", "quiescent", "v_q", "V", 355.1e-3, "table 18"},
    {"INVA without bias: I_Q", "quiescent", "i_q", "A", 17.5e-9, "table 18"},
    {"INVA biased at 200 nA: V_Q", "inverter_biased", "v_q", "V", 350.1e-3, "table 17"},
    {"INVA biased at 200 nA: I_Q", "inverter_biased", "i_q", "A", 199.6e-9, "table 17"},
    {"INVB: transconductance", "invb", "g_m", "S", -2.5e-6, "thesis E.4"},
    {"INVB: largest resistance", "invb", "r", "ohm", 413e3, "fig. 28b"},
    {"INVC: transconductance", "invc", "g_m", "S", -146e-12, "fig. 60b"},
    {"INVC: resistance as a load", "invc", "r", "ohm", 6.6e9, "thesis E.4"},
    {"INVC: V_Q", "invc", "v_q", "V", 347e-3, "fig. 61"},
    {"INVB's transconductance over INVC's", "invc", "attenuation", "", 16000, "thesis E.4"},
};

/// Measures of circuits, each run once.
class Measures {
    const circuit::Kit& kit_;
    std::map<std::string, std::map<std::string, double>> kit_numbers_;
    std::map<std::string, NetlistResult> own_;

public:
    explicit Measures(const circuit::Kit& kit) : kit_(kit) {}

    Result<void> run(const std::string& circuit) {
        if (own_.contains(circuit)) return {};
        kit_numbers_[circuit] = TRY(measure_in_ngspice(circuit, kit_));
        own_.emplace(circuit, TRY(run_study_netlist({.circuit = circuit})));
        return {};
    }
    double of_kit(const std::string& circuit, const std::string& name) const {
        const auto& numbers = kit_numbers_.at(circuit);
        const auto at = numbers.find(name);
        return at == numbers.end() ? std::nan("") : at->second;
    }
    double of_card(const std::string& circuit, const std::string& name) const { return own_.at(circuit).number(name); }
};

void add(StudyResult& out, const Measures& measures, const Quantity& q) {
    out.claim(fmt::format("{}, kit", q.label), measures.of_kit(q.circuit, q.measure), q.unit)
        .published_as(q.published, q.source)
        .explain_if_needed("the kit's");
    out.claim(fmt::format("{}, UICM", q.label), measures.of_card(q.circuit, q.measure), q.unit)
        .published_as(q.published, q.source)
        .explain_if_needed("the card's; see the study of this figure or table");
}

/// I_D / g_md of each array, over the published one.
void add_arrays(StudyResult& out, const Measures& measures, const PublishedArrays& published) {
    for (const auto& array : published.arrays) {
        const auto measure = fmt::format("early_{}", std::string_view(array.subcircuit).substr(1));
        for (const bool is_kit : {true, false}) {
            const double V_A = is_kit ? measures.of_kit(published.circuit, measure) : measures.of_card(published.circuit, measure);
            out.claim(fmt::format("{}: V_A, {}", array.name, is_kit ? "kit" : "UICM"), V_A, "V")
                .published_as(array.V_A, published.ratios_table)
                .explain_if_needed("length modulation and drain-induced barrier lowering of the model");
        }
    }
}

Result<StudyResult> compute(const StudyOptions& options) {
    if (options.kit.card.empty())
        return bad_input(
            "left out: no kit is named; set CORPUSCLE_FOUNDRY_CARD to its file, and CORPUSCLE_FOUNDRY_NCH and CORPUSCLE_FOUNDRY_PCH to its "
            "devices, or CORPUSCLE_FOUNDRY_MAP to a map that has them");
    const auto kit = TRY(read_kit(options.kit, ""));
    Measures measures(kit);
    std::vector<std::string> circuits = {rectangles.circuit, trapezoids.circuit};
    for (const auto& q : quantities) circuits.push_back(q.circuit);
    for (std::size_t k = 0; k < circuits.size(); ++k) {
        TRY(measures.run(circuits[k]));
        TRY(options.report_progress(static_cast<double>(k + 1) / static_cast<double>(circuits.size())));
    }
    StudyResult out;
    for (const auto& q : quantities) add(out, measures, q);
    for (const auto* published : {&rectangles, &trapezoids}) add_arrays(out, measures, *published);
    out.note(
        "Each unit of an array is a transistor of the kit; columns are its multiplier. A device of higher threshold that the kit does not "
        "have is its standard one with the threshold shifted by 0.15 V. Thresholds are the kit's, not fitted to the thesis.");
    return out;
}

const Study study{
    "foundry", "The thesis's circuits with a foundry's transistors",
    "Which deviations of the UICM card are the card's? The same netlists in ngspice with the kit that CORPUSCLE_FOUNDRY_CARD names",
    ClaimKind::predicted, compute};

}  // namespace corpuscle::studies::foundry
