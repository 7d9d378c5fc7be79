#include "model/sensor/fronted.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t own_values = 1;  // the force last felt, N; the inner afferent's follow

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

State Fronted::start(Turn turn) const {
    auto state = inner_->start(turn);
    state.format = format_;
    state.values.insert(state.values.begin(), own_values, 0.0);
    return state;
}

/// The block of force as the calibration has it; fills the front's probes.
std::vector<double> Fronted::believed(std::span<const double> force, State& state, Answer& answer) const {
    double& held = state.values[0];
    if (state.step == 0) held = force[0];
    std::vector<double> out, shown(front_.stages().size());
    out.reserve(force.size());
    for (const double F : force) {
        held = front_.played(held, F);
        const auto reading = front_.read(held, shown.data());
        answer.clipped += reading.clipped;
        if (!answer.probes.empty())
            for (std::size_t p = 0; p < shown.size(); ++p) answer.probes[p][out.size()] = shown[p];
        out.push_back(front_.believed(reading.value));
        if (!answer.probes.empty()) answer.probes[shown.size()][out.size() - 1] = out.back();
    }
    return out;
}

Result<void> Fronted::respond(std::span<const double> force, State& state, Answer& answer) const {
    if (auto ok = check_block(name_, format_, own_values + inner_values_, state, force); !ok) return ok;
    if (force.empty()) return {};
    const auto felt = believed(force, state, answer);
    State inside{inner_format_, state.step, {state.values.begin() + own_values, state.values.end()}};
    Answer said{answer.spikes, answer.unit};
    if (!answer.probes.empty()) said.probes = answer.probes.subspan(front_.stages().size() + 1);
    const auto done = inner_->respond(felt, inside, said);
    answer.capped += said.capped, answer.clipped += said.clipped, answer.overflowed += said.overflowed;
    std::copy(inside.values.begin(), inside.values.end(), state.values.begin() + own_values);
    state.step = inside.step;
    return done;
}

}  // namespace corpuscle
