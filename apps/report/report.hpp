#pragma once
// The answer as a page to look at: one HTML file, no network.

#include <nlohmann/json.hpp>

#include "io/output.hpp"
#include "report/envelope.hpp"
#include "study/respond.hpp"
#include "study/summary.hpp"

namespace corpuscle {

/// Collects traces and spikes while the run goes on; page() fills the template with them.
class Report final : public Listener {
public:
    /// Points that all traces of a page may have together; with more channels or inputs each has fewer.
    explicit Report(std::size_t most_points = std::size_t{32} << 20) : most_points_(most_points) {}

    bool wants_probes() const override { return true; }
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const Answered&) override;
    Result<void> end(const Input&, std::int64_t samples) override;

    std::string page(const Summary&, std::span<const AfferentPlan>, const std::string& command,
                     const std::vector<std::string>& warnings) const;

private:
    using Json = nlohmann::ordered_json;
    std::size_t most_points_;
    std::vector<Envelope> forces_;               // of each channel of the input at work
    std::vector<std::vector<Envelope>> probes_;  // [unit][probe]
    std::vector<std::vector<double>> trains_;    // s
    std::uint32_t first_channel_ = 0;
    Json parts_ = Json::array();  // of each afferent
    Json inputs_ = Json::array(), traces_ = Json::array(), spikes_ = Json::array();
};

}  // namespace corpuscle
