#pragma once
// The simulation of a session, since its last `start`.

#include <atomic>

#include "page/pressed_skin.hpp"
#include "page/row.hpp"
#include "page/save/saved_spikes.hpp"

namespace corpuscle::page {

class Session {
    Clock clock_;
    SimulationOptions options_;
    std::vector<Row> rows_;
    std::optional<PressedSkin> skin_;
    std::int64_t samples_ = 0;   // that were simulated
    Position at_;                // of the contact at the last sample
    std::vector<Spike> spikes_;  // since the start, in the order in which they came
    std::uint64_t dropped_ = 0;  // number of spikes before those of spikes_
    std::string failure_;        // why the session cannot go on; "": it can

    void keep(std::span<const Spike>);
    Result<ContactForce> contact_force(ObjectReader&, std::size_t samples, std::vector<std::vector<double>>& arrays) const;
    Result<SavedForce> force_to_save(ObjectReader&) const;
    Result<Json> advance_skin(const ContactForce&, const std::atomic<bool>& is_stopped, std::vector<Spike>&);

public:
    /// Answers `start`: the session of the request.
    static Result<Session> start(ObjectReader&, MessageWriter& answer);

    const Clock& clock() const { return clock_; }
    const SimulationOptions& options() const { return options_; }
    std::vector<RowRequest> row_requests() const;

    /// Ends with an error when `is_stopped`. After an error in the middle of a block the session cannot go on.
    Result<void> advance(ObjectReader&, const std::atomic<bool>& is_stopped, MessageWriter& answer);
    Result<void> change_contact(ObjectReader&, MessageWriter& answer);
    Result<void> change_row(ObjectReader&, MessageWriter& answer);
    Result<void> operating(ObjectReader&, MessageWriter& answer) const;
    Result<void> save(ObjectReader&, MessageWriter& answer) const;
};

/// The sampling rate of a request.
Result<Clock> read_clock(ObjectReader&);

}  // namespace corpuscle::page
