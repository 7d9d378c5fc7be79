#pragma once
// A receptor followed by one or more neurons: one afferent at a time, in double.

#include <fmt/format.h>
#include <algorithm>
#include <cstring>
#include <type_traits>

#include "model/current.hpp"
#include "signal/afferent.hpp"
#include "signal/random.hpp"

namespace corpuscle {

/// Options of a simulation.
struct SimulationOptions {
    double dt = 1e-4;  ///< s, sampling interval
    Method method = Method::exact;
    bool spikes_on_samples = false;  ///< spikes are put on the sample, as in the thesis; otherwise they get a time within the step
    /// Membrane noise: a white current into each neuron, constant within a step. Its standard deviation between 0 and noise_band, A.
    double noise = 0;
    std::uint64_t seed = 0;
};

inline constexpr double noise_band = 1e3;  ///< Hz

template <template <class> class R, template <class> class N>
class Chain final : public Afferent {
    using Receptor = R<double>;
    using Neuron = N<double>;
    static constexpr int outputs = Receptor::outputs;
    using Currents = Current<double>[outputs];

    static constexpr std::size_t receptor_recordables = [] {
        if constexpr (requires { Receptor::recordables; })
            return std::size(Receptor::recordables);
        else
            return std::size_t{0};
    }();
    static constexpr std::size_t neuron_recordables = std::size(Neuron::recordables);
    static constexpr std::size_t all_recordables = receptor_recordables + outputs * (1 + neuron_recordables);

    struct Values {
        typename Receptor::State receptor;
        typename Neuron::State neuron[outputs];
    };
    static_assert(std::is_trivially_copyable_v<Values> && sizeof(Values) % sizeof(double) == 0, "a state is doubles and nothing else");

    /// Receives the spikes of one step.
    struct SpikeSink {
        ResponseBlock& response;
        bool sampled;
        std::int64_t step;
        void operator()(bool, double x) { response.spikes.push_back({step, sampled ? 1.0 : x, response.afferent_index}); }
    };

    Receptor receptor_;
    Neuron neuron_;
    Method method_;
    bool spikes_on_samples_;
    double noise_;  // standard deviation of one step's current, A: white up to 1/(2T)
    std::uint64_t seed_;
    std::string name_, format_;
    std::vector<std::string> probe_names_;
    std::vector<Probe> probes_;

    void name_probes() {
        const auto sign = [](int k) {
            if constexpr (requires { Receptor::signs; })
                return "_" + std::string(Receptor::signs[k]);
            else
                return (void)k, std::string();
        };
        std::vector<std::string_view> units;
        const auto add = [&](std::string name, std::string_view unit) { probe_names_.push_back(std::move(name)), units.push_back(unit); };
        if constexpr (receptor_recordables > 0)
            for (const auto& p : Receptor::recordables) add(std::string(p.name), p.unit);
        for (int k = 0; k < outputs; ++k) add("I" + sign(k), "A");
        for (int k = 0; k < outputs; ++k)
            for (const auto& p : Neuron::recordables) add(std::string(p.name) + sign(k), p.unit);
        for (std::size_t k = 0; k < probe_names_.size(); ++k) probes_.push_back({probe_names_[k], units[k]});
    }

    /// Adds noise to each neuron's current. It depends only on seed, afferent, neuron and step.
    void add_noise(Currents& i, std::uint32_t afferent, std::int64_t step) const {
        constexpr std::uint32_t purpose = 0x6d656d00;  // separate random streams of the membranes, one for each neuron
        for (std::uint32_t n = 0; n < outputs; ++n) {
            const double x = noise_ * normal(seed_, afferent, purpose + n, static_cast<std::uint64_t>(step));
            i[n] = {i[n].from + x, i[n].to + x};
        }
    }

    /// The recordable quantities in the order of the probes: components of the receptor's current, the currents, then the quantities of
    /// each neuron.
    void record(const Values& s, const Currents& i, double (&out)[all_recordables]) const {
        std::size_t at = 0;
        const auto add = [&](const auto& model, const auto& state, auto& parts) {
            model.record(state, parts);
            for (const double p : parts) out[at++] = p;
        };
        if constexpr (receptor_recordables > 0) {
            double parts[receptor_recordables];
            add(receptor_, s.receptor, parts);
        }
        for (const auto& c : i) out[at++] = c.to;
        for (const auto& n : s.neuron) {
            double parts[neuron_recordables];
            add(neuron_, n, parts);
        }
    }

    /// Writes the recordable quantities of sample k, if probes are requested.
    void record(const Values& s, const Currents& i, std::size_t k, ResponseBlock& response) const {
        if (response.probes.empty()) return;
        double shown[all_recordables];
        record(s, i, shown);
        for (std::size_t p = 0; p < all_recordables; ++p) response.probes[p][k] = shown[p];
    }

