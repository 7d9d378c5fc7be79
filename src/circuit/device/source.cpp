#include "circuit/device/source.hpp"

#include <algorithm>
#include <iterator>

#include "circuit/afferent/force_waveform.hpp"
#include "circuit/device/expression_binding.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/device/source_waveform.hpp"
#include "core/number/elementary.hpp"

namespace corpuscle::circuit {
namespace {

/// The DC value of an independent source. Without one: v1 of PULSE and EXP, the offset of SIN, the first value of PWL.
double dc_value(const Waveform& w) {
    if (w.has_dc || w.numbers.empty()) return w.dc;
    switch (w.shape) {
        case Waveform::Shape::pulse:
        case Waveform::Shape::exponential:
            return w.numbers[0];
        case Waveform::Shape::sine:
            return w.numbers[0];
        case Waveform::Shape::piecewise_linear:
            return w.numbers.size() > 1 ? w.numbers[1] : 0;
        default:
            return w.dc;
    }
}

/// The AC stimulus as a complex number.
std::complex<double> phasor(const Waveform& w) {
    const double turns = w.ac_phase / 360;
    return {w.ac_magnitude * num::cos_turns(turns), w.ac_magnitude * num::sin_turns(turns)};
}

/// A V or I source. With the keyword FORCE its value is the DC value plus the force (N) times the argument of FORCE (V/N or A/N).
class IndependentSource : public Device {
    Waveform wave_;
    double value_;                            // DC value, V or A
    std::optional<SourceWaveform> waveform_;  // only during a transient
    const ForceWaveform* force_ = nullptr;    // null: no FORCE, or 0 N

    double value_at(double t) const { return waveform_ ? waveform_->at(t) : force_ ? value_ + wave_.numbers[0] * force_->at(t) : value_; }

protected:
    std::complex<double> phasor_;
    double value(const EvalContext& context) const { return context.source_scale * value_at(context.time); }

public:
    explicit IndependentSource(const Waveform& wave) : wave_(wave), value_(dc_value(wave)), phasor_(phasor(wave)) {}
    bool set_principal_value(double value) override { return value_ = value, true; }
    std::optional<double> principal_value() const override { return value_; }
    void start_transient(double step, double stop) override {
        waveform_.reset();
        if (stop > 0 && wave_.shape != Waveform::Shape::none && wave_.shape != Waveform::Shape::force) waveform_.emplace(wave_, step, stop);
    }
    bool set_force_input(const ForceWaveform* force) override {
        const bool has_force = wave_.shape == Waveform::Shape::force;
        if (has_force) force_ = force;
        return has_force;
    }
    double max_step() const override { return waveform_ ? waveform_->max_step() : Device::max_step(); }
    bool is_time_dependent() const override { return waveform_ || force_; }
    double next_breakpoint(double t) const override {
        return waveform_ ? waveform_->next_breakpoint(t) : force_ ? force_->next_breakpoint(t) : Device::next_breakpoint(t);
    }
};

/// v(+) - v(-) = V. Unknowns: two nodes, and the current from the first through the source to the second.
class VoltageSource final : public IndependentSource {
public:
    using IndependentSource::IndependentSource;
    void eval(std::span<const double> v, const EvalContext& context, const Stamp& out) const override {
        out.f[0] += v[2], out.f[1] -= v[2];
        out.slope(0, 2) += 1, out.slope(1, 2) -= 1;
        out.f[2] += v[0] - v[1] - value(context);
        out.slope(2, 0) += 1, out.slope(2, 1) -= 1;
    }
    void add_ac_stimulus(std::span<std::complex<double>> out) const override { out[2] += phasor_; }
};

/// i = I through the source from its first node to the second. Unknowns: two nodes.
class CurrentSource final : public IndependentSource {
    double m_;

public:
    CurrentSource(const Waveform& wave, double m) : IndependentSource(wave), m_(m) {}
    void eval(std::span<const double>, const EvalContext& context, const Stamp& out) const override {
        const double i = value(context) * m_;
        out.f[0] += i, out.f[1] -= i;
    }
    void add_ac_stimulus(std::span<std::complex<double>> out) const override { out[0] -= m_ * phasor_, out[1] += m_ * phasor_; }
};

/// v(+) - v(-) = gain times a voltage (E) or a current (H). Unknowns: two nodes and the current through the source, then from index 3 the
/// two controlling nodes or the controlling current.
class ControlledVoltageSource final : public Device {
    double gain_;

public:
    explicit ControlledVoltageSource(double gain) : gain_(gain) {}
    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        out.f[0] += v[2], out.f[1] -= v[2];
        out.slope(0, 2) += 1, out.slope(1, 2) -= 1;
        out.f[2] += v[0] - v[1] - gain_ * (v[3] - (v.size() > 4 ? v[4] : 0));
        out.slope(2, 0) += 1, out.slope(2, 1) -= 1, out.slope(2, 3) -= gain_;
        if (v.size() > 4) out.slope(2, 4) += gain_;
    }
    bool set_principal_value(double gain) override { return gain_ = gain, true; }
    std::optional<double> principal_value() const override { return gain_; }
};

/// i = gain times a voltage (G) or a current (F). Unknowns: two nodes, then from index 2 the two controlling nodes or the controlling
/// current.
class ControlledCurrentSource final : public Device {
    double gain_;

public:
    explicit ControlledCurrentSource(double gain) : gain_(gain) {}
    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        const double i = gain_ * (v[2] - (v.size() > 3 ? v[3] : 0));
        out.f[0] += i, out.f[1] -= i;
        out.slope(0, 2) += gain_, out.slope(1, 2) -= gain_;
        if (v.size() > 3) out.slope(0, 3) -= gain_, out.slope(1, 3) += gain_;
    }
    bool set_principal_value(double gain) override { return gain_ = gain, true; }
    std::optional<double> principal_value() const override { return gain_; }
};

