#pragma once
// The plan of a run of afferents on channels: one of each requested afferent, or copies of them.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/copies.hpp"

namespace corpuscle {

/// The request. Texts are those of the command line.
struct ChannelPlanRequest {
    std::span<const std::string> afferents;
    std::span<const ParameterOverride> overrides = {};
    std::span<const std::string> probes = {};         ///< of netlists
    std::uint32_t copies = 0;                         ///< of each afferent; 0: the afferents themselves
    std::span<const ParameterOverride> spreads = {};  ///< "sa1.f_B=10%"
    std::uint64_t seed = 0;
};

struct ChannelPlan {
    std::vector<AfferentPlan> afferents = {};  ///< as requested, without copies
    CopySpec copies = {};
    std::vector<AfferentPlan> simulated = {};    ///< all copies; without copies, the afferents
    std::vector<ParameterOverride> unused = {};  ///< of the overrides
};

/// Plans the afferents. Refuses one that is given twice, a probe that no netlist has, and a spread that no afferent uses.
Result<ChannelPlan> plan_channels(const ChannelPlanRequest&);

/// Returns an error if there are more afferents on `channels` channels than 32-bit indexes. `copies`: as in ChannelPlanRequest. Call it
/// before plan_channels() if the channels are known, because a million copies take seconds.
Result<void> check_afferent_count(std::size_t afferents, std::uint32_t copies, std::size_t channels);

}  // namespace corpuscle
