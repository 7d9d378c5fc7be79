#pragma once
// The equations of a circuit: f(x) + dq(x)/dt = 0, where x holds the unknowns: node voltages (V) and branch currents (A).

#include <numeric>

#include "circuit/device/device.hpp"
#include "circuit/solve/linear/matrix.hpp"

namespace corpuscle::circuit {

/// The sum of all devices' contributions at one x.
struct SystemEvaluation {
    std::vector<double> f, q;      ///< by equation
    std::vector<double> G, C;      ///< derivatives of f and q, by entry of the sparsity pattern; then one element for ground
    std::vector<double> scale;     ///< largest contribution of a single device to each equation, the scale for a relative tolerance
    std::vector<double> roundoff;  ///< rounding error of each equation, from the rounding of x and of the devices' sums
    bool is_limited = false;       ///< some device was evaluated at limited voltages; its contribution is extrapolated linearly to x

private:
    friend class System;
    struct alignas(64) CacheLine {
        double values[8];
    };
    std::vector<double> v_, limited_v_;  // buffers of add_device()
    StampBuffer stamp_;
    std::vector<CacheLine> batch_buffer_;  // buffer of add_group()
};

/// The sums of the linear devices that do not depend on time, and of the derivatives of all linear devices.
struct LinearSums {
    std::vector<double> currents;  ///< f at x = 0, by equation; the last element is for ground
    std::vector<double> G, C;      ///< as in SystemEvaluation
};

/// Devices of one kind that are evaluated together.
struct DeviceGroup {
    std::unique_ptr<DeviceBatch> batch;
    std::vector<const Device*> members;
    std::size_t terminals;             ///< of each member; all its unknowns are terminals
    std::size_t stride;                ///< number of members, rounded up to a multiple of 8
    std::vector<int> unknowns;         ///< [member][terminal]; -1: ground
    std::vector<std::size_t> entries;  ///< [member][terminal^2]: matrix entry of each derivative; for ground the number of entries
};

/// The unknowns, devices and sparsity pattern of a circuit.
class System {
    std::shared_ptr<const Circuit> circuit_;
    std::vector<std::string> names_;                     // of the unknowns
    std::unordered_map<std::string_view, int> numbers_;  // of the unknowns, by name
    std::vector<char> is_voltage_;                       // by unknown
    std::vector<std::unique_ptr<Device>> devices_;       // one for each element of the circuit, in the same order
    std::vector<std::size_t> limiting_state_offset_;     // by device
    std::size_t limiting_state_size_ = 0;
    std::unique_ptr<SparsityPattern> pattern_;
    std::vector<std::size_t> entries_, first_entry_;  // matrix entry of each derivative of all devices; the first one of each device
    std::vector<DeviceGroup> groups_;
    std::vector<std::size_t> scalar_devices_;                                  // indices of the devices in no group
    std::vector<std::size_t> devices_with_states_, devices_with_breakpoints_;  // their indices
    int nodes_ = 0;
    bool is_linear_ = true;

    class Builder;
    Result<void> make_groups();
    void add_device(std::size_t k, std::span<const double> x, const EvalContext&, std::vector<double>& limiting_state,
                    SystemEvaluation&) const;
    void add_group(const DeviceGroup&, std::span<const double> x, const EvalContext&, SystemEvaluation&) const;

public:
    /// Errors: circuits without a unique solution (floating nodes, loops of voltage sources), wrong parameters.
    static Result<System> make(std::shared_ptr<const Circuit>);

    const Circuit& circuit() const { return *circuit_; }
    int size() const { return static_cast<int>(names_.size()); }  ///< number of unknowns
    int nodes() const { return nodes_; }                          ///< nodes of the circuit without ground; their voltages come first
    /// True for a node voltage, also of ground (-1) and of a node that a device has added; false for a branch current.
    bool is_voltage(int unknown) const { return unknown < 0 || is_voltage_[static_cast<std::size_t>(unknown)] != 0; }
    const std::vector<std::string>& names() const { return names_; }  ///< "v(out)", "i(v1)"
    int unknown(std::string_view name) const;                         ///< -1: no unknown has this name
    const SparsityPattern& pattern() const { return *pattern_; }
    const std::vector<std::unique_ptr<Device>>& devices() const { return devices_; }
    Device* device(std::string_view name) const;  ///< null: no device has this name
    std::span<const DeviceGroup> groups() const { return groups_; }
    std::span<const std::size_t> scalar_devices() const { return scalar_devices_; }  ///< indices of the devices in no group
    /// Matrix entry of each derivative of a device, row by row; for ground the number of entries of the pattern.
    std::span<const std::size_t> entries(std::size_t device) const {
        const auto terminals = devices_[device]->unknowns.size();
        return std::span(entries_).subspan(first_entry_[device], terminals * terminals);
    }
    /// The part of a limiting state that belongs to a device.
    std::span<double> limiting_state_of(std::size_t device, std::vector<double>& state) const {
        return std::span(state).subspan(limiting_state_offset_[device], devices_[device]->limiting_state_size());
    }
    bool is_linear() const { return is_linear_; }  ///< true if all devices are linear
    /// Zeros, for the values that Device::limit() of all devices keeps between Newton iterations.
    std::vector<double> initial_limiting_state() const { return std::vector<double>(limiting_state_size_); }

    std::span<const std::size_t> devices_with_states() const { return devices_with_states_; }  ///< their indices
    /// The states of these devices. They belong to the devices, so the functions that change them are const.
    std::vector<char> states() const;
    void set_states(std::span<const char>) const;
    void reset_states() const;  ///< to the initial states
    /// How far the control of a device with states is beyond the level at which its state changes, at x.
    double excess(std::size_t device, std::span<const double> x) const;
    /// Changes the state of each device whose control is beyond its level at x, or of the first one only. Returns the last device whose
    /// state was changed; null: none.
    const Device* change_states(std::span<const double> x, bool first_only = false) const;

    /// Evaluates all devices at x and sums their contributions. Updates the limiting state.
    void eval(std::span<const double> x, const EvalContext&, std::vector<double>& limiting_state, SystemEvaluation&) const;
    // These call the function of the same name of all devices; next_breakpoint() and max_step() return the smallest result.
    void start_transient(double step, double stop);
    double next_breakpoint(double t) const;
    double max_step() const;
    bool set_force_input(const ForceWaveform*);  ///< returns true if a source has a force input
    /// Applies the process and mismatch sample of a chip to all devices; null: nominal.
    void apply_variation(const ChipSample*);
    /// The values of a device's unknowns at x.
    std::vector<double> terminal_values(const Device&, std::span<const double> x) const;
};

LinearSums sum_linear_devices(const System&, const EvalContext&);

/// Rejects nodes without a DC path to ground (floating, or connected by current sources only) and loops of elements that fix voltages.
Result<void> check_solvable(const Circuit&);

}  // namespace corpuscle::circuit