/// True if an expression contains a comparison, a condition or a rounding function, or if it cannot be written as text.
bool contains_jumps(const Expression& expression) {
    const auto text = expression.text([](const ExpressionInput&) { return std::string("x"); });
    if (!text) return true;
    constexpr std::string_view jumps[] = {"?", "<", ">", "==", "!=", "&&", "||", "sgn(", "u(", "floor(", "ceil(", "int("};
    return std::any_of(std::begin(jumps), std::end(jumps), [&](auto jump) { return text->find(jump) != std::string::npos; });
}

/// i = m times an expression. Unknowns: two nodes, then the other unknowns in the expression.
class ExpressionCurrentSource final : public Device {
    Expression expression_;
    ExpressionBinding binding_;
    double m_;
    bool has_jumps_ = contains_jumps(expression_);

public:
    ExpressionCurrentSource(Expression expression, ExpressionBinding binding, double m)
        : expression_(std::move(expression)), binding_(std::move(binding)), m_(m) {}
    bool is_linear() const override { return false; }
    bool has_jumps() const override { return has_jumps_; }
    void eval(std::span<const double> v, const EvalContext& context, const Stamp& out) const override {
        binding_.eval(expression_, v, context, [&](double i, std::span<const ExpressionBinding::Slope> slopes) {
            out.f[0] += m_ * i * context.source_scale, out.f[1] -= m_ * i * context.source_scale;
            for (const auto& s : slopes) {
                out.slope(0, s.unknown) += m_ * s.value * context.source_scale;
                out.slope(1, s.unknown) -= m_ * s.value * context.source_scale;
            }
        });
    }
};

/// v(+) - v(-) = an expression. Unknowns: two nodes and the current through the source, then the other unknowns in the expression.
class ExpressionVoltageSource final : public Device {
    Expression expression_;
    ExpressionBinding binding_;
    bool has_jumps_ = contains_jumps(expression_);

public:
    ExpressionVoltageSource(Expression expression, ExpressionBinding binding)
        : expression_(std::move(expression)), binding_(std::move(binding)) {}
    bool is_linear() const override { return false; }
    bool has_jumps() const override { return has_jumps_; }
    void eval(std::span<const double> v, const EvalContext& context, const Stamp& out) const override {
        out.f[0] += v[2], out.f[1] -= v[2];
        out.slope(0, 2) += 1, out.slope(1, 2) -= 1;
        binding_.eval(expression_, v, context, [&](double value, std::span<const ExpressionBinding::Slope> slopes) {
            out.f[2] += v[0] - v[1] - value * context.source_scale;
            out.slope(2, 0) += 1, out.slope(2, 1) -= 1;
            for (const auto& s : slopes) out.slope(2, s.unknown) -= s.value * context.source_scale;
        });
    }
};

