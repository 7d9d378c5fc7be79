#pragma once
// One afferent of a session, which feels the whole force.

#include <atomic>

#include "core/afferent_factory.hpp"
#include "page/object_reader.hpp"

namespace corpuscle::page {

/// An afferent as a request names it.
struct RowRequest {
    std::string afferent;             ///< "sa1", "fsr+f2i+sa1", "sa1-circuit"
    std::vector<std::string> set;     ///< "f_B=25Hz", "summer.N3B=8x4"
    std::vector<std::string> probes;  ///< recorded instead of the usual ones; empty: the usual ones
};
Result<RowRequest> read_row_request(ObjectReader&);
/// The rows of a request: its key "rows".
Result<std::vector<RowRequest>> read_row_requests(ObjectReader&);

/// The advice for an afferent in a file, which the page does not read: a command that does.
std::string file_afferent_advice(const std::string& file);

/// The plan of the afferent of a request, with its settings applied. Files of this machine are refused.
Result<AfferentPlan> plan_row(const RowRequest&);

/// The response of a row to one block of force.
struct RowBlock {
    std::vector<Spike> spikes;                     ///< steps count from the start of the session; afferent_index is that of the row
    std::int64_t first_value = 0;                  ///< number of the sample of the first value of each probe
    std::vector<std::vector<float>> probes;        ///< of each probe, its values
    std::vector<RangeViolation> range_violations;  ///< of each range
    std::int64_t steps = 0, rejected = 0, iterations = 0;
    EnergyUse energy = {};
};

class Row {
    RowRequest request_;
    AfferentPlan plan_;
    std::unique_ptr<Afferent> afferent_;
    State state_;
    std::int64_t origin_ = 0;  // the sample of the session at which the state's step is 0
    std::string error_;        // why it is silent; "": it works

    Result<void> respond(std::span<const double> force, double dt, const std::atomic<bool>& is_stopped, std::vector<double*> probes,
                         ResponseBlock&);

public:
    /// `now`: number of the first sample that it will feel.
    static Result<Row> make(RowRequest, const SimulationOptions&, std::int64_t now);

    const RowRequest& request() const { return request_; }
    const AfferentPlan& plan() const { return plan_; }
    const Afferent& afferent() const { return *afferent_; }
    const std::string& error() const { return error_; }
    Json document(double dt) const;  ///< as in the answer of `start`

    /// Replaces the settings. Returns true if the state goes on, false if the afferent starts again.
    Result<bool> change(std::vector<std::string> set, const SimulationOptions&, std::int64_t now);
    /// Simulates the next block. `every`: each value of a probe whose sample number is a multiple of it is returned; 0: none. If the
    /// afferent does not converge, error() says so, and from then on it is silent. Ends early when `is_stopped`.
    RowBlock simulate(std::span<const double> force, std::uint32_t index, std::size_t every, double dt,
                      const std::atomic<bool>& is_stopped);
    Result<OperatingState> operating_state() const { return afferent_->operating_state(state_); }
    /// The time (s) of the session at which the row started.
    double origin(double dt) const { return static_cast<double>(origin_) * dt; }
};

}  // namespace corpuscle::page
