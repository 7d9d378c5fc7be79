#pragma once
// Compares the implementations of each afferent type on every channel: spikes in each phase, and distances between the spike trains.

#include <cmath>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "model/catalog.hpp"
#include "run/run_inputs.hpp"

namespace corpuscle {

/// The afferent type of a plan with this name: "sa1" for sa1, SA-I, sa1-circuit, sa1-kim, and for paths such as circuits/sa1.cir or
/// sa1_biased.cir. If the name does not begin with the name of a catalogue afferent, returns the complete name; for the path of a netlist,
/// the file name without directory and extension.
std::string afferent_type_of(std::string_view plan_name);

/// The plans of one afferent type. The first is the reference: the afferent with the name of the type, otherwise the first model, otherwise
/// the first netlist.
struct ImplementationGroup {
    std::string afferent_type;
    std::vector<std::size_t> members;  ///< indexes of plans
};

/// One group for each afferent type, in the order in which the types first occur. A group may have a single member.
std::vector<ImplementationGroup> implementation_groups(std::span<const AfferentPlan>);

/// One implementation on one channel, compared with the reference of its afferent type.
struct ImplementationComparison {
    struct PhaseCount {
        std::string phase;
        std::size_t spikes = 0, reference_spikes = 0;
        double excess() const;  ///< spikes / reference_spikes - 1; NaN if reference_spikes is 0
    };
    std::string afferent_type, afferent, reference, channel;
    PhaseCount total;                             ///< over the whole input; its phase name is empty
    std::vector<PhaseCount> phases = {};          ///< one for each phase of the stimulus; empty if it has no phases
    std::size_t matched = 0;                      ///< spikes that the Victor-Purpura distance moves onto a spike of the reference
    double mean_shift = NAN, median_shift = NAN;  ///< s, delay of the matched spikes behind the reference's; NaN if none match
    double victor_purpura = NAN;  ///< distance from the reference's train; NaN if there are too many pairs of close spikes to compute it
    double van_rossum = 0;        ///< distance from the reference's train
};

/// Keeps the spikes of the afferents whose type has several implementations, and compares them at the end of each input. If the run has
/// copies, nothing is compared.
class ImplementationComparisons final : public Sink {
public:
    static constexpr double cost = 100;   ///< 1/s, of moving a spike in the Victor-Purpura distance; it moves spikes by less than 2 / cost
    static constexpr double tau = 10e-3;  ///< s, time constant of the van Rossum distance

    /// For each input and channel: every implementation except the references.
    std::vector<ImplementationComparison> rows;

    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples, std::span<const Spike> last) override;

    /// The rows as a JSON document, with cost and tau.
    nlohmann::ordered_json document() const;

private:
    std::vector<ImplementationGroup> groups_;  // the afferent types with several implementations
    std::vector<bool> is_kept_;                // for each plan: true if its spikes are kept
    std::vector<std::vector<double>> trains_;  // spike times of each afferent of the current input, s from the start of the input

    /// `member`: an index of ImplementationGroup::members.
    ImplementationComparison compare_implementation(const Input&, std::size_t channel, const ImplementationGroup&,
                                                    std::size_t member) const;
};

}  // namespace corpuscle
