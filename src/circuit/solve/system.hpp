#pragma once
// A circuit as equations: f(x) + dq(x)/dt = 0, x the nodes' voltages and the branches' currents.

#include <memory>
#include <string>
#include <vector>

#include "circuit/device/device.hpp"
#include "circuit/solve/matrix.hpp"

namespace corpuscle::circuit {

/// What all devices add up to at one x.
struct Sums {
    std::vector<double> f, q;   ///< of each unknown's equation
    std::vector<double> G, C;   ///< slopes of f and q, in the pattern's places
    std::vector<double> size;   ///< the largest single contribution to each equation: what it is small against
    std::vector<double> grain;  ///< what rounding of x and of devices' sums may leave of it
    bool limited = false;       ///< some device was looked at elsewhere than at x: f is what its straight line gives at x

private:
    friend class System;
    struct alignas(64) Line {
        double of[8];
    };
    std::vector<double> v_, looked_, own_;  // of the device at work
    std::vector<Line> side_by_side_;        // of those at work together
};

/// Devices of one kind, looked at together.
struct Group {
    std::unique_ptr<Bank> bank;
    std::vector<const Device*> members;
    std::size_t terminals, room;
    std::vector<int> unknowns;        ///< of each member, one after another
    std::vector<std::size_t> places;  ///< of each member's slopes; beyond the pattern: of ground, nowhere
};

class System {
    std::shared_ptr<const Circuit> circuit_;
    std::vector<std::string> names_;
    std::vector<std::unique_ptr<Device>> devices_;
    std::vector<std::size_t> memory_at_;
    std::size_t memory_ = 0;
    std::unique_ptr<Pattern> pattern_;
    std::vector<std::vector<std::size_t>> places_;  // of each device's slopes; beyond the pattern: of ground, nowhere
    std::vector<Group> groups_;
    std::vector<std::size_t> alone_;  // devices without one
    int nodes_ = 0;
    bool linear_ = true;

    class Maker;
    Result<void> make_groups();
    void add_device(std::size_t k, std::span<const double> x, const Instant&, std::vector<double>& memory, Sums&) const;
    void add_group(const Group&, std::span<const double> x, const Instant&, Sums&) const;

public:
    /// Refuses what cannot have an answer: floating nodes, loops of voltage sources, missing models.
    static Result<System> make(std::shared_ptr<const Circuit>);

    const Circuit& circuit() const { return *circuit_; }
    int size() const { return static_cast<int>(names_.size()); }
    int nodes() const { return nodes_; }  ///< the first unknowns are nodes' voltages
    bool is_voltage(int unknown) const { return names_[static_cast<std::size_t>(unknown)][0] == 'v'; }
    const std::vector<std::string>& names() const { return names_; }  ///< "v(out)", "i(v1)"
    int unknown(std::string_view name) const;                         ///< -1: none of this name
    const Pattern& pattern() const { return *pattern_; }
    const std::vector<std::unique_ptr<Device>>& devices() const { return devices_; }
    Device* device(std::string_view name) const;  ///< null: none of this name
    std::span<const Group> groups() const { return groups_; }
    std::span<const std::size_t> alone() const { return alone_; }  ///< devices in no group
    std::span<const std::size_t> places(std::size_t device) const { return places_[device]; }
    /// A device's part of a memory.
    std::span<double> memory_of(std::size_t device, std::vector<double>& memory) const {
        return std::span(memory).subspan(memory_at_[device], devices_[device]->memory());
    }
    bool linear() const { return linear_; }
    std::vector<double> fresh_memory() const { return std::vector<double>(memory_); }

    void eval(std::span<const double> x, const Instant&, std::vector<double>& memory, Sums&) const;
    /// See Device: all of them.
    void go(double step, double stop);
    double next_corner(double t) const;
    double pace() const;
    bool hear(const Trace*);  ///< whether some source carries force
    /// All devices as drawn; null: as designed.
    void draw(const Draw*);
    /// A device's own unknowns' values.
    std::vector<double> terminals(const Device&, std::span<const double> x) const;
};

}  // namespace corpuscle::circuit
