#pragma once
// A device defines its currents, charges and their derivatives once. All analyses (.op, .dc, .ac, .noise, .tran) use these.

#include <array>
#include <complex>
#include <limits>

#include "circuit/lanes/kernels.hpp"
#include "circuit/netlist/netlist.hpp"
#include "core/checksum.hpp"

namespace corpuscle::circuit {

class ForceWaveform;

/// The value of an unknown; 0 for ground (-1).
template <class Values>
auto value_of(const Values& values, int unknown) {
    using Value = std::decay_t<decltype(values[0])>;
    return unknown < 0 ? Value{} : values[static_cast<std::size_t>(unknown)];
}

/// The conditions under which a device is evaluated.
struct EvalContext {
    double time = 0;           ///< s: time of the sources' waveforms
    double source_scale = 1;   ///< factor of all sources: below 1 during source stepping
    double gmin = 0;           ///< S, in parallel with every junction
    bool with_charges = true;  ///< false: q and dq of the stamp need not be computed
};

/// The contribution of a device to the equations. The unknowns are the terminals, then the device's own unknowns. For a node, f is the
/// current (A) out of the node into the device without the displacement current dq/dt of the charge q (C). An own unknown that is not a
/// node has the equation f + dq/dt = 0. The derivatives df and dq are stored row by row.
struct Stamp {
    std::span<double> f, q, df, dq;
    /// Adds a current i, A, through the device from one unknown to another, or a charge.
    static void add_between(std::span<double> values, std::size_t from, std::size_t to, double i) { values[from] += i, values[to] -= i; }
    /// Adds a conductance g, S, between two unknowns to df, or a capacitance to dq.
    static void add_between_slopes(std::span<double> slopes, std::size_t n, std::size_t a, std::size_t b, double g) {
        slopes[a * n + a] += g, slopes[a * n + b] -= g, slopes[b * n + a] -= g, slopes[b * n + b] += g;
    }
    void add_conductance(std::size_t a, std::size_t b, double g) const { add_between_slopes(df, f.size(), a, b, g); }
    void add_capacitance(std::size_t a, std::size_t b, double c) const { add_between_slopes(dq, f.size(), a, b, c); }
    /// The current v[2] through the device from unknown 0 to unknown 1, and the equation v[0] - v[1] = 0, to which the caller adds.
    void add_branch(std::span<const double> v) const {
        f[0] += v[2], f[1] -= v[2], f[2] += v[0] - v[1];
        slope(0, 2) += 1, slope(1, 2) -= 1, slope(2, 0) += 1, slope(2, 1) -= 1;
    }
    // The derivatives of f[row] and q[row] with respect to the unknown `column`.
    double& slope(std::size_t row, std::size_t column) const { return df[row * f.size() + column]; }
    double& capacitance(std::size_t row, std::size_t column) const { return dq[row * f.size() + column]; }
};

class Device;

/// The memory of the stamp of one device at a time.
class StampBuffer {
    std::vector<double> numbers_;

public:
    // The stamps are valid until the next call.
    Stamp zeros(std::size_t unknowns) {
        const auto n = unknowns;
        numbers_.assign(2 * n + 2 * n * n, 0);
        const std::span all(numbers_);
        return {all.first(n), all.subspan(n, n), all.subspan(2 * n, n * n), all.last(n * n)};
    }
    /// The stamp of a device at v.
    Stamp eval(const Device&, std::span<const double> v, const EvalContext&);
};

/// A noise current between two unknowns of a device: its spectral density, A^2/Hz, at the frequency f in Hz is white + flicker / f.
struct NoiseSource {
    std::string_view mechanism;  ///< "thermal", "shot", "flicker" ...
    std::size_t from, to;        ///< indices into the device's unknowns
    double white = 0;            ///< A^2/Hz
    double flicker = 0;          ///< A^2/Hz at 1 Hz
    bool has_flicker = false;    ///< true if `flicker` is above 0 for some values of the unknowns
};

/// One quantity of a device in the .op table.
struct OperatingValue {
    std::string_view name, unit;
    double value;
};

/// The next change of the state of a device with two states, such as a switch with hysteresis: the state changes when the difference of two
/// of the device's unknowns passes a level.
struct StateChange {
    std::size_t plus;                  ///< index into the device's unknowns
    std::optional<std::size_t> minus;  ///< the same; nothing: 0
    double level;                      ///< V or A
    bool upwards;
    /// How far the difference is beyond the level; negative: it has not passed it.
    double excess(double value_plus, double value_minus) const { return (upwards ? 1 : -1) * (value_plus - value_minus - level); }
};

/// The random process and mismatch sample of one chip. The deviations of each device are computed from (seed, chip, index of the device).
struct ChipSample {
    std::uint64_t seed = 0, chip = 0;  ///< chip: its number among the chips of this seed
    bool has_mismatch = true;          ///< false: all devices have the process deviation only
    std::array<double, 4> process{};   ///< standard normal deviates common to all devices: V_T0 of NMOS, PMOS; I_SQ of NMOS, PMOS
};

/// The number of the noise of a chip among the independent ones of one seed of the noise. `copy`: number of a copy of the nominal circuit.
inline std::uint64_t noise_stream_of(const std::optional<ChipSample>& chip, std::uint64_t copy = 0) {
    if (!chip) return copy;
    Fnv1a hash;
    hash.add_word(chip->seed), hash.add_word(chip->chip);
    return hash.value;
}

/// An element of the circuit. Its unknowns are its terminals, then those that only its equations need, e.g. a branch current.
class Device {
public:
    std::string name;
    SourceLocation location;
    std::vector<int> unknowns;  ///< indices of its unknowns in the system; -1: ground

