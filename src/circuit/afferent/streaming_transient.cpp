#include "circuit/afferent/streaming_transient.hpp"

#include <set>

#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double max_time_before_shift = 100;  // s; after it the time origin is shifted, since doubles resolve small times better
constexpr double stop_time = 1e3;              // s, end of a transient whose origin can be shifted
constexpr double stop_time_unshifted = 1e5;    // s, end of a transient with sources that depend on absolute time

}  // namespace

Result<std::unique_ptr<StreamingTransient>> StreamingTransient::make(const CircuitAfferentFactory& factory, double T,
                                                                     const std::optional<ChipSample>& chip, std::uint64_t copy,
                                                                     const std::function<bool()>& should_stop) {
    auto context = TRY(AnalysisContext::make(factory.circuit));
    std::unique_ptr<StreamingTransient> out(new StreamingTransient(factory, T));
    out->context_ = std::move(context);
    out->set_stop(should_stop);
    if (chip) out->context_->apply_variation(*chip);
    auto& system = out->context_->system;
    system.start_transient(factory.times.step > 0 ? factory.times.step : T, factory.times.stop > 0 ? factory.times.stop : 1);
    // Before set_force_input(), after which a FORCE source counts as time-dependent, too.
    for (const auto& d : system.devices()) out->is_time_dependent_ |= d->is_time_dependent();
    system.set_force_input(&out->force_);
    out->solve_rest();
    if (out->is_stopped()) return interrupted_error();  // the operating point is then not that at rest
    auto plan = factory.plan;
    plan.noise.stream = noise_stream_of(chip, copy);
    plan.stop = out->is_time_dependent_ ? stop_time_unshifted : stop_time;
    out->transient_.emplace(system, out->context_->newton, plan);
    (void)out->transient_->begin(out->rest_);  // called only to choose the elimination order
    return out;
}

/// Finds the operating point at 0 N. If the search fails, uses the voltages of .ic: with uic = true, find_initial_condition() solves
/// nothing and cannot fail.
void StreamingTransient::solve_rest() {
    auto found = find_initial_condition(*context_, factory_.times.uic);
    rest_ = found ? std::move(found->x) : find_initial_condition(*context_, true)->x;
    meter_.emplace(context_->system, rest_, context_->tolerances.gmin);
}

void StreamingTransient::set_chip(const ChipSample& chip) {
    context_->apply_variation(chip);
    transient_->set_noise_stream(noise_stream_of(chip));
    force_ = ForceWaveform(force_.T());
    solve_rest();
}

Result<InitialCondition> StreamingTransient::solve_start(std::span<const double> force, std::vector<double> from) {
    force_ = ForceWaveform(force_.T());
    force_.append(force);
    return find_initial_condition(*context_, factory_.times.uic, std::move(from));
}

/// The operating point under this force (N), found by raising the force in steps from 0 N. If a step fails, it is halved. If it becomes too
/// small, returns the operating point under the largest force that was reached.
std::vector<double> StreamingTransient::raise_force_from_rest(double force) {
    constexpr double min_step = 1.0 / 64;  // smallest step, as a fraction of the force
    auto found = rest_;
    for (double fraction = 0, step = 0.25; fraction < 1 && step >= min_step;) {
        const double next = std::min(1.0, fraction + step), steady[] = {next * force, next * force};
        if (auto x = solve_start(steady, found))
            fraction = next, found = std::move(x->x);
        else
            step /= 2;
    }
    return found;
}

Result<void> StreamingTransient::begin(std::span<const double> force) {
    origin_sample_ = 0, pending_spike_.reset(), energy_.power.reset();
    auto x = solve_start(force, rest_);
    if (!x) x = solve_start(force, raise_force_from_rest(force[0]));
    if (!x) {
        auto error = x.error();
        error.message = fmt::format("under the first force, {}: {}", format_quantity(force[0], "N"), error.message);
        return error;
    }
    start_ = std::move(x->x);
    return transient_->begin(start_, x->is_consistent, x->charge);
}

Result<void> StreamingTransient::step() {
    if (is_stopped()) return interrupted_error();
    if (!is_time_dependent_ && transient_->time() > max_time_before_shift) shift_origin();
    if (is_time_dependent_ && transient_->time() >= stop_time_unshifted)
        return error_at({factory_.circuit->file}, "a netlist whose sources depend on time runs for at most {:g} s", stop_time_unshifted);
    const double from = transient_->time();
    if (!energy_.power) energy_.power = meter_->delivered_at(transient_->x(), from);
    const auto stepped = TRY(transient_->step(force_.known_until()));
    if (!stepped)
        return error_at({factory_.circuit->file},
                        "a time step needs force samples that were not given yet");  // cannot happen: delay() is long enough
    energy_.add(*meter_, transient_->x(), from, transient_->time());
    const auto spike = factory_.spike_output.find_spike(*transient_);
    if (!spike) return {};
    // The spike is in the interval (before, before + 1], in samples since the origin.
    const double at = *spike / force_.T(), before = std::ceil(at) - 1;
    pending_spike_ = {origin_sample_ + static_cast<std::int64_t>(before) + 1, at - before, 0};
    return {};
}

