// The units of an NWB file, which a helper program reads (io/sandbox).

#include <fmt/format.h>

#include "io/hdf5/hdf5_request.hpp"
#include "io/nwb/nwb_messages.hpp"
#include "io/spikes/train_collector.hpp"

namespace corpuscle {

Result<std::vector<NamedTrain>> read_nwb_spikes(const std::string& path, const SpikeColumns& columns) {
    if (columns.time)
        return bad_usage(fmt::format("--time {}: the spike times of an NWB file are in its column spike_times", *columns.time));
    auto units = TRY(request_from_hdf5<std::vector<NwbUnit>>(HelperProcess::units_protocol, UnitsRequest{path, columns.train.value_or("")}));
    TrainCollector trains;
    for (auto& unit : units) trains.train(unit.name, unit.channel) = std::move(unit.times);
    return std::move(trains).sorted();
}

}  // namespace corpuscle
