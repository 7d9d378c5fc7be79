#pragma once
// All analyses, by directive name. To add one, declare its function here and add a line to `analyses`.

#include "circuit/analysis/analysis_context.hpp"

namespace corpuscle::circuit {

Result<AnalysisResult> analyse_op(AnalysisContext&, const Directive&);
Result<AnalysisResult> analyse_dc(AnalysisContext&, const Directive&);
Result<AnalysisResult> analyse_ac(AnalysisContext&, const Directive&);
Result<AnalysisResult> analyse_noise(AnalysisContext&, const Directive&);
Result<AnalysisResult> analyse_tran(AnalysisContext&, const Directive&);
Result<AnalysisResult> analyse_tf(AnalysisContext&, const Directive&);
Result<AnalysisResult> analyse_sens(AnalysisContext&, const Directive&);

/// An analysis: the name of its directive, its syntax, a description for help texts, and its function.
struct Analysis {
    std::string_view name, usage, description;
    Result<AnalysisResult> (*run)(AnalysisContext&, const Directive&);
};

inline constexpr Analysis analyses[] = {
    {"op", ".op [states [RISE]]", "the operating point, the state of every device, and other stable states", analyse_op},
    {"dc", ".dc SOURCE FROM TO STEP [SOURCE2 FROM TO STEP] [updown]", "operating points while a source, a resistor or temp is swept",
     analyse_dc},
    {"ac", ".ac dec|oct|lin POINTS FROM TO", "small-signal response over frequency", analyse_ac},
    {"noise", ".noise v(OUT[,REF]) SOURCE dec|oct|lin POINTS FROM TO", "noise at a node, with the contribution of each device",
     analyse_noise},
    {"tran", ".tran STEP STOP [START [LONGEST]] [uic]", "the circuit over time, with automatic step size", analyse_tran},
    {"tf", ".tf v(OUT[,REF])|i(V) SOURCE", "gain, input and output resistance at 0 Hz", analyse_tf},
    {"sens", ".sens v(OUT[,REF])|i(V)", "sensitivity of the output to each element's value", analyse_sens},
};

/// The analysis of this name; null if there is none.
inline const Analysis* find_analysis(std::string_view name) {
    for (const auto& a : analyses)
        if (a.name == name) return &a;
    return nullptr;
}

}  // namespace corpuscle::circuit
