#pragma once
// The answer as a page to look at: one HTML file, no network.

#include <nlohmann/json.hpp>

#include "io/output.hpp"
#include "report/envelope.hpp"
#include "study/summary.hpp"

namespace corpuscle {

/// Collects traces and spikes while the run goes on; page() fills the template with them.
class Report final : public Listener {
public:
    /// Points that all traces of a page may have together; with more channels or inputs each has fewer.
    static constexpr std::size_t all_points = std::size_t{32} << 20;
    /// `inner`: currents and membranes are shown, if there are not too many copies.
    explicit Report(std::size_t most_points = all_points, Copies population = {}, bool inner = true)
        : most_points_(most_points), population_(std::move(population)), inner_(inner) {}

    /// Of each afferent so many copies have a row in the raster; with more of them there are no inner traces, else those of the first.
    static constexpr std::uint32_t most_copies = 50;

    bool wants_probes() const override { return inner_ && population_.copies <= most_copies; }
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const Answered&) override;
    Result<void> end(const Input&, std::int64_t samples) override;

    /// `costs`: as costs_of() has them.
    std::string page(const Summary&, std::span<const AfferentPlan>, const std::string& command, const std::vector<std::string>& warnings,
                     const nlohmann::ordered_json& costs) const;

private:
    using Json = nlohmann::ordered_json;
    std::size_t most_points_;
    Copies population_;
    bool inner_;
    std::vector<std::size_t> groups_;            // of the input at work: where each afferent's copies begin
    std::vector<Envelope> forces_;               // of each channel
    std::vector<std::vector<Envelope>> probes_;  // [channel and group][probe], of the first copy; empty if there are too many
    std::vector<std::vector<double>> trains_;    // [unit], s
    std::uint32_t first_channel_ = 0;

    std::size_t groups() const { return groups_.size() - 1; }
    /// The first unit of a group on a channel.
    std::size_t unit(std::size_t channel, std::size_t group) const { return channel * groups_.back() + groups_[group]; }
    void tell_spikes(const Input&, std::size_t channel, std::size_t group);
    void tell_rate(const Input&, std::size_t channel, std::size_t group, std::int64_t samples);
    std::vector<AfferentPlan> first_;  // each afferent, or its first copy
    Json parts_ = Json::array();       // of each
    Json inputs_ = Json::array(), traces_ = Json::array(), spikes_ = Json::array(), rates_ = Json::array();
};

}  // namespace corpuscle
