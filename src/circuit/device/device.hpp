#pragma once
// A device defines its currents, charges and their derivatives once. All analyses (.op, .dc, .ac, .noise, .tran) use these.

#include <complex>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "circuit/netlist/netlist.hpp"
#include "signal/error.hpp"

namespace corpuscle::circuit {

class ForceWaveform;

/// The conditions under which a device is evaluated.
struct EvalContext {
    double time = 0;           ///< s
    double source_scale = 1;   ///< factor of all sources: below 1 during source stepping
    double gmin = 0;           ///< S, in parallel with every junction
    bool with_charges = true;  ///< false: q and dq need not be evaluated
};

/// The contribution of a device to the equations. The unknowns are the terminals, then the device's own unknowns. For a node, f is the
/// current (A) out of the node into the device without the displacement current dq/dt of the charge q (C). An own unknown that is not a
/// node has the equation f + dq/dt = 0. The derivatives df and dq are stored row by row. With n unknowns, f and q have n elements, df and
/// dq have n^2; most callers allocate them in this order in one buffer.
struct Stamp {
    std::span<double> f, q, df, dq;
    double& slope(std::size_t row, std::size_t column) const { return df[row * f.size() + column]; }
    double& capacitance(std::size_t row, std::size_t column) const { return dq[row * f.size() + column]; }
};

/// A noise current between two unknowns of a device: its spectral density, A^2/Hz, is white + flicker / f.
struct NoiseSource {
    std::string_view mechanism;  ///< "thermal", "shot", "flicker" ...
    std::size_t from, to;        ///< indices into the device's unknowns
    double white = 0, flicker = 0;
};

/// One quantity of a device in the .op table.
struct OperatingValue {
    std::string_view name, unit;
    double value;
};

/// The random process and mismatch sample of one chip, a function of (seed, chip).
struct ChipSample {
    std::uint64_t seed = 0, chip = 0;
    bool has_mismatch = true;  ///< each device has its own deviation
    double process[4] = {};    ///< normal deviates common to all devices: V_T0 of NMOS and PMOS, then I_SQ of NMOS and PMOS
};

class Device {
public:
    std::string name;
    SourceLocation location;
    std::vector<int> unknowns;  ///< indices in the system; -1: ground

    virtual ~Device() = default;
    /// Writes f, q and their derivatives to a stamp that is zero. v: values of the device's unknowns.
    virtual void eval(std::span<const double> v, const EvalContext&, const Stamp&) const = 0;
    virtual bool is_linear() const { return true; }
    /// True if the currents may be discontinuous in v, as those of an expression with conditions.
    virtual bool has_jumps() const { return false; }

    /// Number of values that limit() keeps between Newton iterations.
    virtual std::size_t limiting_state_size() const { return 0; }
    /// Limits the Newton step: changes v if it is too far from the last evaluation, which `state` holds. Returns true if v was changed.
    virtual bool limit(std::span<double> /*v*/, std::span<double> /*state*/) const { return false; }

    /// The value that .dc sweeps: DC value of a source, resistance, gain ... Returns false (or nothing) if the device has none.
    virtual bool set_principal_value(double) { return false; }
    virtual std::optional<double> principal_value() const { return {}; }
    /// Adds the source's AC value to the right-hand side of the equations of .ac.
    virtual void add_ac_stimulus(std::span<std::complex<double>>) const {}

    /// Starts a transient with this step and end (s). An end of 0 freezes the source at its DC value again.
    virtual void start_transient(double /*step*/, double /*stop*/) {}
    /// Sets the force waveform of a source with the keyword FORCE; null: 0 N. Returns false for any other device.
    virtual bool set_force_input(const ForceWaveform*) { return false; }
    /// The first time after t (s) at which the waveform has a kink or a jump.
    virtual double next_breakpoint(double /*t*/) const { return std::numeric_limits<double>::infinity(); }
    /// The longest step (s) that resolves the waveform between its breakpoints.
    virtual double max_step() const { return std::numeric_limits<double>::infinity(); }
    /// For a linear device: true if its currents depend on time.
    virtual bool is_time_dependent() const { return false; }

    /// Applies the process and mismatch sample of a chip; null: nominal. `index` counts the devices that have variation. Returns false if
    /// this kind of device has none.
    virtual bool apply_variation(const ChipSample*, std::uint32_t /*index*/) { return false; }

    // Properties at an operating point; the argument is v as in eval().
    virtual std::vector<NoiseSource> noise(std::span<const double>) const { return {}; }
    virtual std::vector<OperatingValue> operating_info(std::span<const double>) const { return {}; }
    virtual std::string operating_region(std::span<const double>) const { return {}; }  ///< "saturation", "weak" ...
};

/// The stamps of several devices of one kind: rows of `stride` numbers, one for each device, aligned to 64 bytes. Otherwise as Stamp.
struct BatchStamp {
    std::size_t stride;
    const double* v;
    double *f, *df;
    double* max_term;  ///< largest term of each f, the scale of its rounding error; null: not needed
    double *q, *dq;    ///< null: not needed
    double rate = 0;   ///< 1/s: f and df are returned with rate times q and dq added
};

/// Devices of one kind, evaluated together on SIMD lanes. The stride is a multiple of 8; copies of the last device fill the rest.
class DeviceBatch {
public:
    virtual ~DeviceBatch() = default;
    virtual void bind(std::span<const Device* const>) = 0;  ///< copies the devices' constants; call again when they have changed
    virtual void eval(const EvalContext&, const BatchStamp&) const = 0;
    /// Extrapolates the charges linearly: q += dq dv.
    virtual void extrapolate(std::size_t stride, const double* dv, const double* dq, double* q) const = 0;
};

/// Gives a new device the indices of its unknowns.
class DeviceSetup {
public:
    virtual ~DeviceSetup() = default;
    virtual int node_unknown(int number) const = 0;        ///< unknown of a node's voltage
    virtual int branch_unknown(int element) const = 0;     ///< unknown of the current through an element; -1: none
    virtual int add_unknown(std::string_view name) = 0;    ///< adds an unknown, e.g. "x1.d1#anode"
    virtual double temperature(const Element&) const = 0;  ///< K
    virtual const Circuit& circuit() const = 0;
};

}  // namespace corpuscle::circuit