    virtual ~Device() = default;
    /// Called once, when all devices of the circuit exist; `all` has them by element. A device may keep pointers to others.
    virtual void connect(std::span<const std::unique_ptr<Device>> /*all*/) {}
    /// Writes f, q and their derivatives to a stamp that is zero. v: values of the device's unknowns.
    virtual void eval(std::span<const double> v, const EvalContext&, const Stamp&) const = 0;
    virtual bool is_linear() const { return true; }
    /// True if the currents may be discontinuous in v, as those of an expression with conditions.
    virtual bool has_jumps() const { return false; }

    // A device may have two states, between which its equations change. The state is kept while equations are solved. It changes after an
    // accepted time step at the end of which next_change() has happened, and in the search for an operating point.
    virtual std::optional<StateChange> next_change() const { return {}; }  ///< nothing: the device has no states
    virtual bool state() const { return false; }
    virtual bool initial_state() const { return false; }  ///< at which the search for an operating point begins
    virtual void set_state(bool) {}

    /// Number of values that limit() keeps between Newton iterations.
    virtual std::size_t limiting_state_size() const { return 0; }
    /// True if limit() must be called: it may change the voltages.
    virtual bool limits() const { return limiting_state_size() > 0; }
    /// Limits the Newton step: changes v if it is too far from the voltages of the last evaluation, which `state` holds. Then stores the
    /// voltages of this evaluation in `state`. Returns true if v was changed.
    virtual bool limit(std::span<double> /*v*/, std::span<double> /*state*/) const { return false; }

    /// True if limit() keeps the currents in bounds for any node voltages, so that these need no limit of their own.
    virtual bool bounds_steps() const { return false; }

    /// The value that .dc sweeps: DC value of a source, resistance, gain ... A device without such a value returns false, or nothing.
    virtual bool set_principal_value(double) { return false; }
    virtual std::optional<double> principal_value() const { return {}; }
    /// Adds the source's AC value to the right-hand side of the equations of .ac.
    virtual void add_ac_stimulus(std::span<std::complex<double>>) const {}

