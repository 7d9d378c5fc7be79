#pragma once
// The equations of a circuit: f(x) + dq(x)/dt = 0, where x holds node voltages (V) and branch currents (A).

#include <memory>
#include <string>
#include <vector>

#include "circuit/device/device.hpp"
#include "circuit/solve/matrix.hpp"

namespace corpuscle::circuit {

/// The sum of all devices' contributions at one x.
struct Sums {
    std::vector<double> f, q;   ///< by equation
    std::vector<double> G, C;   ///< derivatives of f and q, by entry of the sparsity pattern
    std::vector<double> size;   ///< largest single contribution to each equation, the scale for a relative tolerance
    std::vector<double> grain;  ///< rounding error of each equation, from the rounding of x and of the devices' sums
    bool limited = false;       ///< a device was evaluated at limited voltages; its part of f is extrapolated linearly to x

private:
    friend class System;
    struct alignas(64) Line {
        double of[8];
    };
    std::vector<double> v_, looked_, own_;  // buffers of add_device()
    std::vector<Line> side_by_side_;        // buffer of add_group()
};

/// Devices of one kind that are evaluated together.
struct Group {
    std::unique_ptr<Bank> bank;
    std::vector<const Device*> members;
    std::size_t terminals, room;
    std::vector<int> unknowns;        ///< [member][terminal]
    std::vector<std::size_t> places;  ///< [member][terminal^2]: matrix entry of each derivative; past the end of the pattern: ground
};

class System {
    std::shared_ptr<const Circuit> circuit_;
    std::vector<std::string> names_;
    std::vector<std::unique_ptr<Device>> devices_;
    std::vector<std::size_t> memory_at_;
    std::size_t memory_ = 0;
    std::unique_ptr<Pattern> pattern_;
    std::vector<std::vector<std::size_t>> places_;  // matrix entry of each device's derivatives; past the end of the pattern: ground
    std::vector<Group> groups_;
    std::vector<std::size_t> alone_;  // devices in no group
    int nodes_ = 0;
    bool linear_ = true;

    class Maker;
    Result<void> make_groups();
    void add_device(std::size_t k, std::span<const double> x, const Instant&, std::vector<double>& limiting_state, Sums&) const;
    void add_group(const Group&, std::span<const double> x, const Instant&, Sums&) const;

public:
    /// Errors: circuits without a unique solution (floating nodes, loops of voltage sources), wrong parameters.
    static Result<System> make(std::shared_ptr<const Circuit>);

    const Circuit& circuit() const { return *circuit_; }
    int size() const { return static_cast<int>(names_.size()); }
    int nodes() const { return nodes_; }  ///< number of node voltages, which are the first unknowns
    bool is_voltage(int unknown) const { return names_[static_cast<std::size_t>(unknown)][0] == 'v'; }
    const std::vector<std::string>& names() const { return names_; }  ///< "v(out)", "i(v1)"
    int unknown(std::string_view name) const;                         ///< -1: no unknown has this name
    const Pattern& pattern() const { return *pattern_; }
    const std::vector<std::unique_ptr<Device>>& devices() const { return devices_; }
    Device* device(std::string_view name) const;  ///< null: no device has this name
    std::span<const Group> groups() const { return groups_; }
    std::span<const std::size_t> alone() const { return alone_; }  ///< devices in no group
    std::span<const std::size_t> places(std::size_t device) const { return places_[device]; }
    /// The part of a limiting state that belongs to a device.
    std::span<double> memory_of(std::size_t device, std::vector<double>& state) const {
        return std::span(state).subspan(memory_at_[device], devices_[device]->memory());
    }
    bool linear() const { return linear_; }
    std::vector<double> fresh_memory() const { return std::vector<double>(memory_); }

    void eval(std::span<const double> x, const Instant&, std::vector<double>& limiting_state, Sums&) const;
    // The same functions of all devices; see Device.
    void go(double step, double stop);
    double next_corner(double t) const;
    double pace() const;
    bool hear(const ForceWaveform*);  ///< returns true if a source has a force input
    /// Applies the process and mismatch sample of a chip to all devices; null: nominal.
    void draw(const Draw*);
    /// The values of a device's unknowns at x.
    std::vector<double> terminals(const Device&, std::span<const double> x) const;
};

}  // namespace corpuscle::circuit
