#pragma once
// The spikes of a session as a file.

#include "page/row.hpp"
#include "skin/innervation.hpp"

namespace corpuscle::page {

struct SavedSpikes {
    std::span<const Row> rows;
    const Innervation* skin;        ///< null if there is none
    std::span<const Spike> spikes;  ///< in order of time
    bool is_complete;               ///< false: the first spikes of the session are no longer there
    Clock clock;
    std::int64_t samples;  ///< that were simulated
};

/// The force of a stretch of a session.
struct SavedForce {
    std::int64_t first = 0;      ///< number of its first sample
    std::vector<double> values;  ///< N, of each sample; may be empty
};

/// The text of spikes.csv. The channel of a row is "force", that of a skin's afferent its region.
std::string spikes_csv(const SavedSpikes&);

/// The bytes of an NWB file: spikes, parameters at the time of saving, and force.
Result<std::string> spikes_nwb(const SavedSpikes&, const SavedForce&);

/// Names of afferent and channel of each unit. A second row of the same afferent is called "sa1#2".
struct UnitNames {
    std::vector<std::string> afferents, channels;
};
UnitNames unit_names(const SavedSpikes&);

}  // namespace corpuscle::page
