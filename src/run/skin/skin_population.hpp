#pragma once
// The afferents of a skin as a population. Their channel is the region that contains them.

#include "run/sink.hpp"

namespace corpuscle {

class SkinPopulation final : public Population {
    const Innervation& skin_;
    std::string force_name_;
    std::vector<std::span<const Probe>> probes_;  // for each class; empty if no probes are recorded

    const SkinAfferent& afferent(std::size_t u) const { return skin_.afferents[u]; }

public:
    /// The skin must outlive the population. `force_name`: name of the total force in outputs.
    explicit SkinPopulation(const Innervation& skin, std::string force_name = "force") : skin_(skin), force_name_(std::move(force_name)) {}
    void set_probes(std::vector<std::span<const Probe>> probes) { probes_ = std::move(probes); }  ///< one for each class

    std::size_t size() const override { return skin_.afferents.size(); }
    std::string afferent_name(std::size_t u) const override { return skin_.afferent_name(u); }
    std::string channel_name(std::size_t u) const override { return skin_.plan.sites.regions[afferent(u).region]; }
    std::vector<std::string> force_names() const override { return {force_name_}; }
    std::size_t class_count() const override { return skin_.plan.classes.size(); }
    std::size_t class_of(std::size_t u) const override { return afferent(u).class_index; }
    const AfferentPlan& class_plan(std::size_t c) const override { return skin_.plan.classes[c].afferent; }
    std::span<const Probe> probes(std::size_t u) const override {
        return probes_.empty() ? std::span<const Probe>{} : probes_[class_of(u)];
    }
    BinGroups bin_groups() const override;
    Result<PlanTable> plan_table() const override;
    EventAddressing event_addressing(const Clock&) const override;
    std::optional<Position> position(std::size_t u) const override { return afferent(u).position; }
    const Innervation* skin() const override { return &skin_; }
};

}  // namespace corpuscle
