#pragma once
// Runs a netlist given as text or file, and returns its numbers and curves.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "circuit/output/curve_view.hpp"
#include "circuit/run_directives.hpp"
#include "circuit/variant/netlist_variants.hpp"
#include "support/test_paths.hpp"

namespace corpuscle::circuit {

/// The results of a netlist. A request for a curve or number that the netlist does not have fails the test and returns NaN.
class NetlistRun {
    std::shared_ptr<const Circuit> circuit_;  // outcome_ points to its directives
    RunOutcome outcome_;

public:
    NetlistRun() = default;
    NetlistRun(std::shared_ptr<const Circuit> circuit, RunOutcome outcome) : circuit_(std::move(circuit)), outcome_(std::move(outcome)) {}

    /// False if the netlist could not be read or run.
    bool is_complete() const { return circuit_ != nullptr; }
    std::string title() const { return circuit_ ? circuit_->title : ""; }
    const std::vector<Expectation>& expectations() const { return outcome_.expectations; }
    const std::vector<std::pair<std::string, double>>& numbers() const { return outcome_.numbers; }
    const std::vector<Error>& warnings() const { return outcome_.warnings; }
    const std::vector<AnalysisRun>& analyses() const { return outcome_.analyses; }

    /// A curve from the first plot that contains it; if `analysis` is given ("ac"), from the plots of this analysis only. `name` is as in
    /// .print: v(a), v(a,b), vdb(a), i(v1).
    std::vector<std::complex<double>> complex_curve(const std::string& name, const std::string& analysis = "") const {
        for (const auto& a : outcome_.analyses)
            if (analysis.empty() || a.directive->name == analysis)
                for (const auto& plot : a.result.plots)
                    if (auto values = find_curve_values(plot, name)) return *values;
        ADD_FAILURE() << title() << ": no curve " << name;
        return {std::complex<double>(std::nan(""), 0)};
    }
    /// The real part of a curve.
    std::vector<double> curve(const std::string& name, const std::string& analysis = "") const {
        std::vector<double> out;
        for (const auto& value : complex_curve(name, analysis)) out.push_back(value.real());
        return out;
    }
    /// The value of a .meas or another number of an analysis; if none has this name, the last value of the curve of this name.
    double number(const std::string& name) const {
        for (const auto& [known, value] : outcome_.numbers)
            if (known == name) return value;
        return curve(name).back();
    }
};

inline Result<std::string> read_text_file(const std::string& path) {
    std::ifstream file(path);
    if (!file) return bad_input(path + " cannot be opened");
    return std::string(std::istreambuf_iterator<char>(file), {});
}

/// Parses a netlist as if it were a file in process/, where the process cards are.
inline Result<Netlist> parse_netlist_text(const std::string& text) {
    return Netlist::parse(text, corpuscle::test::source_root() + "/process/test.cir", read_text_file);
}

/// The circuit of a netlist's text; an error fails the test and returns null.
inline std::shared_ptr<const Circuit> make_circuit(const std::string& text) {
    const auto netlist = parse_netlist_text(text);
    if (!netlist) return ADD_FAILURE() << netlist.error().text(), nullptr;
    auto circuit = netlist->elaborate();
    if (!circuit) return ADD_FAILURE() << circuit.error().text(), nullptr;
    return std::make_shared<const Circuit>(std::move(*circuit));
}

inline NetlistRun run_netlist(Circuit circuit) {
    const auto shared = std::make_shared<const Circuit>(std::move(circuit));
    auto outcome = run_directives(shared);
    if (!outcome) return ADD_FAILURE() << outcome.error().text() << "\n" << shared->title, NetlistRun();
    return {shared, std::move(*outcome)};
}

/// Runs a netlist's text, which begins with its title. Its .lib and .include paths are relative to process/, where the process cards are.
/// `parameters` override its .param.
inline NetlistRun run_netlist(const std::string& text, const Values& parameters = {}) {
    const auto netlist = parse_netlist_text(text);
    if (!netlist) return ADD_FAILURE() << netlist.error().text() << "\n" << text, NetlistRun();
    auto circuit = netlist->elaborate(parameters);
    if (!circuit) return ADD_FAILURE() << circuit.error().text() << "\n" << text, NetlistRun();
    return run_netlist(std::move(*circuit));
}

/// Runs every variant of a netlist that has .step or .mc. An error fails the test and ends the list.
inline std::vector<NetlistRun> run_variants(const std::string& text) {
    std::vector<NetlistRun> out;
    const auto netlist = parse_netlist_text(text);
    if (!netlist) return ADD_FAILURE() << netlist.error().text() << "\n" << text, out;
    auto variants = NetlistVariants::create(*netlist);
    if (!variants) return ADD_FAILURE() << variants.error().text() << "\n" << text, out;
    std::unique_ptr<AnalysisContext> context;
    for (std::size_t k = 0; k < variants->count(); ++k) {
        auto variant = variants->at(k);
        if (!variant) return ADD_FAILURE() << variant.error().text() << "\n" << text, out;
        if (!context || context->circuit != variant->circuit) {
            auto made = AnalysisContext::make(variant->circuit);
            if (!made) return ADD_FAILURE() << made.error().text() << "\n" << text, out;
            context = std::move(*made);
        }
        if (variant->sample) context->apply_variation(*variant->sample);
        auto outcome = run_directives(*context);
        if (!outcome) return ADD_FAILURE() << outcome.error().text() << "\n" << text, out;
        out.emplace_back(variant->circuit, std::move(*outcome));
    }
    return out;
}

/// Runs a netlist of circuits/. `parameters` override its .param.
inline NetlistRun run_netlist_file(const std::string& name, const Values& parameters = {}) {
    const auto netlist = Netlist::read(corpuscle::test::source_root() + "/circuits/" + name);
    if (!netlist) return ADD_FAILURE() << netlist.error().text(), NetlistRun();
    auto circuit = netlist->elaborate(parameters);
    if (!circuit) return ADD_FAILURE() << circuit.error().text(), NetlistRun();
    return run_netlist(std::move(*circuit));
}

}  // namespace corpuscle::circuit
