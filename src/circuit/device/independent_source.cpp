// Independent sources: V and I.

#include "circuit/afferent/force_waveform.hpp"
#include "circuit/device/device_kind.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/device/source_waveform.hpp"
#include "circuit/export/element_text.hpp"
#include "circuit/netlist/element_reader.hpp"
#include "core/random.hpp"

namespace corpuscle::circuit {
namespace {

/// The DC value of an independent source. Without one: v1 of PULSE and EXP, the offset of SIN, the first value of PWL.
double dc_value(const Waveform& w) {
    if (w.has_dc || w.numbers.empty()) return w.dc;
    if (w.shape == Waveform::Shape::piecewise_linear) return w.numbers.size() > 1 ? w.numbers[1] : 0;
    if (w.shape == Waveform::Shape::amplitude_modulated || w.shape == Waveform::Shape::noise) return 0;
    return w.shape == Waveform::Shape::force ? w.dc : w.numbers[0];
}

/// The AC stimulus as a complex number.
std::complex<double> phasor(const Waveform& w) {
    const double turns = w.ac_phase / 360;
    return {w.ac_magnitude * num::cos_turns(turns), w.ac_magnitude * num::sin_turns(turns)};
}

/// A V or I source. With the keyword FORCE its value is the DC value plus the force (N) times the argument of FORCE (V/N or A/N).
class IndependentSource : public DeviceWithValue {
    Waveform wave_;
    std::uint64_t seed_;                      // of TRNOISE
    std::optional<SourceWaveform> waveform_;  // only during a transient
    const ForceWaveform* force_ = nullptr;    // null: no FORCE, or 0 N

