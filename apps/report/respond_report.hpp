#pragma once
// The report page of respond: one self-contained HTML file.

#include <nlohmann/json.hpp>

#include "io/output_file.hpp"
#include "report/envelope.hpp"
#include "study/run_summary.hpp"

namespace corpuscle {

/// Collects traces and spikes during the run; page() fills the template with them.
class RespondReport final : public ResponseSink {
public:
    /// Limit on the total number of points of all traces of a page. With more channels or inputs each trace has fewer points.
    static constexpr std::size_t max_total_points = std::size_t{32} << 20;
    /// `with_probes`: show currents and membranes, unless there are too many copies.
    explicit RespondReport(std::size_t max_points = max_total_points, CopySpec copies = {}, bool with_probes = true)
        : max_points_(max_points), copies_(std::move(copies)), with_probes_(with_probes) {}

    /// The raster shows at most this many copies of each afferent. Up to this number the probes of the first copy are recorded; with more
    /// copies none are.
    static constexpr std::uint32_t max_copies = 50;

    bool wants_probes() const override { return with_probes_ && copies_.count <= max_copies; }
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples) override;

    /// `costs`: the document of costs_of().
    std::string page(const RunSummary&, std::span<const AfferentPlan>, const std::string& command, const std::vector<std::string>& warnings,
                     const nlohmann::ordered_json& costs) const;

private:
    using Json = nlohmann::ordered_json;
    std::size_t max_points_;
    CopySpec copies_;
    bool with_probes_;
    std::vector<std::size_t> groups_;  // of the current input: index of the first copy of each afferent, then the number of copies
    std::vector<Envelope> forces_;     // one per channel, N
    std::vector<std::vector<Envelope>> probes_;  // [channel * groups() + group][probe], of the first copy; empty with too many copies
    std::vector<std::vector<double>> trains_;    // [afferent], s
    std::uint32_t first_channel_ = 0;            // number of channels of all earlier inputs

    std::size_t groups() const { return groups_.size() - 1; }
    /// The index of the first afferent of a group on a channel.
    std::size_t afferent_index(std::size_t channel, std::size_t group) const { return channel * groups_.back() + groups_[group]; }
    void add_spikes(const Input&, std::size_t channel, std::size_t group);
    void add_rate(const Input&, std::size_t channel, std::size_t group, std::int64_t samples);
    std::vector<AfferentPlan> first_copies_;  // each afferent, or its first copy
    Json recordables_ = Json::array();        // name and unit of the probes of each afferent
    Json inputs_ = Json::array(), traces_ = Json::array(), spikes_ = Json::array(), rates_ = Json::array();
};

}  // namespace corpuscle
