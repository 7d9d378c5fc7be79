#pragma once
// Every analysis, by its word. To add one: its declaration, and its line.

#include "circuit/analysis/bench.hpp"

namespace corpuscle::circuit {

Result<Findings> analyse_op(TestBench&, const Command&);
Result<Findings> analyse_dc(TestBench&, const Command&);
Result<Findings> analyse_ac(TestBench&, const Command&);
Result<Findings> analyse_noise(TestBench&, const Command&);
Result<Findings> analyse_tran(TestBench&, const Command&);
Result<Findings> analyse_tf(TestBench&, const Command&);
Result<Findings> analyse_sens(TestBench&, const Command&);

struct Analysis {
    std::string_view word, usage, sentence;
    Result<Findings> (*run)(TestBench&, const Command&);
};

inline constexpr Analysis analyses[] = {
    {"op", ".op [states [RISE]]", "the operating point, every device at it, and in which states else it may rest", analyse_op},
    {"dc", ".dc SOURCE FROM TO STEP [SOURCE2 FROM TO STEP] [updown]", "operating points along a source, a resistor or temp", analyse_dc},
    {"ac", ".ac dec|oct|lin POINTS FROM TO", "small signals over frequency", analyse_ac},
    {"noise", ".noise v(OUT[,REF]) SOURCE dec|oct|lin POINTS FROM TO", "noise at a node, and each device's part in it", analyse_noise},
    {"tran", ".tran STEP STOP [START [LONGEST]] [uic]", "the circuit in time, in steps as long as accuracy allows", analyse_tran},
    {"tf", ".tf v(OUT[,REF])|i(V) SOURCE", "gain, resistance in and out at 0 Hz", analyse_tf},
    {"sens", ".sens v(OUT[,REF])|i(V)", "how the output changes with each element's value", analyse_sens},
};

inline const Analysis* analysis_of(std::string_view word) {
    for (const auto& a : analyses)
        if (a.word == word) return &a;
    return nullptr;
}

}  // namespace corpuscle::circuit
