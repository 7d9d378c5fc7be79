#include "circuit/analysis/transient_plan.hpp"

#include <fmt/format.h>

#include "circuit/device/named_values.hpp"

namespace corpuscle::circuit {
namespace {

struct Accuracy {
    std::string_view word;  // of .options accuracy=word
    double reltol, vntol;   // vntol: V
};
constexpr Accuracy accuracies[] = {{"rough", 1e-3, 1e-5}, {"normal", 1e-5, 1e-6}, {"fine", 1e-6, 1e-7}, {"finest", 1e-8, 1e-9}};

Error invalid_option(const Circuit& c, std::string_view option, std::string_view value, std::string_view known) {
    return bad_input(fmt::format(".options {}={}: expected one of {}", option, value, known), SourceLocation{c.file});
}

}  // namespace

Result<TransientPlan> read_transient_plan(const Circuit& c) {
    TransientPlan plan;
    if (const auto given = c.option_words.find("accuracy"); given != c.option_words.end()) {
        const Accuracy* found = nullptr;
        for (const auto& a : accuracies)
            if (a.word == given->second) found = &a;
        if (found == nullptr) return invalid_option(c, "accuracy", given->second, "rough, normal, fine, finest");
        plan.reltol = found->reltol, plan.vntol = found->vntol;
    }
    plan.reltol = value_or(c.options, "reltol", plan.reltol);
    plan.vntol = value_or(c.options, "vntol", plan.vntol);
    plan.abstol = value_or(c.options, "abstol", plan.abstol);
    if (const auto given = c.option_words.find("method"); given != c.option_words.end()) {
        const std::string_view word = given->second;
        if (word != "gear" && word != "bdf" && !word.starts_with("trap")) return invalid_option(c, "method", word, "gear, trap");
        if (word.starts_with("trap")) plan.method = Integration::trapezoidal;
    }
    const double order = value_or(c.options, "maxord", plan.max_order);
    if (!(order >= 1 && order <= 5 && order == static_cast<int>(order)))
        return bad_input(fmt::format(".options maxord={:g}: expected an integer from 1 to 5", order), SourceLocation{c.file});
    plan.max_order = static_cast<int>(order);
    return plan;
}

Result<TransientTimes> read_transient_times(const Directive& directive) {
    auto c = directive;
    TransientTimes out;
    out.uic = !c.words.empty() && c.words.back() == "uic";
    if (out.uic) c.words.pop_back();
    if (c.words.size() < 2 || c.words.size() > 4) return bad_input(".tran: expected .tran STEP STOP [START [LONGEST]] [uic]", c.location);
    out.step = TRY(read_number(c, 0, "the step"));
    out.stop = TRY(read_number(c, 1, "the stop time"));
    if (c.words.size() > 2) out.start = TRY(read_number(c, 2, "the start time"));
    if (c.words.size() > 3) out.max_step = TRY(read_number(c, 3, "the maximum step"));
    if (!(out.step > 0 && out.stop > 0 && out.start >= 0 && out.start < out.stop && out.max_step.value_or(1) > 0))
        return bad_input(fmt::format(".tran: step {:g}, stop {:g}, start {:g}{} s: step, stop and maximum step must be above 0, the start "
                                     "at least 0 and below the stop",
                                     out.step, out.stop, out.start, out.max_step ? fmt::format(", maximum step {:g}", *out.max_step) : ""),
                         c.location);
    return out;
}

}  // namespace corpuscle::circuit
