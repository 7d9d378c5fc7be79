#include "run/sinks/npz_file.hpp"

#include <cmath>
#include <numeric>

namespace corpuscle {

Result<void> NpzFile::begin(const Input& input) {
    for (std::size_t u = 0; u < input.afferent_count(); ++u) {
        afferents_.push_back(input.plan_of(u).name);
        channels_.push_back(input.channel_name(input.channel_of(u)));
    }
    return {};
}

Result<void> NpzFile::block(const Input& input, const RunBlock& block) {
    const auto& clock = input.source.clock();
    auto since_start = clock;
    since_start.t0 = 0;
    for (const auto& s : block.spikes) {
        indexes_.push_back(std::llround(since_start.time(s.step, s.offset) * ticks_per_second));
        labels_.push_back(s.afferent_index);
        times_.push_back(clock.time(s.step, s.offset));
    }
    return {};
}

Result<void> NpzFile::end(const Input&, std::int64_t) {
    npz_.add(fmt::format("spike_indexes_seg{}", segments_), indexes_);
    npz_.add(fmt::format("spike_labels_seg{}", segments_), labels_);
    npz_.add(fmt::format("spike_times_seg{}", segments_), times_);
    ++segments_;
    indexes_.clear(), labels_.clear(), times_.clear();
    return {};
}

Result<void> NpzFile::commit() {
    std::vector<std::int64_t> ids(afferents_.size());
    std::iota(ids.begin(), ids.end(), std::int64_t{0});
    npz_.add("unit_ids", ids);
    npz_.add("num_segment", std::vector{segments_});
    npz_.add("sampling_frequency", std::vector{ticks_per_second});
    npz_.add("unit_afferent", afferents_);
    npz_.add("unit_channel", channels_);
    const auto bytes = npz_.bytes();
    if (!bytes) return bytes.error();
    if (auto ok = file_.write(*bytes); !ok) return ok;
    return file_.commit();
}

}  // namespace corpuscle
