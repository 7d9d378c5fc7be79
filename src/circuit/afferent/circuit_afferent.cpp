#include "circuit/afferent/circuit_afferent.hpp"

#include <mutex>
#include <nlohmann/json.hpp>

#include "circuit/afferent/streaming_transient.hpp"
#include "circuit/cost/cost.hpp"
#include "circuit/schematic/schematic.hpp"
#include "circuit/variant/settable_values.hpp"
#include "core/checksum.hpp"

namespace corpuscle::circuit {
namespace {

/// FNV-1a hash over the values and connections that determine how a circuit responds.
std::uint64_t fingerprint_of(const Circuit& c) {
    Fnv1a hash;
    const auto number = [&](std::uint64_t x) { hash.add_word(x); };
    const auto real = [&](double x) { number(std::bit_cast<std::uint64_t>(x)); };
    const auto text = [&](std::string_view s) { hash.add(s), number(s.size()); };
    const auto values = [&](const Values& all) {
        for (const auto& [name, value] : all) text(name), real(value);
    };
    const auto formula = [&](const Expression& f) {
        const auto expression_text =
            f.text([](const ExpressionInput& in) { return fmt::format("{}({},{})", static_cast<int>(in.kind), in.name, in.minus); });
        if (expression_text) text(*expression_text);
    };
    for (const auto& e : c.elements) {
        text(e.name), values(e.values), real(e.value), real(e.waveform.dc), number(static_cast<std::uint64_t>(e.waveform.shape));
        number(static_cast<std::uint64_t>(e.model));
        for (const int n : e.nodes) number(static_cast<std::uint64_t>(n));
        for (const double x : e.waveform.numbers) real(x);
        if (e.waveform.repeats_from) real(*e.waveform.repeats_from);
        if (e.expression) formula(*e.expression);
        // Hashed only if present, so that netlists without them keep the hash of earlier versions and their saved states stay valid.
        if (!e.control_source.empty()) text(e.control_source);
        for (const auto& inductor : e.inductors) text(inductor);
        if (e.expression && e.expression_is_voltage) number(1);
    }
    for (const auto& m : c.models) text(m.type), values(m.values);
    for (const auto* node_voltages : {&c.ic, &c.nodesets})
        for (const auto& [node, value] : *node_voltages) number(static_cast<std::uint64_t>(node)), real(value);
    values(c.options), real(c.temperature);
    for (const auto& [name, word] : c.option_words) text(name), text(word);
    for (const auto& command : c.directives)
        if (command.name == "tran" || command.name == "spike")
            for (const auto& word : command.words) text(word);
    return hash.value;
}

/// The unknowns whose values between time points are used: those of spikes, probes and operating ranges.
std::vector<int> interpolated_unknowns(const CircuitAfferentFactory& factory) {
    std::vector<int> out;
    const auto add = [&](const SavedQuantity& quantity) { out.insert(out.end(), {quantity.unknowns.plus, quantity.unknowns.minus}); };
    add(factory.spike_output.quantity);
    for (const auto& range : factory.operating_ranges) add(range.quantity);
    for (const auto& probe : factory.probes) add(probe);
    return out;
}

class CircuitAfferent final : public Afferent {
    std::shared_ptr<const CircuitAfferentFactory> factory_;
    double T_;                        // sample time, s
    bool sampled_;                    // true if spikes occur only at sample times
    std::optional<ChipSample> chip_;  // empty: nominal
    std::uint32_t copy_;
    std::int64_t delay_;  // samples
    std::string format_;  // marks saved states: a state fits only the same netlist, chip and T
    std::vector<Probe> probes_;
    std::vector<ValidRange> ranges_;
    mutable std::mutex guard_;
    mutable std::vector<std::unique_ptr<StreamingTransient>> idle_;  // transients that no call of respond() uses; guarded by guard_

