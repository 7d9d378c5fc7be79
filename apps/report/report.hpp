#pragma once
// The report page of respond: one self-contained HTML file.

#include <nlohmann/json.hpp>

#include "io/output_file.hpp"
#include "report/envelope.hpp"
#include "study/run_summary.hpp"

namespace corpuscle {

/// Collects traces and spikes during the run; page() fills the template with them.
class Report final : public ResponseSink {
public:
    /// Limit on the total number of points of all traces of a page. With more channels or inputs each trace has fewer points.
    static constexpr std::size_t all_points = std::size_t{32} << 20;
    /// `with_probes`: show currents and membranes, unless there are too many copies.
    explicit Report(std::size_t max_points = all_points, CopySpec copies = {}, bool with_probes = true)
        : most_points_(max_points), population_(std::move(copies)), inner_(with_probes) {}

    /// The raster shows at most this many copies of each afferent. Up to this number the probes of the first copy are recorded; with more
    /// copies none are.
    static constexpr std::uint32_t most_copies = 50;

    bool wants_probes() const override { return inner_ && population_.count <= most_copies; }
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples) override;

    /// `costs`: the document of costs_of().
    std::string page(const RunSummary&, std::span<const AfferentPlan>, const std::string& command, const std::vector<std::string>& warnings,
                     const nlohmann::ordered_json& costs) const;

private:
    using Json = nlohmann::ordered_json;
    std::size_t most_points_;
    CopySpec population_;
    bool inner_;
    std::vector<std::size_t> groups_;            // of the current input: the first copy of each afferent, then the end
    std::vector<Envelope> forces_;               // by channel
    std::vector<std::vector<Envelope>> probes_;  // [channel and group][probe], of the first copy; empty with too many copies
    std::vector<std::vector<double>> trains_;    // [afferent], s
    std::uint32_t first_channel_ = 0;

    std::size_t groups() const { return groups_.size() - 1; }
    /// The index of the first afferent of a group on a channel.
    std::size_t unit(std::size_t channel, std::size_t group) const { return channel * groups_.back() + groups_[group]; }
    void tell_spikes(const Input&, std::size_t channel, std::size_t group);
    void tell_rate(const Input&, std::size_t channel, std::size_t group, std::int64_t samples);
    std::vector<AfferentPlan> first_;  // each afferent, or its first copy
    Json parts_ = Json::array();       // the probes of each
    Json inputs_ = Json::array(), traces_ = Json::array(), spikes_ = Json::array(), rates_ = Json::array();
};

}  // namespace corpuscle
