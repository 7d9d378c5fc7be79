#pragma once
// A transduction joined to a neuron: the kernel, for any kind of number, and the afferent it makes with double.

#include <fmt/format.h>
#include <algorithm>
#include <cstring>
#include <type_traits>

#include "model/current.hpp"
#include "signal/afferent.hpp"
#include "signal/random.hpp"

namespace corpuscle {

/// The equations of R and N over a block. POD and pointers only: the same text is compiled for lanes.
template <template <class> class R, template <class> class N, class T>
struct Kernel {
    using Receptor = R<T>;
    using Neuron = N<T>;
    static constexpr int outputs = Receptor::outputs;
    static constexpr int receptor_parts = [] {
        if constexpr (requires { Receptor::parts; })
            return static_cast<int>(std::size(Receptor::parts));
        else
            return 0;
    }();
    static constexpr int neuron_parts = static_cast<int>(std::size(Neuron::parts));
    static constexpr int probes = receptor_parts + outputs + outputs * neuron_parts;

    struct State {
        typename Receptor::State receptor;
        typename Neuron::State neuron[outputs];
    };

    Receptor receptor;
    Neuron neuron;
    Method method;

    State start(T force) const {
        State s;
        s.receptor = receptor.start(force);
        for (auto& n : s.neuron) n = neuron.start();
        return s;
    }

    /// One sample; disturb(i) may change the currents on their way; fired(mask, offset) for each spike. Returns where a neuron's cap
    /// cut it short.
    template <class Disturb, class Fired>
    num::Mask<T> step(State& s, T force, Current<T> (&i)[outputs], Disturb&& disturb, Fired&& fired) const {
        receptor.step(s.receptor, force, i);
        disturb(i);
        auto capped = neuron.step(s.neuron[0], i[0], fired);
        for (int k = 1; k < outputs; ++k) capped = capped | neuron.step(s.neuron[k], i[k], fired);
        return capped;
    }

    /// The first sample: the force before it was the same. Backward Euler takes a step there, as the algorithms do, and puts its
    /// spikes on the sample: there is no time before it. Exact has no time to cover yet.
    template <class Disturb, class Fired>
    num::Mask<T> first(State& s, T force, Current<T> (&i)[outputs], Disturb&& disturb, Fired&& fired) const {
        if (method == Method::backward_euler) return step(s, force, i, disturb, [&](num::Mask<T> who, T) { fired(who, T(1.0)); });
        receptor.step(s.receptor, force, i);
        return num::none<T>();
    }

    /// What the probes show, in their order: components of the current, the currents, each neuron's own.
    void show(const State& s, const Current<T> (&i)[outputs], T (&out)[probes]) const {
        if constexpr (receptor_parts > 0) {
            T parts[receptor_parts];
            receptor.show(s.receptor, parts);
            for (int p = 0; p < receptor_parts; ++p) out[p] = parts[p];
        }
        for (int k = 0; k < outputs; ++k) {
            out[receptor_parts + k] = i[k].to;
            T parts[neuron_parts];
            neuron.show(s.neuron[k], parts);
            for (int p = 0; p < neuron_parts; ++p) out[receptor_parts + outputs + k * neuron_parts + p] = parts[p];
        }
    }
};

/// How a chain is run.
struct Run {
    double dt = 1e-4;  ///< s, one sample
    Method method = Method::exact;
    bool sampled = false;  ///< spikes on the sample, as in the thesis, not inside the step
    /// Membrane noise: a white current to each neuron; its standard deviation within noise_band, A. Constant in each step.
    double noise = 0;
    std::uint64_t seed = 0;
};

inline constexpr double noise_band = 1e3;  ///< Hz

template <template <class> class R, template <class> class N>
class Chain final : public Afferent {
    using K = Kernel<R, N, double>;
    using Values = typename K::State;
    static_assert(std::is_trivially_copyable_v<Values> && sizeof(Values) % sizeof(double) == 0, "a state is doubles and nothing else");

    K kernel_;
    bool sampled_;
    double noise_;  // standard deviation of one step's current, A: white up to 1/(2T)
    std::uint64_t seed_;
    std::string name_, format_;
    std::vector<std::string> names_;
    std::vector<Probe> probes_;