    // Each concurrent call of respond() uses a transient of its own.
    Result<std::unique_ptr<StreamingTransient>> borrow(const std::function<bool()>& should_stop = {}) const {
        {
            const std::lock_guard lock(guard_);
            if (!idle_.empty()) {
                auto transient = std::move(idle_.back());
                idle_.pop_back();
                transient->set_stop(should_stop);
                return transient;
            }
        }
        return StreamingTransient::make(*factory_, T_, chip_, copy_, should_stop);
    }
    void give_back(std::unique_ptr<StreamingTransient> transient) const {
        transient->set_stop({});
        const std::lock_guard lock(guard_);
        idle_.push_back(std::move(transient));
    }

    Error damaged_state() const {
        return bad_input(
            fmt::format("{}: a saved state is damaged: its values are not possible for this netlist", factory_->circuit->file));
    }
    Result<void> respond_with(StreamingTransient&, std::span<const double> force, State&, ResponseBlock&) const;
    Result<void> simulate_samples(StreamingTransient&, std::int64_t from, std::int64_t to, ResponseBlock&) const;

public:
    CircuitAfferent(std::shared_ptr<const CircuitAfferentFactory> factory, double dt, bool sampled, std::optional<ChipSample> chip,
                    std::uint32_t copy)
        : factory_(std::move(factory)), T_(dt), sampled_(sampled), chip_(std::move(chip)), copy_(copy),
          // Transient::step() must know the force for 2.1 steps ahead.
          delay_(static_cast<std::int64_t>(std::ceil(2.1 * factory_->plan.max_step / dt)) + ForceWaveform::lookahead + 2),
          // The 2 is the version of the state's meaning. Chips are counted from 1 here.
          format_(fmt::format("netlist {:016x}/2{}{}, T = {} s", factory_->fingerprint,
                              chip_ ? fmt::format(", chip {} of {}", chip_->chip + 1, chip_->seed) : "",
                              factory_->plan.noise.is_on() ? fmt::format(", noise {}", noise_stream_of(chip_, copy)) : "", dt)) {
        for (const auto& s : factory_->probes) probes_.push_back({s.name, s.is_voltage() ? "V" : "A"});
        for (const auto& w : factory_->operating_ranges) ranges_.push_back(w.range());
    }

    std::span<const Probe> probes() const override { return probes_; }
    std::span<const ValidRange> ranges() const override { return ranges_; }
    State start(ChannelSlot) const override { return {format_, 0, {}}; }
    std::int64_t delay() const override { return delay_; }

    Result<void> respond(std::span<const double> force, State& state, ResponseBlock& response) const override {
        TRY(check_block(factory_->circuit->file, format_, state.values.size(), state, force));
        for (double* values : response.probes) std::fill_n(values, force.size(), std::numeric_limits<double>::quiet_NaN());
        if (force.empty()) return {};
        auto transient = TRY(borrow(response.should_stop));
        auto done = respond_with(*transient, force, state, response);
        if (transient->is_stopped()) done = interrupted_error();
        give_back(std::move(transient));
        return done;
    }