    double value_at(double t) const { return waveform_ ? waveform_->at(t) : force_ ? value_ + wave_.numbers[0] * force_->at(t) : value_; }

protected:
    std::complex<double> phasor_;
    double value(const EvalContext& context) const { return context.source_scale * value_at(context.time); }

public:
    IndependentSource(const Waveform& wave, std::uint64_t seed)
        : DeviceWithValue(dc_value(wave)), wave_(wave), seed_(seed), phasor_(phasor(wave)) {}
    void start_transient(double step, double stop) override {
        waveform_.reset();
        if (stop > 0 && wave_.shape != Waveform::Shape::none && wave_.shape != Waveform::Shape::force)
            waveform_.emplace(wave_, step, stop, seed_);
    }
    bool set_force_input(const ForceWaveform* force) override {
        const bool has_force = wave_.shape == Waveform::Shape::force;
        if (has_force) force_ = force;
        return has_force;
    }
    double max_step() const override { return waveform_ ? waveform_->max_step() : Device::max_step(); }
    bool is_time_dependent() const override { return waveform_ || force_; }
    bool can_have_breakpoints() const override { return true; }
    double next_breakpoint(double t) const override {
        return waveform_ ? waveform_->next_breakpoint(t) : force_ ? force_->next_breakpoint(t) : Device::next_breakpoint(t);
    }
};

/// v(+) - v(-) = V. Unknowns: two nodes, and the current from the first through the source to the second.
class VoltageSource final : public IndependentSource {
public:
    using IndependentSource::IndependentSource;
    void eval(std::span<const double> v, const EvalContext& context, const Stamp& out) const override {
        out.add_branch(v);
        out.f[2] -= value(context);
    }
    void add_ac_stimulus(std::span<std::complex<double>> out) const override { out[2] += phasor_; }
};

/// i = I through the source from its first node to the second. Unknowns: two nodes.
class CurrentSource final : public IndependentSource {
    double m_;

public:
    CurrentSource(const Waveform& wave, std::uint64_t seed, double m) : IndependentSource(wave, seed), m_(m) {}
    void eval(std::span<const double>, const EvalContext& context, const Stamp& out) const override {
        Stamp::add_between(out.f, 0, 1, value(context) * m_);
    }
    void add_ac_stimulus(std::span<std::complex<double>> out) const override { out[0] -= m_ * phasor_, out[1] += m_ * phasor_; }
};

/// The seed of a source's TRNOISE: sources of different names have independent noise.
std::uint64_t noise_seed(const Element& e, const DeviceSetup& setup) {
    return stream_id(e.name) + static_cast<std::uint64_t>(value_or(setup.circuit().options, "noiseseed", 1));
}

Result<std::unique_ptr<Device>> make_voltage_source(const Element& e, DeviceSetup& setup) {
    return make_device<VoltageSource>(setup.ends(e), e.waveform, noise_seed(e, setup));
}

Result<std::unique_ptr<Device>> make_current_source(const Element& e, DeviceSetup& setup) {
    return make_device<CurrentSource>(setup.ends(e), e.waveform, noise_seed(e, setup), value_or(e.values, "m", 1));
}

Result<void> read_independent_source(ElementReader& line) {
    TRY(line.nodes(2, "plus and minus"));
    return read_waveform(line);
}

std::string_view shape_name(Waveform::Shape shape) {
    return std::find_if(std::begin(waveform_syntaxes), std::end(waveform_syntaxes), [&](const auto& s) { return s.shape == shape; })->name;
}

Result<std::string> write_independent_source(const ElementExport& e) {
    const Waveform& w = e.element.waveform;
    if (w.shape == Waveform::Shape::sine && w.numbers.size() > 6 && w.numbers[6] > 0)
        return error_at(e.element.location, "{}: ngspice's sin has no number of cycles, so it cannot be exported", e.element.name);
    const bool force = w.shape == Waveform::Shape::force, has_shape = w.shape != Waveform::Shape::none && !force;
    // In ngspice the DC value of a sine with a phase depends on the phase. In Corpuscle it is the offset, so the offset is written as dc.
    const bool has_phase = w.shape == Waveform::Shape::sine && w.numbers.size() > 5;
    std::string out = e.head;
    if (w.has_dc || !has_shape || has_phase) out += fmt::format(" dc {}", w.has_dc || !has_phase ? w.dc : w.numbers[0]);
    if (w.ac_magnitude != 0 || w.ac_phase != 0) out += fmt::format(" ac {} {}", w.ac_magnitude, w.ac_phase);
    if (has_shape) out += fmt::format(" {}({:})", shape_name(w.shape), fmt::join(w.numbers, " "));
    if (w.repeats_from) out += fmt::format(" r={}", *w.repeats_from);
    if (e.element.letter == 'i' && e.value("m", 1) != 1) out += fmt::format(" m={}", e.value("m", 1));
    if (!force) return out + '\n';
    const auto points = TRY(pwl_force(e.circuit, w.numbers.empty() ? 1 : w.numbers[0]));
    if (points.empty()) return fmt::format("* {} is a FORCE source in Corpuscle; here it is constant\n{}\n", e.element.name, out);
    return fmt::format("* {}: the force of .force, piecewise linear\n{} {}\n", e.element.name, out, points);
}

constexpr ElementParameter voltage_parameters[] = {{.name = "dc", .unit = "V", .is_value = true}};
constexpr ElementParameter current_parameters[] = {{.name = "dc", .unit = "A", .is_value = true}};
constexpr std::string_view voltage_source_names[] = {"ac", "td", "r", "rser", "cpar"}, current_source_names[] = {"ac", "td", "r", "m"};

}  // namespace

extern constexpr DeviceKind voltage_source_kind = {.letter = 'v',
                                                   .description = "voltage source",
                                                   .role = Role::voltage_source,
                                                   .read = read_independent_source,
                                                   .make = make_voltage_source,
                                                   .parameters = voltage_parameters,
                                                   .other_names = voltage_source_names,
                                                   .has_branch_current = always,
                                                   .multiply = keep_value,
                                                   .area = no_area,
                                                   .write_spice = write_independent_source};

extern constexpr DeviceKind current_source_kind = {.letter = 'i',
                                                   .description = "current source",
                                                   .role = Role::current_source,
                                                   .read = read_independent_source,
                                                   .make = make_current_source,
                                                   .parameters = current_parameters,
                                                   .other_names = current_source_names,
                                                   .conducting_nodes = no_nodes,
                                                   .area = no_area,
                                                   .write_spice = write_independent_source};

}  // namespace corpuscle::circuit
