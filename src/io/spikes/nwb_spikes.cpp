// The units of an NWB file, which a helper program reads (io/sandbox).

#include <fcntl.h>
#include <fmt/format.h>
#include <cerrno>
#include <cstring>

#include "io/nwb/hdf5_messages.hpp"
#include "io/output/descriptor.hpp"
#include "io/sandbox/helper_process.hpp"
#include "io/spikes/train_collector.hpp"

namespace corpuscle {

Result<std::vector<NamedTrain>> read_nwb_spikes(const std::string& path, const SpikeColumns& columns) {
    if (columns.time)
        return bad_usage(fmt::format("--time {}: the spike times of an NWB file are in its column spike_times", *columns.time));
    const auto program = find_helper_program("corpuscle-hdf5");
    if (!program) return bad_input(program.error().message, {path});
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY));
    if (!file) return bad_input(fmt::format("cannot be opened: {}", std::strerror(errno)), {path});
    auto helper = HelperProcess::start(*program, file.get(), HelperProcess::units_protocol);
    if (!helper) return bad_input(helper.error().message, {path});
    helper->send(encode(UnitsRequest{path, columns.train.value_or("")}));
    const auto response = TRY(helper->receive(path, "the HDF5 library"));
    TrainCollector trains;
    for (auto& unit : TRY(decode_units(response, path))) trains.train(unit.name, unit.channel) = std::move(unit.times);
    return std::move(trains).sorted();
}

}  // namespace corpuscle