    /// Starts the waveform of a source for a transient. `step` and `stop` (s) are those of .tran, from which SPICE takes default times.
    /// With a stop of 0 the source has its DC value again.
    virtual void start_transient(double /*step*/, double /*stop*/) {}
    /// Sets the force waveform of a source with the keyword FORCE; null: 0 N. Returns false for any other device.
    virtual bool set_force_input(const ForceWaveform*) { return false; }
    /// The first time after t (s) at which the source's waveform has a kink or a jump; infinity if there is none.
    virtual double next_breakpoint(double /*t*/) const { return std::numeric_limits<double>::infinity(); }
    /// False if next_breakpoint() is always infinity.
    virtual bool can_have_breakpoints() const { return false; }
    /// The longest time step (s) that resolves the source's waveform between its breakpoints.
    virtual double max_step() const { return std::numeric_limits<double>::infinity(); }
    /// For a linear device: true if its currents depend on time.
    virtual bool is_time_dependent() const { return false; }

    /// Applies the process and mismatch sample of a chip; null: nominal. `index` is the number, from 0, of this device among the devices
    /// with variation. Returns false if this kind of device has no variation.
    virtual bool apply_variation(const ChipSample*, std::uint32_t /*index*/) { return false; }

    // Properties at an operating point; the argument is the v of eval().
    virtual std::vector<NoiseSource> noise(std::span<const double>) const { return {}; }
    virtual std::vector<OperatingValue> operating_info(std::span<const double>) const { return {}; }
    virtual std::string operating_region(std::span<const double>) const { return {}; }  ///< "saturation", "weak" ...
};

/// A device whose principal value may be any number.
class DeviceWithValue : public Device {
protected:
    double value_;

public:
    explicit DeviceWithValue(double value) : value_(value) {}
    bool set_principal_value(double value) override { return value_ = value, true; }
    std::optional<double> principal_value() const override { return value_; }
};

inline Stamp StampBuffer::eval(const Device& device, std::span<const double> v, const EvalContext& context) {
    const auto out = zeros(v.size());
    device.eval(v, context, out);
    return out;
}

using lanes::BatchStamp;

/// Devices of one kind, evaluated together on SIMD lanes. The stride is a multiple of 8. Elements of a row beyond the last device belong to
/// copies of it.
class DeviceBatch {
public:
    virtual ~DeviceBatch() = default;
    /// Copies the devices' constants. Call it again when these have changed, e.g. after apply_variation().
    virtual void bind(std::span<const Device* const>) = 0;
    virtual void eval(const EvalContext&, const BatchStamp&) const = 0;
    /// Extrapolates the charges linearly to unknowns that differ by dv from those of eval(): q += dq dv.
    virtual void extrapolate(std::size_t stride, const double* dv, const double* dq, double* q) const = 0;
};

/// Gives a new device the indices of its unknowns.
class DeviceSetup {
public:
    virtual ~DeviceSetup() = default;
    virtual int node_unknown(int number) const = 0;     ///< unknown of the voltage of Circuit::nodes[number]; -1: ground
    virtual int branch_unknown(int element) const = 0;  ///< unknown of the current through Circuit::elements[element]; -1: there is none
    virtual int branch_unknown(const Element& e) const { return branch_unknown(circuit().find_element(e.name)); }
    virtual int add_unknown(std::string_view name) = 0;    ///< adds the voltage of an inner node, such as "x1.d1#junction"
    virtual double temperature(const Element&) const = 0;  ///< K
    virtual const Circuit& circuit() const = 0;

    /// The unknowns of the first two nodes, then of the current through the element if it has one.
    std::vector<int> ends(const Element& e) const {
        std::vector<int> out = {node_unknown(e.nodes[0]), node_unknown(e.nodes[1])};
        if (const int branch = branch_unknown(e); branch >= 0) out.push_back(branch);
        return out;
    }
};

/// Makes a device of type D with these unknowns.
template <class D, class... Arguments>
std::unique_ptr<Device> make_device(std::vector<int> unknowns, Arguments&&... arguments) {
    auto device = std::make_unique<D>(std::forward<Arguments>(arguments)...);
    device->unknowns = std::move(unknowns);
    return device;
}

}  // namespace corpuscle::circuit
