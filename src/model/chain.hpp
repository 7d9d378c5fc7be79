#pragma once
// An afferent made of a receptor and one neuron for each of the receptor's currents, simulated alone and in double precision.
// lane_population.hpp simulates many at once.

#include <fmt/format.h>
#include <algorithm>
#include <cstring>
#include <type_traits>

#include "core/random.hpp"
#include "model/current.hpp"
#include "model/parameter_values.hpp"
#include "model/random_stream.hpp"

namespace corpuscle {

inline constexpr double noise_band = 1e3;  ///< Hz

/// The end of the names of current k of receptor R and of the quantities of its neuron: "_+"; "" if there is only one current.
template <class R>
std::string sign_suffix([[maybe_unused]] int k) {
    if constexpr (requires { R::signs; }) return "_" + std::string(R::signs[k]);
    return "";
}

/// An afferent with receptor R and neuron N. A receptor with two currents (`outputs` is 2) drives two neurons with the same parameters;
/// their spikes form one train.
template <template <class> class R, template <class> class N>
class Chain final : public Afferent {
    using Receptor = R<double>;
    using Neuron = N<double>;
    static constexpr int outputs = Receptor::outputs;
    using Currents = Current<double>[outputs];

    /// Number of recordable quantities of the receptor besides its currents.
    static constexpr std::size_t receptor_recordables = [] {
        if constexpr (requires { Receptor::recordables; })
            return std::size(Receptor::recordables);
        else
            return std::size_t{0};
    }();
    static constexpr std::size_t neuron_recordables = std::size(Neuron::recordables);

    /// The state of the receptor and its neurons; the values of a State are its bytes.
    struct Values {
        typename Receptor::State receptor;
        typename Neuron::State neuron[outputs];
    };
    static_assert(std::is_trivially_copyable_v<Values> && sizeof(Values) % sizeof(double) == 0, "a state is doubles and nothing else");

    /// Receives the spikes of one step. A neuron calls it with a mask of lanes, here a single bool that is always true, and the spike's
    /// offset within the step.
    struct SpikeSink {
        ResponseBlock& response;
        bool sampled;       // true: all spikes are put on the sample
        std::int64_t step;  // the sample that ends the step, counted from 0 at the first sample of the simulation
        void operator()(bool, double offset) { response.spikes.push_back({step, sampled ? 1.0 : offset, response.afferent_index}); }
    };

    Receptor receptor_;
    Neuron neuron_;
    Method method_;
    bool spikes_on_samples_;
    double noise_;  // standard deviation of the noise current of one step, A; its band ends at half the sampling rate
    std::uint64_t seed_;
    std::string name_, format_;
    std::vector<std::string> probe_names_;  // probes_ refers to them
    std::vector<Probe> probes_;

    /// Names the probes in the order of record().
    void name_probes() {
        std::vector<std::string_view> units;
        const auto add = [&](std::string name, std::string_view unit) { probe_names_.push_back(std::move(name)), units.push_back(unit); };
        if constexpr (receptor_recordables > 0)
            for (const auto& p : Receptor::recordables) add(std::string(p.name), p.unit);
        for (int k = 0; k < outputs; ++k) add("I" + sign_suffix<Receptor>(k), "A");
        for (int k = 0; k < outputs; ++k)
            for (const auto& p : Neuron::recordables) add(std::string(p.name) + sign_suffix<Receptor>(k), p.unit);
        for (std::size_t k = 0; k < probe_names_.size(); ++k) probes_.push_back({probe_names_[k], units[k]});
    }

    /// Adds noise to each neuron's current. The noise depends only on the seed, the afferent's index, the neuron and the step.
    void add_noise(Currents& i, std::uint32_t afferent, std::int64_t step) const {
        constexpr std::uint32_t purpose = 0x6d656d00;  // this value and the next ones select a random stream for each neuron
        for (std::uint32_t n = 0; n < outputs; ++n) {
            const double x = noise_ * normal(seed_, afferent, purpose + n, static_cast<std::uint64_t>(step));
            i[n] = {i[n].from + x, i[n].to + x};
        }
    }

    /// Writes the recordable quantities of sample k of the block, if probes are requested: the components of the receptor's current, its
    /// currents at the end of the step, then the quantities of each neuron.
    void record(const Values& s, const Currents& i, std::size_t k, ResponseBlock& response) const {
        if (response.probes.empty()) return;
        std::size_t at = 0;
        const auto add = [&](const auto& model, const auto& state, auto& quantities) {
            model.record(state, quantities);
            for (const double q : quantities) response.probes[at++][k] = q;
        };
        if constexpr (receptor_recordables > 0) {
            double quantities[receptor_recordables];
            add(receptor_, s.receptor, quantities);
        }
        for (const auto& c : i) response.probes[at++][k] = c.to;
        for (const auto& n : s.neuron) {
            double quantities[neuron_recordables];
            add(neuron_, n, quantities);
        }
    }

    /// Simulates one step of all neurons; the spikes of two neurons are sorted by time. Returns true if a neuron reached the limit of
    /// spikes per step.
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

    /// Simulates the first sample of the force. The force before it is assumed to be the same. Backward Euler takes a step that ends at
    /// this sample, as the published algorithms do, and puts its spikes on the sample, because the simulation begins there. The exact
    /// method has no interval to integrate yet, so the neurons take no step.
    void run_first_sample(double force, Values& s, ResponseBlock& response) const {
        s.receptor = receptor_.start(force);
        for (auto& n : s.neuron) n = start_neuron(neuron_, seed_, response.afferent_index);
        Currents i;
        receptor_.step(s.receptor, force, i);
        if (method_ == Method::backward_euler) {
            if (noise_ > 0) add_noise(i, response.afferent_index, 0);
            SpikeSink into{response, true, 0};
            response.truncated_steps += step_neurons(s.neuron, i, into);
        }
        record(s, i, 0, response);
    }

    /// Simulates samples [from, to) of the block. `first` is the number of the block's first sample, counted from the start of the
    /// simulation. `observed` is false if there are neither probes nor noise; the state then stays in registers.
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
    Chain(const ParameterValues<Receptor>& r, const ParameterValues<Neuron>& n, const SimulationOptions& run)
        : receptor_(r, run.dt, run.method), neuron_(n, run.dt, run.method), method_(run.method), spikes_on_samples_(run.spikes_on_samples),
          noise_(run.noise * std::sqrt(0.5 / run.dt / noise_band)), seed_(run.seed),
          name_(fmt::format("{}+{}", Receptor::name, Neuron::name)),
          format_(fmt::format("{}/2, T = {} s", name_, run.dt)) {  // 2: version of the state's format
        name_probes();
    }

    std::span<const Probe> probes() const override { return probes_; }
    State start(ChannelSlot) const override { return {format_, 0, std::vector<double>(sizeof(Values) / sizeof(double))}; }

    Result<void> respond(std::span<const double> force, State& state, ResponseBlock& response) const override {
        TRY(check_block(name_, format_, sizeof(Values) / sizeof(double), state, force));
        if (force.empty()) return {};
        Values s;
        std::memcpy(&s, state.values.data(), sizeof s);
        const bool is_first = state.step == 0;
        if (is_first) run_first_sample(force[0], s, response);
        const auto run_samples = response.probes.empty() && noise_ == 0 ? &Chain::run<false> : &Chain::run<true>;
        for (std::size_t k = is_first ? 1 : 0, to = 0; k < force.size(); k = to) {
            // `now`: number of the next sample since the start; `left`: samples until the next flush.
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
