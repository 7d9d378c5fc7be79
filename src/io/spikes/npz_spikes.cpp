#include <fmt/format.h>
#include <cmath>

#include "io/spikes/train_collector.hpp"
#include "io/table/npz.hpp"

namespace corpuscle {
namespace {

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

Result<std::vector<NamedTrain>> read_npz_spikes(const std::string& path) { return NpzSpikes(TRY(NpzReader::open(path))).read(); }

}  // namespace corpuscle
