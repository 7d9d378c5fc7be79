#include "circuit/netlist/script/script_plots.hpp"

#include <fmt/format.h>

#include "circuit/analyses.hpp"

namespace corpuscle::circuit {
namespace {

/// The number at the end of "tran2"; 0 if there is none.
std::size_t number_of_plot(std::string_view digits) {
    std::size_t out = 0;
    for (const char c : digits) {
        if (c < '0' || c > '9' || out > 1000000) return 0;
        out = 10 * out + static_cast<std::size_t>(c - '0');
    }
    return out;
}

}  // namespace

int ScriptPlots::last(std::string_view kind) const {
    const auto at = analyses_.find(kind);
    return at == analyses_.end() || at->second.back() == left_out ? any_analysis : at->second.back();
}

std::string ScriptPlots::measure_problem(std::string_view kind) const {
    const auto at = analyses_.find(kind);
    if (at != analyses_.end() && at->second.back() == left_out) return fmt::format("the {} before it is left out", kind);
    return measure_problem_;
}

void ScriptPlots::add(const std::string& kind, int analysis) {
    analyses_[kind].push_back(analysis);
    kind_ = kind, analysis_ = analysis, problem_.clear(), measure_problem_.clear();
}

void ScriptPlots::leave_out(const std::string& kind) {
    analyses_[kind].push_back(left_out);
    lose(fmt::format("'{}' is left out", kind));
    measure_problem_.clear();
}

void ScriptPlots::run() {
    has_run_ = true;
    kind_.clear(), analysis_ = any_analysis, problem_.clear(), measure_problem_.clear();
}

void ScriptPlots::lose(const std::string& reason) {
    problem_ = measure_problem_ = "the curves of the current plot are not available, since " + reason;
}

void ScriptPlots::select(const std::string& name) {
    const auto digits = std::min(name.find_first_of("0123456789"), name.size());
    const auto kind = name.substr(0, digits);
    auto number = number_of_plot(std::string_view(name).substr(digits));
    if (kind == "noise") number = (number + 1) / 2;  // each has two plots
    const auto at = analyses_.find(kind);
    const auto count = at == analyses_.end() ? 0 : at->second.size();
    // The directives of the netlist, which `run` runs, are not known here.
    const bool is_of_run = has_run_ && count == 0 && number == 1 && find_analysis(kind) != nullptr;
    const bool is_of_script = !has_run_ && number >= 1 && number <= count;
    if (is_of_script && at->second[number - 1] == left_out) return lose(fmt::format("'{}' is left out", kind));
    if (!is_of_run && !is_of_script) return lose(fmt::format("setplot {} does not name an analysis of this script", name));
    kind_ = kind, analysis_ = is_of_script ? at->second[number - 1] : any_analysis, problem_.clear(), measure_problem_.clear();
}

}  // namespace corpuscle::circuit
