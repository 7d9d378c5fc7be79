#include "model/equation_runner.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <stdexcept>

#include "circuit/expression/expression.hpp"
#include "run/export/equation_text.hpp"

namespace corpuscle::test {
namespace {

using circuit::Expression;

/// All quantities of the equations, each with a number. An expression is written for the evaluator of netlists, which ignores case: each
/// name becomes v(nK), K being its number.
class Quantities {
    std::map<std::string, std::size_t, std::less<>> numbers_;
    std::vector<std::string> texts_;

public:
    std::vector<double> values;

    std::size_t add(std::string_view name, double value = 0) {
        const auto [at, is_new] = numbers_.emplace(name, values.size());
        if (is_new) values.push_back(0);
        values[at->second] = value;
        return at->second;
    }
    std::size_t number(std::string_view name) const {
        const auto at = numbers_.find(name);
        if (at == numbers_.end()) throw std::runtime_error(fmt::format("the equations use '{}', which is not a quantity", name));
        return at->second;
    }
    double operator[](std::string_view name) const { return values[number(name)]; }
    double& operator[](std::string_view name) { return values[number(name)]; }

    /// A compiled expression.
    class Compiled {
        Expression expression_;
        std::vector<std::size_t> inputs_;

    public:
        Compiled(Expression e, std::vector<std::size_t> inputs) : expression_(std::move(e)), inputs_(std::move(inputs)) {}
        double operator()(const std::vector<double>& values) const {
            std::vector<double> in;
            for (const auto k : inputs_) in.push_back(values[k]);
            return expression_.value(in);
        }
    };
    Compiled compile(std::string_view text) {
        texts_.clear();
        texts_.reserve(numbers_.size());
        EquationDialect dialect;
        for (const auto& [name, number] : numbers_) {
            texts_.push_back(fmt::format("v(n{})", number));
            dialect.names.push_back({name, texts_.back()});
        }
        auto parsed = Expression::parse(dialect.expression(text), {}, {.allows_inputs = true});
        if (!parsed) throw std::runtime_error(fmt::format("{}: {}", text, parsed.error().message));
        std::vector<std::size_t> inputs;
        for (const auto& input : parsed->inputs()) inputs.push_back(std::stoul(input.name.substr(1)));
        return {std::move(*parsed), std::move(inputs)};
    }
};

/// One neuron and its receptor, as differential equations.
class Runner {
    const AfferentEquations& e_;
    Quantities q_;
    std::vector<const StateEquation*> states_;
    std::vector<Quantities::Compiled> slopes_;
    std::vector<std::pair<std::size_t, Quantities::Compiled>> definitions_;  // receptor's, I, neuron's
    double dt_, slope_ = 0, begin_ = 0, force_ = 0, active_ = 1, idle_until_ = 0;

    void define(std::string_view name, std::string_view expression) {
        q_.add(name);
        definitions_.emplace_back(q_.number(name), q_.compile(expression));
    }
    void update(double t) {
        q_["F"] = force_ + slope_ * (t - begin_);
        for (const auto& [number, value] : definitions_) q_.values[number] = value(q_.values);
    }
    double slope(std::size_t k) const {
        const auto& s = *states_[k];
        const double rate = slopes_[k](q_.values);
        return !s.minimum.empty() && q_[s.name] <= q_[s.minimum] ? std::max(rate, 0.0) : rate;
    }
    /// The slopes of all states at time t, in states that are those of `from` plus h times `k`.
    std::vector<double> slopes(const std::vector<double>& from, const std::vector<double>& k, double h, double t) {
        for (std::size_t i = 0; i < states_.size(); ++i) q_[states_[i]->name] = from[i] + h * k[i];
        update(t);
        std::vector<double> out;
        for (std::size_t i = 0; i < states_.size(); ++i) out.push_back((states_[i]->is_held_while_refractory ? active_ : 1) * slope(i));
        return out;
    }
    void integrate(double t) {
        std::vector<double> x;
        for (const auto* s : states_) x.push_back(q_[s->name]);
        const std::vector<double> none(x.size());
        const auto k1 = slopes(x, none, 0, t), k2 = slopes(x, k1, dt_ / 2, t + dt_ / 2), k3 = slopes(x, k2, dt_ / 2, t + dt_ / 2),
                   k4 = slopes(x, k3, dt_, t + dt_);
        for (std::size_t i = 0; i < x.size(); ++i) q_[states_[i]->name] = x[i] + dt_ / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
        for (const auto* s : states_)
            if (!s->minimum.empty()) q_[s->name] = std::max(q_[s->name], q_[s->minimum]);
        update(t + dt_);
    }
    double margin() const { return q_[e_.neuron->value] - q_[e_.neuron->threshold]; }

