#include "corpuscle/spikes.hpp"

#include "api/result.hpp"
#include "io/spikes/spike_files.hpp"

namespace corpuscle {

std::vector<SpikeTrain> read_spike_trains(const std::string& path, const std::string& time_column, const std::string& train_column) {
    const auto given = [](const std::string& column) { return column.empty() ? std::nullopt : std::optional(column); };
    std::vector<SpikeTrain> out;
    for (auto& train : api::value_or_throw(read_spikes(path, {given(time_column), given(train_column)})))
        out.push_back({std::move(train.afferent), std::move(train.channel), std::move(train.times)});
    return out;
}

}  // namespace corpuscle
