#pragma once
// Runs a netlist's transient with different plans, always from the same initial condition, and with IDA of SUNDIALS as reference.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "circuit/analyses.hpp"
#include "circuit/analysis/analysis_context.hpp"
#include "circuit/analysis/transient_setup.hpp"
#include "circuit/ida_integrator.hpp"
#include "circuit/netlist_runner.hpp"
#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

/// All points of a transient run.
struct TransientPoints {
    std::vector<double> t;               ///< s
    std::vector<std::vector<double>> x;  ///< all unknowns at each time
    TransientStats stats;
    std::string error;  ///< why the run ended early; empty if it reached the end

    /// The curve of one unknown, by index.
    std::vector<double> values(int unknown) const {
        std::vector<double> out;
        for (const auto& at : x) out.push_back(at[static_cast<std::size_t>(unknown)]);
        return out;
    }
};

/// Times (s) at which the curve v(t) crosses a level upward. It is interpolated by the cubic through the two points before and the two
/// after the crossing; linearly where one of them is missing.
inline std::vector<double> upward_crossings(const std::vector<double>& t, const std::vector<double>& v, double level) {
    std::vector<double> out;
    for (std::size_t k = 1; k < t.size(); ++k) {
        if (!(v[k - 1] < level && v[k] >= level)) continue;
        const bool cubic = k >= 2 && k + 1 < t.size();
        const auto at = [&](double s) {
            if (!cubic) return v[k - 1] + (v[k] - v[k - 1]) * (s - t[k - 1]) / (t[k] - t[k - 1]);
            double sum = 0;
            for (std::size_t i = k - 2; i < k + 2; ++i) {
                double term = v[i];
                for (std::size_t j = k - 2; j < k + 2; ++j)
                    if (j != i) term *= (s - t[j]) / (t[i] - t[j]);
                sum += term;
            }
            return sum;
        };
        double low = t[k - 1], high = t[k];
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = (low + high) / 2;
            (at(middle) < level ? low : high) = middle;
        }
        out.push_back(high);
    }
    return out;
}

/// A netlist with its initial condition, which several runs share.
class TransientRunner {
    std::unique_ptr<AnalysisContext> context_;
    std::vector<double> start_;   // initial condition: all unknowns at t = 0
    bool is_settled_ = true;      // InitialCondition::is_consistent
    double step_ = 0, stop_ = 0;  // of .tran, s

public:
    /// Takes the duration and the initial condition from the netlist's .tran, which must be there; elaboration has checked its numbers.
    explicit TransientRunner(Result<Netlist> netlist) {
        if (!netlist) throw std::runtime_error(netlist.error().text());
        auto circuit = netlist->elaborate({});
        if (!circuit) throw std::runtime_error(circuit.error().text());
        auto context = AnalysisContext::make(std::make_shared<const Circuit>(std::move(*circuit)));
        if (!context) throw std::runtime_error(context.error().text());
        context_ = std::move(*context);
        bool uic = false;
        for (const auto& c : context_->circuit->directives)
            if (c.name == "tran") step_ = *read_number(c, 0, "step"), stop_ = *read_number(c, 1, "stop"), uic = c.words.back() == "uic";
        // A source can need the step and end of the analysis also at t = 0. Zeros end the transient for the sources.
        system().start_transient(step_, stop_);
        const auto initial = find_initial_condition(*context_, uic);
        system().start_transient(0, 0);
        if (!initial) throw std::runtime_error(initial.error().text());
        start_ = initial->x, is_settled_ = initial->is_consistent;
    }
    static TransientRunner from_file(const std::string& path) { return TransientRunner(Netlist::read(path)); }
    /// Reads a file and replaces each line that begins with the first text of a pair by the second text. Omits .meas and .expect.
    static TransientRunner from_file(const std::string& path, const std::vector<std::pair<std::string, std::string>>& changed) {
        const auto all = read_text_file(path);
        std::istringstream in(all ? *all : "");
        std::string text;
        for (std::string line; std::getline(in, line);) {
            for (const auto& [prefix, replacement] : changed)
                if (line.starts_with(prefix)) line = replacement;
            if (!line.starts_with(".meas") && !line.starts_with(".expect")) text += line + "\n";
        }
        return TransientRunner(Netlist::parse(text, path, read_text_file));
    }
    static TransientRunner from_text(const std::string& text) { return TransientRunner(parse_netlist_text(text)); }

    System& system() const { return context_->system; }
    double stop_time() const { return stop_; }
    void set_stop_time(double t) { stop_ = t; }
    /// The index of the unknown of this name.
    int unknown(const std::string& name) const { return system().unknown(name); }

    /// Runs the transient with the end that is set here. Without a maximum step, a fiftieth of the duration is used.
    TransientPoints run(TransientPlan plan) const {
        plan.stop = stop_;
        if (plan.max_step == 0) plan.max_step = stop_ / 50;
        system().start_transient(step_, stop_);
        Transient transient(context_->system, context_->newton, plan);
        TransientPoints out;
        const auto done = transient.run(start_, is_settled_, [&](double t, std::span<const double> x) {
            out.t.push_back(t), out.x.emplace_back(x.begin(), x.end());
            return true;
        });
        system().start_transient(0, 0);
        if (!done) out.error = done.error().text();
        out.stats = transient.stats();
        return out;
    }
    /// The value of a curve of the netlist's .ac at its first frequency; NaN if the netlist has no .ac or the .ac has no such curve.
    std::complex<double> first_ac_value(const std::string& name) const {
        for (const auto& c : context_->circuit->directives)
            if (c.name == "ac")
                if (const auto found = ac_analysis.run(*context_, c))
                    if (const auto* curve = found->plots[0].find_curve(name)) return curve->values[0];
        return std::nan("");
    }
    IdaResult run_ida(IdaOptions options) const {
        options.step = step_, options.stop = stop_;
        return integrate_with_ida(context_->system, context_->newton.context.gmin, start_, options);
    }
    /// Times (s) at which a node's voltage crosses `level` (V) upward.
    std::vector<double> spike_times(const TransientPoints& p, const std::string& name, double level) const {
        return upward_crossings(p.t, p.values(unknown(name)), level);
    }
};

}  // namespace corpuscle::circuit
