#pragma once
// The task to tell surfaces apart from features of taxels, by a linear read-out.

#include <map>

#include "reproduction/readout/accuracy_interval.hpp"
#include "reproduction/texture/slide_trials.hpp"

namespace corpuscle {

class TextureTask {
    std::vector<SlideTrial> trials_;
    std::map<std::string, TaxelFeature> features_;

public:
    explicit TextureTask(std::vector<SlideTrial> trials) : trials_(std::move(trials)) {}

    const std::vector<SlideTrial>& trials() const { return trials_; }
    void add(const std::string& name, TaxelFeature feature) { features_[name] = std::move(feature); }
    /// The mean of a feature over trials and taxels.
    double mean(const std::string& name) const;
    /// The number of trials that a test reads.
    std::size_t tested(SlideTest) const;
    /// The accuracy of a read-out of the surface from these features of `taxels` taxels, averaged over random choices of the taxels. All
    /// features and tests have the same choices. Its interval takes the halves of recordings as groups.
    Accuracy accuracy(const std::vector<std::string>& features, SlideTest, std::size_t taxels) const;
};

/// The choices of `taxels` out of `total` taxels: each single one, all, or some at random.
std::vector<std::vector<std::size_t>> taxel_choices(std::size_t taxels, std::size_t total);

}  // namespace corpuscle