/// Moves the origin of time to the last sample before now.
void StreamingTransient::shift_origin() {
    const auto samples = static_cast<std::int64_t>(std::floor(transient_->time() / force_.T()));
    transient_->shift_origin(static_cast<double>(samples) * force_.T());
    force_.shift_origin(samples);
    origin_sample_ += samples;
}

double StreamingTransient::probe_value(const SavedQuantity& saved, std::int64_t sample) const {
    if (sample <= 0) return saved.value(context_->system, [&](int u) { return value_of(start_, u); });
    const double t = time_of(sample);
    return saved.value(context_->system, [&](int u) { return transient_->interpolate(t, u); });
}

OperatingState StreamingTransient::operating_state() const {
    const auto x = transient_->x();
    const auto power = meter_->power_at(x, transient_->time());
    OperatingState out;
    out.time = static_cast<double>(origin_sample_) * force_.T() + transient_->time();
    out.supply = meter_->supply(), out.power = power.supplies, out.sensor = power.sensor;
    const auto names = meter_->sources();
    const auto currents = meter_->source_currents(x, transient_->time());
    for (std::size_t k = 0; k < names.size(); ++k) out.sources.push_back({names[k], power.sources[k], currents[k]});
    const auto& blocks = meter_->blocks().names;
    for (std::size_t k = 0; k < blocks.size(); ++k) out.blocks.push_back({blocks[k], power.blocks[k]});
    for (auto& device : meter_->device_currents(x, transient_->time()))
        out.blocks[device.block].devices.push_back({std::move(device.name), device.current});
    add_nodes(out.blocks);
    return out;
}

/// Adds to each block the nodes inside it and those at the terminals of its elements.
void StreamingTransient::add_nodes(std::vector<OperatingState::Block>& blocks) const {
    const auto& circuit = context_->system.circuit();
    const auto x = transient_->x();
    const auto solved = static_cast<int>(context_->system.nodes());  // node 0 is ground, and those after these have no voltage of their own
    std::vector<std::set<int>> nodes(blocks.size());
    for (std::size_t e = 0; e < circuit.elements.size(); ++e)
        for (const int node : circuit.elements[e].nodes)
            if (node > 0 && node <= solved) nodes[meter_->blocks().block_of_element[e]].insert(node);
    for (int node = 1; node <= solved && node < static_cast<int>(circuit.nodes.size()); ++node) {
        const auto name = Blocks::name_of_node(circuit.nodes[static_cast<std::size_t>(node)]);
        auto at = std::find_if(blocks.begin(), blocks.end(), [&](const auto& block) { return block.name == name; });
        if (at == blocks.end()) at = blocks.insert(at, {name, 0}), nodes.emplace_back();  // all elements outside of subcircuits are sources
        nodes[static_cast<std::size_t>(at - blocks.begin())].insert(node);
    }
    for (std::size_t b = 0; b < blocks.size(); ++b)
        for (const int node : nodes[b])
            blocks[b].nodes.push_back({circuit.nodes[static_cast<std::size_t>(node)], x[static_cast<std::size_t>(node - 1)]});
}

void StreamingTransient::archive(StateArchive& a) {
    auto spike = pending_spike_.value_or(Spike{});
    bool has_spike = pending_spike_.has_value();
    a.integer(origin_sample_, 0, max_exact_integer), a.integer(has_spike, 0, 1);
    a.integer(spike.step, 0, max_exact_integer), a.number(spike.offset);
    pending_spike_ = has_spike ? std::optional(spike) : std::nullopt;
    a.numbers(start_, static_cast<std::size_t>(context_->system.size()));
    if (a.is_reader()) (void)transient_->begin(start_);  // cannot fail: start_ is not solved again
    transient_->archive(a);
    force_.archive(a);
}

void StreamingTransient::save(std::vector<double>& out) {
    force_.discard_before(transient_->time());
    StateArchive writer(out);
    archive(writer);
}

bool StreamingTransient::restore(std::span<const double> in, std::int64_t samples) {
    StateArchive reader(in);
    energy_ = {};
    archive(reader);
    return reader.is_valid && force_.end_sample() + origin_sample_ == samples;
}

}  // namespace corpuscle::circuit