    void name_probes() {
        const auto sign = [](int k) {
            if constexpr (requires { R<double>::signs; })
                return "_" + std::string(R<double>::signs[k]);
            else
                return (void)k, std::string();
        };
        std::vector<std::string_view> units;
        const auto add = [&](std::string name, std::string_view unit) { names_.push_back(std::move(name)), units.push_back(unit); };
        if constexpr (K::receptor_parts > 0)
            for (const auto& p : R<double>::parts) add(std::string(p.name), p.unit);
        for (int k = 0; k < K::outputs; ++k) add("I" + sign(k), "A");
        for (int k = 0; k < K::outputs; ++k)
            for (const auto& p : N<double>::parts) add(std::string(p.name) + sign(k), p.unit);
        for (std::size_t k = 0; k < names_.size(); ++k) probes_.push_back({names_[k], units[k]});
    }

    /// A neuron's noise in a step; it depends on what it is for alone: seed, unit, neuron and step.
    [[gnu::noinline]] double drawn(std::uint32_t unit, int neuron, std::int64_t step) const {
        constexpr std::uint32_t purpose = 0x6d656d00;  // membranes' own streams, one a neuron
        return noise_ * normal(seed_, unit, purpose + static_cast<std::uint32_t>(neuron), static_cast<std::uint64_t>(step));
    }

    template <bool Probed>
    void run(std::span<const double> force, std::int64_t first, Values& state, Answer& answer) const {
        Values s = state;  // a local: kept in registers
        Current<double> i[K::outputs] = {};
        for (std::size_t k = 0; k < force.size(); ++k) {
            const auto fired = [&](bool, double x) {
                answer.spikes.push_back({first + static_cast<std::int64_t>(k), sampled_ ? 1.0 : x, answer.unit});
            };
            const auto noise = [&](Current<double>(&to)[K::outputs]) {
                for (int n = 0; noise_ > 0 && n < K::outputs; ++n) {
                    const double x = drawn(answer.unit, n, first + static_cast<std::int64_t>(k));
                    to[n] = {to[n].from + x, to[n].to + x};
                }
            };
            [[maybe_unused]] const std::size_t seen = answer.spikes.size();
            const bool capped = first + static_cast<std::int64_t>(k) == 0 ? kernel_.first(s, force[k], i, noise, fired)
                                                                          : kernel_.step(s, force[k], i, noise, fired);
            if (capped) ++answer.capped;
            if constexpr (K::outputs > 1) sort_from(seen, answer.spikes);
            if constexpr (Probed) show(s, i, k, answer);
        }
        state = s;
    }

    /// The spikes of several neurons in one step, put in order.
    static void sort_from(std::size_t seen, std::vector<Spike>& spikes) {
        if (spikes.size() > seen + 1) std::sort(spikes.begin() + static_cast<std::ptrdiff_t>(seen), spikes.end());
    }

    void show(const Values& s, const Current<double> (&i)[K::outputs], std::size_t k, Answer& answer) const {
        double shown[K::probes];
        kernel_.show(s, i, shown);
        for (int p = 0; p < K::probes; ++p) answer.probes[static_cast<std::size_t>(p)][k] = shown[p];
    }

public:
    template <class RP, class NP>
    Chain(const RP& r, const NP& n, const Run& run)
        : kernel_{R<double>(Same<RP>{r}, run.dt, run.method), N<double>(Same<NP>{n}, run.dt, run.method), run.method},
          sampled_(run.sampled), noise_(run.noise * std::sqrt(0.5 / run.dt / noise_band)), seed_(run.seed),
          name_(fmt::format("{}+{}", R<double>::name, N<double>::name)), format_(fmt::format("{}/1, T = {} s", name_, run.dt)) {
        name_probes();
    }

    std::span<const Probe> probes() const override { return probes_; }
    State start(Turn) const override { return {format_, 0, std::vector<double>(sizeof(Values) / sizeof(double))}; }

    Result<void> respond(std::span<const double> force, State& state, Answer& answer) const override {
        if (auto ok = check_block(name_, format_, sizeof(Values) / sizeof(double), state, force); !ok) return ok;
        if (force.empty()) return {};
        Values s;
        std::memcpy(&s, state.values.data(), sizeof s);
        if (state.step == 0) s = kernel_.start(force[0]);
        answer.probes.empty() ? run<false>(force, state.step, s, answer) : run<true>(force, state.step, s, answer);
        std::memcpy(state.values.data(), &s, sizeof s);
        if (first_not_finite(state.values) < state.values.size())
            return Error{Code::not_converged, fmt::format("{}: its state left the finite numbers between samples {} and {}; the force or a "
                                                          "gain is far too large, or the substep too long",
                                                          name_, state.step, state.step + static_cast<std::int64_t>(force.size()))};
        state.step += static_cast<std::int64_t>(force.size());
        return {};
    }
};

}  // namespace corpuscle
