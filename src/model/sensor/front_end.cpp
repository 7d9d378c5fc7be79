#include "model/sensor/front_end.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace corpuscle {

FrontEnd::FrontEnd(std::vector<FrontEndStage> stages, double F_cal) : stages_(std::move(stages)), F_cal_(F_cal) {
    at_zero_ = read(0).value;
    at_cal_ = read(F_cal_).value;
}

double FrontEnd::apply_hysteresis(double last, double F) const {
    const double h = stages_.empty() ? 0 : stages_.front().hysteresis;
    return F > 0 ? std::min(std::max(last, F), (1 + h) * F) : F;
}

FrontEnd::SensorReading FrontEnd::read(double sensed, double* stage_outputs) const {
    SensorReading r{sensed};
    for (const auto& stage : stages_) {
        r.value = stage.curve(r.value);
        if (r.value > stage.limit) r.value = stage.limit, r.saturated = true;
        if (stage_outputs) *stage_outputs++ = r.value;
    }
    return r;
}

double FrontEnd::inverse(double value, double low, double high) const {
    for (int halving = 0; halving < 64; ++halving) {  // the number of halvings is fixed, so that the result is the same on every machine
        const double middle = 0.5 * (low + high);
        (read(middle).value < value ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

Result<void> FrontEnd::check_range(std::string_view name, double low, std::string_view parameter, double high) const {
    double x = high;
    for (const auto& s : stages_) {
        x = s.curve(x);
        if (x > s.limit)
            return bad_input(fmt::format("{}: at {} = {:g} N {} would be {:.4g} {}, above {} = {:g} {}; lower {} or {}", name, parameter,
                                         high, s.output.name, x, s.output.unit, s.limit_name, s.limit, s.output.unit, s.gain_name,
                                         parameter));
    }
    if (read(high).value > read(low).value) return {};
    return bad_input(
        fmt::format("{}: {} = {:g} N gives the same reading as {:g} N with this sensor; raise {}", name, parameter, high, low, parameter));
}

namespace {

constexpr std::size_t own_values = 1;  // state values before those of the inner afferent: the last force after hysteresis, N

class FrontEndAfferent final : public Afferent {
    FrontEnd front_end_;
    std::unique_ptr<Afferent> inner_;
    std::string name_, inner_format_, format_;
    std::vector<Probe> probes_;  // outputs of the front end's stages, the calibrated force, probes of the inner afferent
    std::size_t inner_values_;   // number of state values of the inner afferent

    /// The calibrated readings of the front end for a block of force, N. Also records the probes of the front end.
    std::vector<double> calibrated_block(std::span<const double> force, State& state, ResponseBlock& response) const {
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

public:
    FrontEndAfferent(FrontEnd front, std::unique_ptr<Afferent> inner) : front_end_(std::move(front)), inner_(std::move(inner)) {
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
    std::span<const Probe> probes() const override { return probes_; }
    State start(ChannelSlot slot) const override {
        auto state = inner_->start(slot);
        state.format = format_;
        state.values.insert(state.values.begin(), own_values, 0.0);
        return state;
    }
    Result<void> respond(std::span<const double> force, State& state, ResponseBlock& response) const override {
        TRY(check_block(name_, format_, own_values + inner_values_, state, force));
        if (force.empty()) return {};
        const auto calibrated = calibrated_block(force, state, response);
        State inner_state{inner_format_, state.step, {state.values.begin() + own_values, state.values.end()}};
        const auto probes = response.probes;
        if (!probes.empty()) response.probes = probes.subspan(front_end_.stages().size() + 1);  // those of the inner afferent
        const auto done = inner_->respond(calibrated, inner_state, response);
        response.probes = probes;
        std::copy(inner_state.values.begin(), inner_state.values.end(), state.values.begin() + own_values);
        state.step = inner_state.step;
        return done;
    }
};

}  // namespace

std::unique_ptr<Afferent> make_behind_front_end(FrontEnd front, std::unique_ptr<Afferent> inner) {
    return std::make_unique<FrontEndAfferent>(std::move(front), std::move(inner));
}

}  // namespace corpuscle