    Result<OperatingState> operating_state(const State& state) const override {
        TRY(check_block(factory_->circuit->file, format_, state.values.size(), state, {}));
        if (state.step == 0) return OperatingState{};
        auto transient = TRY(borrow());
        if (!transient->restore(state.values, state.step)) return damaged_state();
        auto out = transient->operating_state();
        give_back(std::move(transient));
        return out;
    }
};

Result<void> CircuitAfferent::respond_with(StreamingTransient& transient, std::span<const double> force, State& state,
                                           ResponseBlock& response) const {
    if (state.step == 0) {
        TRY(transient.begin(force));
    } else {
        if (!transient.restore(state.values, state.step)) return damaged_state();
        transient.append_force(force);
    }
    const auto before = transient.work();
    transient.take_energy_use();  // discard the energy of earlier calls
    const auto from = state.step - delay_;
    state.step += static_cast<std::int64_t>(force.size());
    auto done = simulate_samples(transient, from, state.step - delay_, response);
    const auto& work = transient.work();
    response.energy_use += transient.take_energy_use();
    response.steps += work.steps - before.steps, response.rejected_steps += work.rejected - before.rejected;
    response.newton_iterations += work.iterations - before.iterations;
    state.values.clear();
    transient.save(state.values);
    return done;
}

/// Simulates until the responses to samples `from` to `to` - 1 are complete. Samples before 0 are those before the start.
Result<void> CircuitAfferent::simulate_samples(StreamingTransient& transient, std::int64_t from, std::int64_t to,
                                               ResponseBlock& response) const {
    // A spike at `to` or later stays pending for the next block. Then sample `to` - 1 has been reached, so no further step replaces it.
    const auto report_spike = [&] {
        auto& spike = transient.pending_spike();
        if (!spike || spike->step >= to) return;
        response.spikes.push_back({spike->step, sampled_ ? 1 : spike->offset, response.afferent_index});  // 1: at the sample itself
        spike.reset();
    };
    report_spike();
    for (std::int64_t sample = from;;) {
        for (; sample < to && transient.has_reached(sample); ++sample) {
            for (std::size_t p = 0; p < response.probes.size(); ++p)
                response.probes[p][static_cast<std::size_t>(sample - from)] = transient.probe_value(factory_->probes[p], sample);
            if (sample >= 0)
                check_ranges(factory_->operating_ranges, response.range_violations, sample,
                             [&](const SavedQuantity& quantity) { return transient.probe_value(quantity, sample); });
        }
        if (sample == to) return {};
        TRY(transient.step());
        report_spike();
    }
}

}  // namespace

Result<std::shared_ptr<const CircuitAfferentFactory>> CircuitAfferentFactory::create(const Netlist& netlist) {
    auto circuit = std::make_shared<const Circuit>(TRY(netlist.elaborate()));
    return create(std::move(circuit), netlist);
}

Result<std::shared_ptr<const CircuitAfferentFactory>> CircuitAfferentFactory::create(std::shared_ptr<const Circuit> circuit,
                                                                                     std::optional<Netlist> netlist) {
    const auto context = TRY(AnalysisContext::make(circuit));
    const SourceLocation location{circuit->file};
    const auto plan = TRY(read_transient_plan(*circuit));
    const auto output = TRY(read_spike_output(context->system));
    auto probes = TRY(resolve_saved_quantities(context->system));
    auto ranges = TRY(read_operating_ranges(context->system));
    if (!context->system.set_force_input(nullptr))
        return error_at(location, "no source carries a force; add one, such as 'iin 0 fin force 60n' (60 nA per newton)");
    if (!output) return error_at(location, "no .spike directive defines the spike output; add '.spike v(NODE) LEVEL [rise|fall]'");
    auto factory = std::make_shared<CircuitAfferentFactory>();
    factory->netlist = std::move(netlist);
    for (const auto& c : circuit->directives_named("mc")) factory->chips = TRY(parse_chip_spec(c));
    for (const auto& c : circuit->directives_named("tran")) factory->times = TRY(read_transient_times(c));
    // The mismatch override replaces .mc.
    if (circuit->mismatch_seed) factory->chips = ChipSpec{1, *circuit->mismatch_seed, true, true, circuit->chip};
    if (probes.empty()) probes.push_back(output->quantity);
    factory->circuit = std::move(circuit), factory->plan = plan, factory->spike_output = *output, factory->probes = std::move(probes),
    factory->operating_ranges = std::move(ranges);
    factory->plan.reported = interpolated_unknowns(*factory);
    factory->plan.max_step = factory->times.max_step.value_or(default_max_step);
    factory->fingerprint = fingerprint_of(*factory->circuit);
    return std::shared_ptr<const CircuitAfferentFactory>(std::move(factory));
}

std::unique_ptr<Afferent> CircuitAfferentFactory::make(const AfferentPlan& afferent_plan, const SimulationOptions& run) const {
    return make(run.dt, run.spikes_on_samples, afferent_plan.copy_number);
}

AfferentTraits CircuitAfferentFactory::traits(const AfferentPlan&) const {
    return {.can_use_lanes = false,
            .can_search_factor = false,
            .may_diverge = true,
            .is_implementation = true,
            .ignores_case = true,
            .lane_obstacles = "netlists",
            .spike_probe = spike_output.quantity.name,
            .spike_level = spike_output.level,
            .reason_no_chips = reason_no_variation(*circuit),
            .reason_no_noise = "a netlist has no model membrane"};
}

std::vector<std::pair<std::string, std::string>> CircuitAfferentFactory::labels(const AfferentPlan&) const {
    std::vector<std::pair<std::string, std::string>> out = {{"description", circuit->title}};
    if (netlist && !netlist->overrides().corner.empty()) out.emplace_back("corner", netlist->overrides().corner);
    return out;
}

Result<std::shared_ptr<const AfferentFactory>> CircuitAfferentFactory::rebuilt(const AfferentPlan& copy,
                                                                               const AfferentPlan& original) const {
    if (copy.values == original.values) return std::shared_ptr<const AfferentFactory>();
    auto changes = netlist->overrides();  // NetlistSpec has made the plan, so there is a netlist
    for (std::size_t k = 0; k < copy.values.size(); ++k)
        if (copy.values[k] != original.values[k])
            changes.parameters.insert_or_assign(std::string((*copy.parameters)[k].info.name), copy.values[k]);
    const auto changed = create(netlist->with_overrides(std::move(changes)));
    if (!changed) return Error{changed.error().code, fmt::format("{}: {}", copy.name, changed.error().message), changed.error().location};
    return std::shared_ptr<const AfferentFactory>(*changed);
}

nlohmann::ordered_json CircuitAfferentFactory::cost(double rest_force, const EnergyUse& used) const {
    auto context = AnalysisContext::make(circuit);
    if (!context) return nullptr;
    ForceWaveform waveform;
    waveform.append(std::array{rest_force});
    (*context)->system.set_force_input(&waveform);
    auto cost = cost_of(**context);
    if (!cost) return nullptr;  // the circuit has no operating point under this force
    if (used.seconds > 0) {
        // Energy and time are sums over copies and channels, so this is the mean power of one afferent.
        const double supplies = used.supplies / used.seconds, sensor = used.sensor / used.seconds;
        cost->power.emplace_back("mean", PowerBreakdown{supplies, sensor, supplies - sensor, {}, {}});
    }
    return document_of(*cost);
}

Result<std::vector<SettableValue>> CircuitAfferentFactory::settable_values() const {
    auto out = settable_values_of(*circuit);
    if (!netlist) return out;
    SettableValue corner{.name = "corner", .kind = SettableValue::Kind::choice, .description = "process corner"};
    corner.choices = netlist->corners();
    corner.text = netlist->overrides().corner;
    if (!corner.choices.empty()) out.insert(out.begin(), std::move(corner));
    return out;
}

Result<std::string> CircuitAfferentFactory::schematic(std::string_view block) const {
    if (!netlist) return bad_input("this circuit was made without a netlist, which is what a schematic shows");
    return TRY(draw_schematic(*netlist, block)).svg;
}

std::unique_ptr<Afferent> CircuitAfferentFactory::make(double dt, bool sampled, std::uint32_t copy) const {
    // Copy 0 is nominal, unless the mismatch override selects a chip for it.
    const bool has_chip = chips && (copy > 0 || circuit->mismatch_seed);
    const auto chip = has_chip ? std::optional(chips->sample(copy > 0 ? copy - 1 : 0)) : std::nullopt;
    return std::make_unique<CircuitAfferent>(shared_from_this(), dt, sampled, chip, copy);
}

std::unique_ptr<Afferent> CircuitAfferentFactory::make(double dt, const std::optional<ChipSample>& chip) const {
    return std::make_unique<CircuitAfferent>(shared_from_this(), dt, false, chip, 0);
}

}  // namespace corpuscle::circuit