// Parameters that sources accept. A voltage source ignores m.
constexpr std::string_view source_values[] = {"m", "temp", "dtemp"};

template <class D>
std::unique_ptr<Device> with_unknowns(std::unique_ptr<D> device, std::vector<int> unknowns) {
    device->unknowns = std::move(unknowns);
    return device;
}

}  // namespace

Result<std::unique_ptr<Device>> make_voltage_source(const Element& e, DeviceSetup& setup) {
    TRY(check_value_names(e.name, e.values, source_values, e.location));
    return with_unknowns(std::make_unique<VoltageSource>(e.waveform), {setup.node_unknown(e.nodes[0]), setup.node_unknown(e.nodes[1]),
                                                                       setup.branch_unknown(setup.circuit().find_element(e.name))});
}

Result<std::unique_ptr<Device>> make_current_source(const Element& e, DeviceSetup& setup) {
    TRY(check_value_names(e.name, e.values, source_values, e.location));
    return with_unknowns(std::make_unique<CurrentSource>(e.waveform, value_or(e.values, "m", 1)),
                         {setup.node_unknown(e.nodes[0]), setup.node_unknown(e.nodes[1])});
}

Result<std::unique_ptr<Device>> make_controlled_source(const Element& e, DeviceSetup& setup) {
    if (e.expression) return make_formula_source(e, setup);
    TRY(check_value_names(e.name, e.values, source_values, e.location));
    const bool voltage = e.letter == 'e' || e.letter == 'h', by_current = e.letter == 'f' || e.letter == 'h';
    std::vector<int> unknowns = {setup.node_unknown(e.nodes[0]), setup.node_unknown(e.nodes[1])};
    if (voltage) unknowns.push_back(setup.branch_unknown(setup.circuit().find_element(e.name)));
    if (by_current) {
        const int control = setup.circuit().find_element(e.control_source);
        if (control < 0 || setup.branch_unknown(control) < 0)
            return bad_input(fmt::format("{}: unknown controlling voltage source '{}'", e.name, e.control_source), e.location);
        unknowns.push_back(setup.branch_unknown(control));
    } else {
        unknowns.push_back(setup.node_unknown(e.nodes[2]));
        unknowns.push_back(setup.node_unknown(e.nodes[3]));
    }
    if (voltage) return with_unknowns(std::make_unique<ControlledVoltageSource>(e.value), std::move(unknowns));
    return with_unknowns(std::make_unique<ControlledCurrentSource>(e.value * value_or(e.values, "m", 1)), std::move(unknowns));
}

Result<std::unique_ptr<Device>> make_formula_source(const Element& e, DeviceSetup& setup) {
    TRY(check_value_names(e.name, e.values, source_values, e.location));
    std::vector<int> own = {setup.node_unknown(e.nodes[0]), setup.node_unknown(e.nodes[1])};
    if (e.expression_is_voltage) own.push_back(setup.branch_unknown(setup.circuit().find_element(e.name)));
    auto binding = TRY(ExpressionBinding::make(*e.expression, e, setup, std::move(own)));
    auto unknowns = binding.unknowns();
    if (e.expression_is_voltage)
        return with_unknowns(std::make_unique<ExpressionVoltageSource>(*e.expression, std::move(binding)), std::move(unknowns));
    return with_unknowns(std::make_unique<ExpressionCurrentSource>(*e.expression, std::move(binding), value_or(e.values, "m", 1)),
                         std::move(unknowns));
}

}  // namespace corpuscle::circuit
