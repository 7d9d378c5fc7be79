#pragma once
// Evaluates the devices in groups on SIMD lanes: gathers their voltages from the unknowns and adds the results to the equations.

#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

/// All device groups of a system. Index lists are made once: the unknown of each terminal, and the derivatives that add up to each matrix
/// entry. Vectors of unknowns have one more element at the end, for ground.
class BatchedDevices {
    struct GroupBuffer {
        const DeviceGroup& group;
        std::size_t offset;  // of the group's values in numbers(): v, f, q [terminals][stride]; df, dq [terminals^2][stride]
    };
    struct alignas(64) CacheLine {
        double values[8];
    };
    /// Index lists that add values to targets, grouped by the number of terms of each target.
    struct ScatterAdd {
        struct Run {  // `count` successive targets, to each of which `terms` values are added
            int terms, count;
        };
        std::vector<Run> runs;
        std::vector<int> to;    // index of each target
        std::vector<int> from;  // indices of the values, target by target
        void add(const double* numbers, double* out) const;
    };
    std::vector<GroupBuffer> buffers_;
    std::vector<CacheLine> lines_;  // storage of numbers()
    std::vector<int> terminals_;    // unknown of each element of v, one buffer after another
    ScatterAdd slopes_, currents_, charges_;

    double* numbers() { return lines_.empty() ? nullptr : lines_[0].values; }
    static ScatterAdd make_scatter(std::vector<std::pair<int, int>> to_from);

public:
    explicit BatchedDevices(const System&);
    BatchedDevices(const BatchedDevices&) = delete;

    /// Evaluates the devices at x; adds f + rate q to the residual r, and df + rate dq to the Jacobian J. rate: 1/s.
    void evaluate(const EvalContext&, double rate, const std::vector<double>& x, std::vector<double>& J, std::vector<double>& r);
    /// Adds the charges at x + step, extrapolated linearly from the last evaluation at x, to q. Call at most once after each evaluate(),
    /// since it overwrites the evaluation.
    void add_charges(const std::vector<double>& step, std::vector<double>& q);
};

}  // namespace corpuscle::circuit
