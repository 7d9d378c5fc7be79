#pragma once
// Afferents on channels: one of each plan on every channel of a source.

#include "model/catalog.hpp"
#include "run/sink.hpp"

namespace corpuscle {

/// The index of an afferent within the input is channel * plans.size() + plan.
class ChannelPopulation final : public Population {
public:
    /// The plans must outlive the population. `input_name`: of the source in outputs. `is_only_input`: false if the run has other inputs;
    /// then the names of the channels include it.
    ChannelPopulation(const ForceSource&, std::span<const AfferentPlan> plans, const std::string& input_name, bool is_only_input = true);

    std::span<const AfferentPlan> plans() const { return plans_; }
    std::size_t channels() const { return sensors_.size(); }
    const std::vector<Channel>& sensors() const { return sensors_; }  ///< the channels of the source
    const AfferentPlan& plan_of(std::size_t u) const { return plans_[u % plans_.size()]; }
    std::size_t channel_of(std::size_t u) const { return u / plans_.size(); }
    const std::string& channel(std::size_t c) const { return names_[c]; }  ///< name of a channel in outputs
    /// The probes of an afferent of this plan.
    std::span<const Probe> plan_probes(std::size_t plan) const { return probes_.empty() ? std::span<const Probe>{} : probes_[plan]; }
    void set_probes(std::vector<std::span<const Probe>> probes) { probes_ = std::move(probes); }  ///< one for each plan

    std::size_t size() const override { return sensors_.size() * plans_.size(); }
    std::string afferent_name(std::size_t u) const override { return plan_of(u).name; }
    std::string channel_name(std::size_t u) const override { return names_[channel_of(u)]; }
    std::vector<std::string> force_names() const override { return names_; }
    std::size_t class_count() const override;
    std::size_t class_of(std::size_t u) const override { return class_of_[u % plans_.size()]; }
    const AfferentPlan& class_plan(std::size_t c) const override;
    std::span<const Probe> probes(std::size_t u) const override { return plan_probes(u % plans_.size()); }
    BinGroups bin_groups() const override;
    Result<PlanTable> plan_table() const override;
    EventAddressing event_addressing(const Clock&) const override;
    const ChannelPopulation* on_channels() const override { return this; }

private:
    std::span<const AfferentPlan> plans_;
    std::vector<Channel> sensors_;
    std::vector<std::string> names_;              // of the channels in outputs
    std::vector<std::size_t> class_of_;           // for each plan
    std::vector<std::span<const Probe>> probes_;  // for each plan; empty before the simulation starts
};

}  // namespace corpuscle
