#pragma once
// The plots of a script of ngspice, to which its prints and measures refer. Used inside circuit/netlist only.

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace corpuscle::circuit {

/// The analyses of a script so far, and the plot that is the current one. An analysis is an index in ControlScript::commands.
class ScriptPlots {
    static constexpr int left_out = -2;
    std::map<std::string, std::vector<int>, std::less<>> analyses_;  // by kind, in the order of their plots
    std::string kind_;                                               // of the current plot; "": any
    int analysis_ = any_analysis;
    std::string problem_;          // the reason why the curves of the current plot are not available; "" if they are
    std::string measure_problem_;  // the same for measures of any kind
    bool has_run_ = false;

public:
    static constexpr int any_analysis = -1;

    /// The kind of the current plot, such as "tran"; "" after `run`.
    const std::string& kind() const { return kind_; }
    int analysis() const { return analysis_; }
    const std::string& problem() const { return problem_; }
    /// The last analysis of a kind, and the reason why its curves cannot be measured; "" if they can.
    int last(std::string_view kind) const;
    std::string measure_problem(std::string_view kind) const;

    /// Each of these makes another plot the current one.
    void add(const std::string& kind, int analysis);
    void leave_out(const std::string& kind);
    void run();
    void lose(const std::string& reason);
    /// Selects the plot that ngspice calls `name`, "tran1". Without success the plot is lost.
    void select(const std::string& name);
};

}  // namespace corpuscle::circuit
