#include "model/sensor/front_end_afferent.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t own_values = 1;  // state values before those of the inner afferent: the last force after hysteresis, N

}  // namespace

FrontEndAfferent::FrontEndAfferent(FrontEnd front, std::unique_ptr<Afferent> inner)
    : front_end_(std::move(front)), inner_(std::move(inner)) {
    const auto rest = inner_->start({});
    inner_format_ = rest.format;
    inner_values_ = rest.values.size();
    for (const auto& stage : front_end_.stages()) {
        name_ += (name_.empty() ? "" : "+") + std::string(stage.component);
        probes_.push_back(stage.output);
    }
    format_ = name_ + "+" + inner_format_;
    probes_.push_back({"F_read", "N"});
    probes_.insert(probes_.end(), inner_->probes().begin(), inner_->probes().end());
}

State FrontEndAfferent::start(ChannelSlot slot) const {
    auto state = inner_->start(slot);
    state.format = format_;
    state.values.insert(state.values.begin(), own_values, 0.0);
    return state;
}

/// The calibrated readings of the front end for a block of force, N. Also records the probes of the front end.
std::vector<double> FrontEndAfferent::calibrated_block(std::span<const double> force, State& state, ResponseBlock& response) const {
    double& last = state.values[0];
    if (state.step == 0) last = force[0];  // the force before the first sample is assumed to be the same
    std::vector<double> out, stage_outputs(front_end_.stages().size());
    out.reserve(force.size());
    for (const double F : force) {
        const auto sample = out.size();
        last = front_end_.apply_hysteresis(last, F);
        const auto reading = front_end_.read(last, stage_outputs.data());
        response.saturated += reading.saturated;
        if (!response.probes.empty())
            for (std::size_t p = 0; p < stage_outputs.size(); ++p) response.probes[p][sample] = stage_outputs[p];
        out.push_back(front_end_.calibrated_force(reading.value));
        if (!response.probes.empty()) response.probes[stage_outputs.size()][sample] = out.back();
    }
    return out;
}

Result<void> FrontEndAfferent::respond(std::span<const double> force, State& state, ResponseBlock& response) const {
    TRY(check_block(name_, format_, own_values + inner_values_, state, force));
    if (force.empty()) return {};
    const auto calibrated = calibrated_block(force, state, response);
    State inner_state{inner_format_, state.step, {state.values.begin() + own_values, state.values.end()}};
    ResponseBlock inner_response{response.spikes, response.afferent_index};
    if (!response.probes.empty()) inner_response.probes = response.probes.subspan(front_end_.stages().size() + 1);
    const auto done = inner_->respond(calibrated, inner_state, inner_response);
    response.truncated_steps += inner_response.truncated_steps, response.saturated += inner_response.saturated,
        response.overflowed += inner_response.overflowed;
    std::copy(inner_state.values.begin(), inner_state.values.end(), state.values.begin() + own_values);
    state.step = inner_state.step;
    return done;
}

}  // namespace corpuscle
