#pragma once
// Simulates a NIR graph with a fixed time step.
//
// A signal has one value for each step, and a spike is the value 1 for one step. Step k uses the input of step k and changes the membranes;
// a spike of step k is in the output of step k. NIR does not say how a loop is simulated: here each edge that leaves a node with a membrane
// and leads to a node of the same loop delays by one step. At the start each membrane is at v_leak, or at 0 if it does not leak, and no
// neuron has fired.

#include <memory>
#include <span>
#include <vector>

#include "nir/graph.hpp"

namespace corpuscle::nir {

/// How the equations of membranes and synapses become steps. The input is constant within a step.
enum class Update {
    exact,           ///< the exact solution
    euler,           ///< forward Euler, for which many networks were trained
    backward_euler,  ///< as the algorithms of the thesis
};

class Network {
public:
    /// `dt`: s. Returns an error if the graph has a loop without a membrane, or if the step is too long for forward Euler.
    static Result<Network> create(std::shared_ptr<const Graph>, double dt, Update);

    const Graph& graph() const { return *graph_; }
    std::size_t input_count() const { return graph_->input_count(); }
    std::size_t output_count() const { return graph_->output_count(); }
    std::size_t state_size() const { return state_size_; }
    /// Multiplications of a step, about.
    std::size_t operations() const { return operations_; }
    /// The state at the start: membranes, synaptic currents, delayed outputs.
    std::vector<double> start() const;
    /// Arrays that step() needs; their contents do not matter before a step.
    std::vector<double> workspace() const { return std::vector<double>(signals_ + widest_input_); }

    /// One step. `input`: input_count() values; `output`: receives output_count() values.
    void step(std::span<const double> input, std::span<double> output, std::span<double> state, std::span<double> workspace) const;

    /// Membranes of nodes with one element, which can be recorded: the name of the node and the position of its v in the state.
    struct Membrane {
        std::string_view node;
        std::size_t at;
    };
    std::vector<Membrane> membranes() const;

private:
    /// An input of a stage: the outputs of another one, in this step or in the step before.
    struct Source {
        std::size_t at;   // first value among the signals, or in the state if the source is delayed
        bool is_delayed;
    };
    /// A node, in the order of computation. Positions count from the first signal or the first value of the state.
    struct Stage {
        const Node* node;
        std::size_t signal = 0;                            // its outputs
        std::size_t current = 0, membrane = 0, delayed = 0;  // in the state; unused: 0
        bool is_delayed = false;                           // its outputs are stored for the next step
        bool is_input = false;
        std::size_t input = 0;  // of an input of the graph: its first value
        std::vector<Source> sources = {};
        std::vector<double> columns = {};  // of a matrix: its weights, column by column
        std::span<const double> offset = {}, factor = {}, threshold = {}, reset = {};  // bias, scale, (v_)threshold, v_reset
        // For each element, a membrane: v = keep v + rest + gain x, and behind a synapse + current_gain I with the I before the step;
        // a synapse: I = current_keep I + weight x.
        std::vector<double> keep = {}, rest = {}, gain = {}, current_gain = {}, current_keep = {}, weight = {};
    };

    std::shared_ptr<const Graph> graph_;
    std::vector<Stage> stages_;
    std::vector<std::size_t> output_signals_;  // of each output node: its first signal
    std::size_t signals_ = 0, state_size_ = 0, widest_input_ = 0, operations_ = 0;

    Result<void> add_coefficients(Stage&, double dt, Update) const;
    void add_synapse(Stage&, std::size_t element, double dt, Update) const;
    void run(const Stage&, std::span<const double> x, std::span<double> signals, std::span<double> state) const;
};

}  // namespace corpuscle::nir
