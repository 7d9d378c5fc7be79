#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "io/recording/recording_formats.hpp"
#include "io/spikes/train_collector.hpp"
#include "io/table/npz.hpp"

namespace corpuscle {
namespace {

/// The name of an afferent or channel that is identified by a number: the number as text.
std::string name_of_number(double x) { return std::floor(x) == x ? fmt::format("{:.0f}", x) : fmt::format("{}", x); }

/// True if the times look like sample numbers instead of seconds. spike_times.npy of Phy (a program for spike sorting) has sample numbers,
/// and does not contain the rate.
bool are_sample_numbers(const std::vector<double>& times) {
    return times.size() > 1 && *std::max_element(times.begin(), times.end()) >= 1000 &&
           std::all_of(times.begin(), times.end(), [](double t) { return std::floor(t) == t; });
}

/// Reads an NPZ file in the format of SpikeInterface: for each segment of the recording, the sample numbers of the spikes
/// (spike_indexes_segK, K = 0, 1 ...) and the units that fired (spike_labels_segK). Files of Corpuscle also contain the times in s
/// (spike_times_segK) and the names of the units' afferents and channels.
class NpzSpikes {
    NpzReader npz_;
    std::vector<std::int64_t> ids_;                  // of the units
    std::vector<std::string> afferents_, channels_;  // of each unit, in files of Corpuscle
    bool has_exact_times_ = false;                   // true for a file of Corpuscle
    double rate_ = 1;                                // Hz, converts sample numbers to seconds
    TrainCollector trains_;

    Error format_error(std::string message) const { return bad_input(std::move(message), {npz_.path()}); }

    /// Reads the ids of the units and, in files of Corpuscle, their names. A named unit has a train even if it does not fire.
    Result<void> read_units() {
        ids_ = TRY(npz_.integers("unit_ids"));
        has_exact_times_ = npz_.has("unit_afferent");
        if (!has_exact_times_) return {};
        auto afferents = npz_.strings("unit_afferent"), channels = npz_.strings("unit_channel");
        if (!afferents || !channels) return afferents ? channels.error() : afferents.error();
        afferents_ = std::move(*afferents), channels_ = std::move(*channels);
        if (afferents_.size() != ids_.size() || channels_.size() != ids_.size())
            return format_error(fmt::format("unit_ids has {} elements, unit_afferent {} and unit_channel {}", ids_.size(),
                                            afferents_.size(), channels_.size()));
        for (std::size_t u = 0; u < ids_.size(); ++u) trains_.train(afferents_[u], channels_[u]);
        return {};
    }

    /// The times of all spikes of a segment, in s.
    Result<std::vector<double>> times(std::int64_t segment) const {
        if (has_exact_times_) return npz_.numbers(fmt::format("spike_times_seg{}", segment));
        const auto indexes = TRY(npz_.integers(fmt::format("spike_indexes_seg{}", segment)));
        std::vector<double> out;
        for (const auto k : indexes) out.push_back(static_cast<double>(k) / rate_);
        return out;
    }

    /// The train of a unit, given by its index. Outside files of Corpuscle, each segment after the first is a channel of its own.
    std::vector<double>& train(std::size_t unit, std::int64_t segment) {
        if (has_exact_times_) return trains_.train(afferents_[unit], channels_[unit]);
        return trains_.train(std::to_string(ids_[unit]), segment == 0 ? "" : fmt::format("segment {}", segment + 1));
    }

    /// Reads the spikes of a segment, counted from 0.
    Result<void> read_segment(std::int64_t segment) {
        const auto labels = TRY(npz_.integers(fmt::format("spike_labels_seg{}", segment)));
        const auto spike_times = TRY(times(segment));
        if (spike_times.size() != labels.size())
            return format_error(fmt::format("segment {} has {} spikes and {} labels", segment, spike_times.size(), labels.size()));
        std::map<std::int64_t, std::vector<double>*> train_of_id;
        for (std::size_t u = 0; u < ids_.size(); ++u) train_of_id[ids_[u]] = &train(u, segment);
        for (std::size_t k = 0; k < labels.size(); ++k) {
            const auto found = train_of_id.find(labels[k]);
            if (found == train_of_id.end())
                return format_error(fmt::format("spike {} of segment {} has label {}, which is not in unit_ids", k, segment, labels[k]));
            if (!std::isfinite(spike_times[k]))
                return format_error(fmt::format("spike {} of segment {} has a time that is not finite", k, segment));
            found->second->push_back(spike_times[k]);
        }
        return {};
    }

public:
    explicit NpzSpikes(NpzReader npz) : npz_(std::move(npz)) {}

    Result<std::vector<NamedTrain>> read() {
        TRY(read_units());
        const auto segments = npz_.integers("num_segment");
        const auto rate = npz_.numbers("sampling_frequency");
        if (!segments || !rate) return segments ? rate.error() : segments.error();
        if (segments->size() != 1 || rate->size() != 1 || !((*rate)[0] > 0) || !std::isfinite((*rate)[0]))
            return format_error("num_segment and sampling_frequency must be one number each, and the frequency must be positive");
        rate_ = (*rate)[0];
        for (std::int64_t s = 0; s < (*segments)[0]; ++s) TRY(read_segment(s));
        return std::move(trains_).sorted();
    }
};

}  // namespace

Result<std::vector<NamedTrain>> read_npy_spikes(const std::string& path, const SpikeColumns& wanted) {
    auto table = TRY(open_npy_table(path));
    std::vector<std::string> headings;
    for (const auto& c : table->columns()) headings.push_back(c.unit.empty() ? c.name : c.name + "_" + c.unit);
    if (headings.size() == 1) headings[0].clear();  // a single column holds the times; its name does not matter
    // ch1, ch2 ... are the default names of columns without names.
    const bool is_unnamed = headings.size() > 1 && headings[0] == "ch1";
    if (is_unnamed && !(wanted.time && wanted.train))
        return bad_input(
            fmt::format("the array has {} columns; select the columns of times and trains, such as --time 1 --train 2", headings.size()),
            {path});
    std::size_t column = 0;
    const auto found = find_spike_columns(headings, wanted, column);
    if (!found) return bad_input(found.error().message, {path});
    std::vector<std::size_t> columns = {found->time};
    if (found->afferent) columns.push_back(*found->afferent);
    if (found->channel) columns.push_back(*found->channel);
    TrainCollector trains;
    std::vector<double> stored_times;
    for (std::vector<std::vector<double>> block(columns.size());;) {
        const auto rows = TRY(table->read(columns, rows_per_block, block));
        if (rows == 0) break;
        for (std::size_t k = 0; k < rows; ++k) {
            const auto afferent = found->afferent ? name_of_number(block[1][k]) : std::string();
            const auto channel = found->channel ? name_of_number(block.back()[k]) : std::string();
            trains.train(afferent, channel).push_back(block[0][k] * found->seconds_per_unit);
            stored_times.push_back(block[0][k]);
        }
    }
    if (found->seconds_per_unit == 1 && are_sample_numbers(stored_times))
        return bad_input(
            fmt::format("the times are integers, as sample numbers are. Convert them to seconds with the sample rate: python3 -c "
                        "\"import numpy; numpy.save('seconds.npy', numpy.load('{}') / 30000)\"",
                        path.find_first_of("'\"\\$`!") == path.npos ? path : "FILE.npy"),
            {path});
    return std::move(trains).sorted();
}

Result<std::vector<NamedTrain>> read_npz_spikes(const std::string& path) { return NpzSpikes(TRY(NpzReader::open(path))).read(); }

}  // namespace corpuscle
