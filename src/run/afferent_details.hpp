#pragma once
// The model and the parameters of each afferent of a population, as columns of a table.

#include "io/nwb/nwb_file.hpp"
#include "run/sink.hpp"

namespace corpuscle {

/// One parameter of the afferents that have it.
struct ParameterColumn {
    std::string name, unit, description;
    std::vector<double> values;  ///< for each afferent, SI; NaN if it has no such parameter
};

struct AfferentDetails {
    std::vector<std::string> models;      ///< for each afferent: "sa1b+lif-b", "netlist"
    std::vector<std::string> properties;  ///< for each afferent, those that are not numbers: "receptor = sa1b, neuron = lif-b"
    std::vector<ParameterColumn> parameters;
};

AfferentDetails details_of(const PlanTable&);

/// The names of the afferents of a run. `x`, `y`: positions in m, empty on channels.
struct AfferentNames {
    std::vector<std::string> names, types, channels;
    std::vector<double> x, y;
};

/// The columns of the units of an NWB file. Parameters keep their names unless NWB uses them.
std::vector<NwbColumn> nwb_columns(AfferentNames, AfferentDetails);

}  // namespace corpuscle
