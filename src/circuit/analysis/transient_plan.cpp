#include "circuit/analysis/transient_plan.hpp"

#include <fmt/format.h>

#include "circuit/device/values.hpp"

namespace corpuscle::circuit {
namespace {

struct Accuracy {
    std::string_view word;
    double reltol, vntol;
};
constexpr Accuracy accuracies[] = {{"rough", 1e-3, 1e-5}, {"normal", 1e-5, 1e-6}, {"fine", 1e-6, 1e-7}, {"finest", 1e-8, 1e-9}};

Error refused(const Circuit& c, std::string_view option, std::string_view word, std::string_view known) {
    return bad_input(fmt::format(".options {}={}: it is one of {}", option, word, known), Place{c.file});
}

}  // namespace

Result<TransientPlan> transient_plan(const Circuit& c) {
    TransientPlan plan;
    if (const auto said = c.option_words.find("accuracy"); said != c.option_words.end()) {
        const Accuracy* found = nullptr;
        for (const auto& a : accuracies)
            if (a.word == said->second) found = &a;
        if (found == nullptr) return refused(c, "accuracy", said->second, "rough, normal, fine, finest");
        plan.reltol = found->reltol, plan.vntol = found->vntol;
    }
    plan.reltol = value_or(c.options, "reltol", plan.reltol);
    plan.vntol = value_or(c.options, "vntol", plan.vntol);
    plan.abstol = value_or(c.options, "abstol", plan.abstol);
    if (const auto said = c.option_words.find("method"); said != c.option_words.end()) {
        const std::string_view word = said->second;
        if (word != "gear" && word != "bdf" && !word.starts_with("trap")) return refused(c, "method", word, "gear, trap");
        if (word.starts_with("trap")) plan.method = Integration::trapezoidal;
    }
    const double order = value_or(c.options, "maxord", plan.order);
    if (!(order >= 1 && order <= 5 && order == static_cast<int>(order)))
        return bad_input(fmt::format(".options maxord={:g}: a whole number from 1 to 5", order), Place{c.file});
    plan.order = static_cast<int>(order);
    return plan;
}

Result<TransientTimes> transient_times(const Command& given) {
    auto c = given;
    TransientTimes out;
    out.uic = !c.words.empty() && c.words.back() == "uic";
    if (out.uic) c.words.pop_back();
    if (c.words.size() < 2 || c.words.size() > 4) return bad_input(".tran: it is .tran STEP STOP [START [LONGEST]] [uic]", c.place);
    const auto step = number_of(c, 0, "a step"), stop = number_of(c, 1, "where it stops");
    const auto start = c.words.size() > 2 ? number_of(c, 2, "where it begins to be kept") : Result<double>(0.0);
    if (!step) return step.error();
    if (!stop) return stop.error();
    if (!start) return start.error();
    out.step = *step, out.stop = *stop, out.start = *start;
    if (c.words.size() > 3) {
        const auto longest = number_of(c, 3, "the longest step");
        if (!longest) return longest.error();
        out.longest = *longest;
    }
    if (!(*step > 0 && *stop > 0 && *start >= 0 && *start < *stop && out.longest.value_or(1) > 0))
        return bad_input(fmt::format(".tran: step {:g}, stop {:g}, start {:g}{} s; all above 0, the start from 0 and below the stop", *step,
                                     *stop, *start, out.longest ? fmt::format(", longest {:g}", *out.longest) : ""),
                         c.place);
    return out;
}

}  // namespace corpuscle::circuit
