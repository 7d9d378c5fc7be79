#include "model/sensor/fronted.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t own_values = 1;  // the last force after hysteresis, N; the values of the inner afferent follow

}  // namespace

Fronted::Fronted(Front front, std::unique_ptr<Afferent> inner) : front_(std::move(front)), inner_(std::move(inner)) {
    const auto rest = inner_->start({});
    inner_format_ = rest.format;
    inner_values_ = rest.values.size();
    for (const auto& stage : front_.stages()) {
        name_ += (name_.empty() ? "" : "+") + std::string(stage.part);
        probes_.push_back(stage.shows);
    }
    format_ = name_ + "+" + inner_format_;
    probes_.push_back({"F_read", "N"});
    probes_.insert(probes_.end(), inner_->probes().begin(), inner_->probes().end());
}

State Fronted::start(ChannelSlot slot) const {
    auto state = inner_->start(slot);
    state.format = format_;
    state.values.insert(state.values.begin(), own_values, 0.0);
    return state;
}

/// The block of force as the calibration reads it; records the probes of the front end.
std::vector<double> Fronted::believed(std::span<const double> force, State& state, ResponseBlock& response) const {
    double& last = state.values[0];
    if (state.step == 0) last = force[0];
    std::vector<double> out, shown(front_.stages().size());
    out.reserve(force.size());
    for (const double F : force) {
        last = front_.played(last, F);
        const auto reading = front_.read(last, shown.data());
        response.saturated += reading.clipped;
        if (!response.probes.empty())
            for (std::size_t p = 0; p < shown.size(); ++p) response.probes[p][out.size()] = shown[p];
        out.push_back(front_.believed(reading.value));
        if (!response.probes.empty()) response.probes[shown.size()][out.size() - 1] = out.back();
    }
    return out;
}

Result<void> Fronted::respond(std::span<const double> force, State& state, ResponseBlock& response) const {
    if (auto ok = check_block(name_, format_, own_values + inner_values_, state, force); !ok) return ok;
    if (force.empty()) return {};
    const auto calibrated = believed(force, state, response);
    State inside{inner_format_, state.step, {state.values.begin() + own_values, state.values.end()}};
    ResponseBlock inner_response{response.spikes, response.afferent_index};
    if (!response.probes.empty()) inner_response.probes = response.probes.subspan(front_.stages().size() + 1);
    const auto done = inner_->respond(calibrated, inside, inner_response);
    response.truncated_steps += inner_response.truncated_steps, response.saturated += inner_response.saturated, response.overflowed += inner_response.overflowed;
    std::copy(inside.values.begin(), inside.values.end(), state.values.begin() + own_values);
    state.step = inside.step;
    return done;
}

}  // namespace corpuscle