    /// Feeds currents into neurons. Returns true if the limit on spikes per step truncated the step.
    [[gnu::always_inline]] bool step_neurons(typename Neuron::State (&n)[outputs], const Currents& i, SpikeSink& into) const {
        if constexpr (outputs == 1) {
            return neuron_.step(n[0], i[0], into);
        } else {
            const std::size_t seen = into.response.spikes.size();
            bool truncated = false;
            for (int k = 0; k < outputs; ++k) truncated |= neuron_.step(n[k], i[k], into);
            auto& spikes = into.response.spikes;
            if (spikes.size() > seen + 1) std::sort(spikes.begin() + static_cast<std::ptrdiff_t>(seen), spikes.end());
            return truncated;
        }
    }

    /// The first sample. The force before it is assumed to be the same. Backward Euler takes a step there, as the published algorithms do,
    /// and puts its spikes on the sample, because there is no time before it. The exact method has no interval to integrate yet.
    void run_first_sample(double force, Values& s, ResponseBlock& response) const {
        s.receptor = receptor_.start(force);
        for (auto& n : s.neuron) n = neuron_.start();
        Currents i;
        receptor_.step(s.receptor, force, i);
        if (method_ == Method::backward_euler) {
            if (noise_ > 0) add_noise(i, response.afferent_index, 0);
            SpikeSink into{response, true, 0};
            response.truncated_steps += step_neurons(s.neuron, i, into);
        }
        record(s, i, 0, response);
    }

    /// Simulates samples [from, to). Without probes and noise the state stays in registers.
    template <bool observed>
    void run(std::span<const double> force, std::size_t from, std::size_t to, std::int64_t first, Values& state,
             ResponseBlock& response) const {
        Values s = state;
        SpikeSink into{response, spikes_on_samples_, 0};
        for (std::size_t k = from; k < to; ++k) {
            Currents i;
            receptor_.step(s.receptor, force[k], i);
            into.step = first + static_cast<std::int64_t>(k);
            if constexpr (observed)
                if (noise_ > 0) add_noise(i, response.afferent_index, into.step);
            if (step_neurons(s.neuron, i, into)) ++response.truncated_steps;
            if constexpr (observed) record(s, i, k, response);
        }
        state = s;
    }

    void flush_decayed(Values& s) const {
        if constexpr (requires { receptor_.flush_decayed(s.receptor); }) receptor_.flush_decayed(s.receptor);
        if constexpr (requires { neuron_.flush_decayed(s.neuron[0]); })
            for (auto& n : s.neuron) neuron_.flush_decayed(n);
    }

public:
    template <class RP, class NP>
    Chain(const RP& r, const NP& n, const SimulationOptions& run)
        : receptor_(UniformParams<RP>{r}, run.dt, run.method), neuron_(UniformParams<NP>{n}, run.dt, run.method), method_(run.method),
          spikes_on_samples_(run.spikes_on_samples), noise_(run.noise * std::sqrt(0.5 / run.dt / noise_band)), seed_(run.seed),
          name_(fmt::format("{}+{}", Receptor::name, Neuron::name)), format_(fmt::format("{}/2, T = {} s", name_, run.dt)) {
        name_probes();
    }

    std::span<const Probe> probes() const override { return probes_; }
    State start(ChannelSlot) const override { return {format_, 0, std::vector<double>(sizeof(Values) / sizeof(double))}; }

    Result<void> respond(std::span<const double> force, State& state, ResponseBlock& response) const override {
        if (auto ok = check_block(name_, format_, sizeof(Values) / sizeof(double), state, force); !ok) return ok;
        if (force.empty()) return {};
        Values s;
        std::memcpy(&s, state.values.data(), sizeof s);
        const bool is_first = state.step == 0;
        if (is_first) run_first_sample(force[0], s, response);
        const auto run_samples = response.probes.empty() && noise_ == 0 ? &Chain::run<false> : &Chain::run<true>;
        for (std::size_t k = is_first ? 1 : 0, to = 0; k < force.size(); k = to) {
            const std::int64_t now = state.step + static_cast<std::int64_t>(k), left = flush_interval - now % flush_interval;
            if (left == flush_interval) flush_decayed(s);
            to = std::min(force.size(), k + static_cast<std::size_t>(left));
            (this->*run_samples)(force, k, to, state.step, s, response);
        }
        std::memcpy(state.values.data(), &s, sizeof s);
        if (first_non_finite(state.values) < state.values.size())
            return Error{ErrorCode::not_converged,
                         fmt::format("{}: its state became NaN or infinite between samples {} and {}; the force or a "
                                     "gain is far too large, or the substep too long",
                                     name_, state.step, state.step + static_cast<std::int64_t>(force.size()))};
        state.step += static_cast<std::int64_t>(force.size());
        return {};
    }
};

}  // namespace corpuscle