    /// The spike in the step that begins at t; `before` is the margin there.
    double spike(double t, double before) {
        const double late = dt_ * margin() / (margin() - std::min(before, 0.0)), free = std::max(late - e_.refractory_time, 0.0);
        const auto move = [&](double direction, bool after) {
            for (std::size_t i = 0; i < states_.size(); ++i)
                for (const auto& a : e_.neuron->at_spike)
                    if (a.name == states_[i]->name)
                        q_[a.name] += direction * (after && states_[i]->is_held_while_refractory ? free : late) * slope(i);
        };
        move(-1, false);
        for (const auto& a : e_.neuron->at_spike) q_[a.name] = q_.compile(a.expression)(q_.values);
        update(t + dt_);
        move(1, true);
        update(t + dt_);
        idle_until_ = t + dt_ - late + e_.refractory_time;
        return t + dt_ - late;
    }

public:
    Runner(const AfferentEquations& e, std::size_t current, double force, double dt) : e_(e), dt_(dt), force_(force) {
        q_.add("pi", 3.141592653589793);
        for (const auto& p : e.parameters) q_.add(p.name, p.value);
        q_.add("F", force), q_.add("dF");
        for (const auto* rows : {&e.receptor->states, &e.neuron->states})
            for (const auto& s : *rows) {
                double initial = 0;
                for (const auto& n : e.initial)
                    if (n.name == s.name) initial = n.value;
                if (!s.initial.empty()) initial = q_.compile(s.initial)(q_.values);
                q_.add(s.name, initial);
                states_.push_back(&s);
            }
        for (const auto& d : e.receptor->definitions) define(d.name, d.expression);
        if (e.receptor->currents[current] != "I") define("I", e.receptor->currents[current]);
        for (const auto& d : e.neuron->definitions) define(d.name, d.expression);
        for (const auto* s : states_) slopes_.push_back(q_.compile(s->slope));
        update(0);
    }

    void run(const std::vector<double>& force, std::vector<double>& currents, std::vector<double>& spikes) {
        currents.push_back(q_["I"]);
        for (std::size_t k = 0; k + 1 < force.size(); ++k) {
            begin_ = static_cast<double>(k) * dt_, force_ = force[k], slope_ = (force[k + 1] - force[k]) / dt_;
            q_["dF"] = slope_;
            update(begin_);
            active_ = std::clamp((begin_ + dt_ - idle_until_) / dt_, 0.0, 1.0);
            const double before = margin();
            integrate(begin_);
            const bool may_fire = e_.neuron->condition.empty() || q_[e_.neuron->condition] > 0;
            currents.push_back(q_["I"]);
            if (margin() > 0 && may_fire) spikes.push_back(spike(begin_, before));
        }
    }
};

}  // namespace

EquationResponse run_equations(const AfferentEquations& equations, const std::vector<double>& force, double dt) {
    EquationResponse out;
    out.currents.resize(equations.receptor->currents.size());
    for (std::size_t k = 0; k < out.currents.size(); ++k) Runner(equations, k, force[0], dt).run(force, out.currents[k], out.spikes);
    std::sort(out.spikes.begin(), out.spikes.end());
    return out;
}

}  // namespace corpuscle::test
