#pragma once
// The simulation of several afferents with one complete force, in slices of time: `respond` and `monte-carlo`.

#include <atomic>

#include "measure/measures.hpp"
#include "page/page_force.hpp"
#include "page/row.hpp"
#include "run/simulate.hpp"

namespace corpuscle::page {

/// The response of one afferent, as far as it is simulated.
struct JobResponse {
    std::size_t spikes = 0;
    std::string error;                             ///< "": none
    std::vector<std::vector<float>> probes;        ///< of each probe, its values
    Json probe_names, ranges;                      ///< as in the answer of `start`
    std::vector<RangeViolation> range_violations;  ///< of each range
    std::vector<std::string> range_warnings;
    std::int64_t truncated_steps = 0, saturated = 0, overflowed = 0;  ///< as in ResponseBlock
};

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
    std::vector<Spike> spikes_;               // since the last answer
    std::vector<JobResponse> responses_;      // of the plans so far
    MeasureAccumulator measures_;             // of `respond`: of each plan, in each phase
    std::size_t searched_ = 0;                // after the simulation: number of the plans that silence_notes_ is about
    std::vector<std::string> silence_notes_;  // about afferents that never fired

    bool is_simulated() const { return plan_ == plans_.size(); }

    void prepare_measures();
    void begin_plan();
    void end_plan();
    void simulate_block(const std::atomic<bool>& is_stopped);
    std::vector<std::string> warnings() const;
    void search_factor();
    void add_end(MessageWriter& answer) const;

public:
    /// Starts `respond`. `rows`: the rows of the session, if the request has none of its own. The recording is the one that the engine
    /// keeps.
    static Result<ResponseJob> respond(ObjectReader&, std::vector<RowRequest> rows, const KeptRecording*);
    /// Starts `monte-carlo`.
    static Result<ResponseJob> monte_carlo(ObjectReader&, const KeptRecording*);

    bool is_done() const { return is_simulated() && (is_monte_carlo_ || searched_ == plans_.size()); }
    /// Simulates for about `seconds`, or to the end if it is 0, and adds the results to the answer. It ends with an error when
    /// `is_stopped`.
    Result<void> run(double seconds, const std::atomic<bool>& is_stopped, MessageWriter& answer);
};

}  // namespace corpuscle::page
