#pragma once
// A netlist for runs in time under several plans, all from the same start, and the same once more by IDA.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "circuit/analyses.hpp"
#include "circuit/analysis/initial_condition.hpp"
#include "circuit/analysis/analysis_context.hpp"
#include "circuit/ida_integrator.hpp"
#include "circuit/netlist_runner.hpp"
#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

/// What a run left: all points.
struct TransientPoints {
    std::vector<double> t;
    std::vector<std::vector<double>> x;
    TransientStats stats;
    std::string error;  ///< why it ended early; empty: it did not

    std::vector<double> values(int unknown) const {
        std::vector<double> out;
        for (const auto& at : x) out.push_back(at[static_cast<std::size_t>(unknown)]);
        return out;
    }
};

/// Where the cubic through four points crosses a level upward; near the ends of the points a straight line.
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

class TransientRunner {
    std::unique_ptr<AnalysisContext> context_;
    std::vector<double> start_;
    bool is_settled_ = true;
    double step_ = 0, stop_ = 0;

public:
    /// Its .tran says how long; it begins where .tran begins.
    explicit TransientRunner(Result<Netlist> netlist) {
        if (!netlist) throw std::runtime_error(netlist.error().text());
        auto circuit = netlist->elaborate({});
        if (!circuit) throw std::runtime_error(circuit.error().text());
        auto made = AnalysisContext::make(std::make_shared<const Circuit>(std::move(*circuit)));
        if (!made) throw std::runtime_error(made.error().text());
        context_ = std::move(*made);
        bool uic = false;
        for (const auto& c : context_->circuit->directives)
            if (c.name == "tran") step_ = *read_number(c, 0, "step"), stop_ = *read_number(c, 1, "stop"), uic = c.words.back() == "uic";
        system().start_transient(step_, stop_);
        const auto from = find_initial_condition(*context_, uic);
        system().start_transient(0, 0);
        if (!from) throw std::runtime_error(from.error().text());
        start_ = from->x, is_settled_ = from->is_consistent;
    }
    static TransientRunner from_file(const std::string& path) { return TransientRunner(Netlist::read(path)); }
    /// Lines that begin so read otherwise; .meas and .expect are left out.
    static TransientRunner from_file(const std::string& path, const std::vector<std::pair<std::string, std::string>>& changed) {
        const auto all = read_text_file(path);
        std::istringstream in(all ? *all : "");
        std::string text;
        for (std::string line; std::getline(in, line);) {
            for (const auto& [beginning, other] : changed)
                if (line.starts_with(beginning)) line = other;
            if (!line.starts_with(".meas") && !line.starts_with(".expect")) text += line + "\n";
        }
        return TransientRunner(Netlist::parse(text, path, read_text_file));
    }
    static TransientRunner from_text(const std::string& text) { return TransientRunner(parse_netlist_text(text)); }

    System& system() const { return context_->system; }
    double stop_time() const { return stop_; }
    void set_stop_time(double t) { stop_ = t; }
    int unknown(const std::string& name) const { return system().unknown(name); }

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
    /// What its .ac gives first.
    std::complex<double> first_ac_value(const std::string& name) const {
        for (const auto& c : context_->circuit->directives)
            if (c.name == "ac")
                if (const auto found = analyse_ac(*context_, c))
                    if (const auto* curve = found->plots[0].find_curve(name)) return curve->values[0];
        return std::nan("");
    }
    IdaResult run_ida(IdaOptions q) const {
        q.step = step_, q.stop = stop_;
        return integrate_with_ida(context_->system, context_->newton.context.gmin, start_, q);
    }
    std::vector<double> spike_times(const TransientPoints& p, const std::string& name, double level) const {
        return upward_crossings(p.t, p.values(unknown(name)), level);
    }
};

}  // namespace corpuscle::circuit
