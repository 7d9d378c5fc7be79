#pragma once
// The simulation of several afferents with one complete force, in slices of time: `respond` and `monte-carlo`.

#include <atomic>

#include "page/page_force.hpp"
#include "page/row.hpp"
#include "run/simulate.hpp"

namespace corpuscle::page {

class ResponseJob {
    std::string name_;  // of the request
    PageForce force_;
    SimulationOptions options_;
    std::vector<AfferentPlan> plans_;
    std::size_t every_ = 0;  // each `every_`-th value of the probes is recorded; 0: none
    bool is_monte_carlo_ = false;
    std::size_t plan_ = 0;  // the afferent that is simulated
    std::size_t at_ = 0;    // samples of it so far
    std::unique_ptr<Afferent> afferent_;
    std::unique_ptr<AfferentSimulation> simulation_;
    std::vector<double> padded_;                           // the force and the samples by which the afferent is late
    std::vector<Spike> spikes_;                            // since the last answer
    std::vector<std::size_t> spike_counts_;                // of each plan
    std::vector<std::string> errors_;                      // of each plan; "": none
    std::vector<std::vector<std::vector<float>>> probes_;  // [plan][probe][value]
    std::vector<Json> probe_names_;

    void begin_plan();
    void simulate_block(const std::atomic<bool>& is_stopped);
    void add_end(MessageWriter& answer) const;

public:
    /// Starts `respond`. `rows`: the rows of the session, if the request has none of its own.
    static Result<ResponseJob> respond(ObjectReader&, std::vector<RowRequest> rows);
    /// Starts `monte-carlo`.
    static Result<ResponseJob> monte_carlo(ObjectReader&);

    bool is_done() const { return plan_ == plans_.size(); }
    /// Simulates for about `seconds`, or to the end if it is 0, and adds the results to the answer. It ends with an error when
    /// `is_stopped`.
    Result<void> run(double seconds, const std::atomic<bool>& is_stopped, MessageWriter& answer);
};

}  // namespace corpuscle::page
