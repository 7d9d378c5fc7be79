// spikes.npz: the arrays that SpikeInterface's NpzSortingExtractor reads (unit_ids, num_segment, sampling_frequency, spike_indexes_seg0,
// spike_labels_seg0), with one segment for each input. A unit is an afferent; its id is Spike::afferent_index. The names of the
// afferents are unit_afferent and unit_channel, their positions in a skin unit_x_m and unit_y_m. The array spike_times_seg0 has the exact
// times in s on the clock of the input. The indexes count microseconds from the segment's first sample, which is finer than the timing of
// any nerve. The spikes are kept in memory until the end, because the length of an array precedes its data.

#include <cmath>
#include <numeric>

#include "io/table/npz.hpp"
#include "run/sinks/file_sink.hpp"

namespace corpuscle {
namespace {

constexpr double ticks_per_second = 1e6;  // sampling_frequency; a tick is the unit of the indexes

class NpzFile final : public SpikeFileSink {
    NpzWriter npz_;
    std::vector<std::string> afferents_, channels_;  // of each afferent of all inputs
    std::vector<double> x_, y_;                      // m, of each afferent with a position
    std::vector<std::int64_t> indexes_, labels_;     // of the current segment
    std::vector<double> times_;                      // of the current segment, s
    std::int64_t segments_ = 0;                      // completed segments

    Result<void> add(const Input& input, std::span<const Spike> spikes) override {
        const auto since_start = input.clock_since_start();
        for (const auto& s : spikes) {
            indexes_.push_back(std::llround(since_start.time(s.step, s.offset) * ticks_per_second));
            labels_.push_back(s.afferent_index);
            times_.push_back(input.clock.time(s.step, s.offset));
        }
        return {};
    }

public:
    using SpikeFileSink::SpikeFileSink;
    Result<void> open() { return create("spikes.npz"); }
    Result<void> begin(const Input& input) override {
        for (std::size_t u = 0; u < input.population.size(); ++u) {
            afferents_.push_back(input.population.afferent_name(u));
            channels_.push_back(input.population.channel_name(u));
            if (const auto position = input.population.position(u)) x_.push_back(position->x), y_.push_back(position->y);
        }
        return {};
    }
    Result<void> end(const Input& input, std::int64_t, std::span<const Spike> last) override {
        TRY(add(input, last));
        npz_.add(fmt::format("spike_indexes_seg{}", segments_), indexes_);
        npz_.add(fmt::format("spike_labels_seg{}", segments_), labels_);
        npz_.add(fmt::format("spike_times_seg{}", segments_), times_);
        ++segments_;
        indexes_.clear(), labels_.clear(), times_.clear();
        return {};
    }
    Result<void> commit() override {
        std::vector<std::int64_t> ids(afferents_.size());
        std::iota(ids.begin(), ids.end(), std::int64_t{0});
        npz_.add("unit_ids", ids);
        npz_.add("num_segment", std::vector{segments_});
        npz_.add("sampling_frequency", std::vector{ticks_per_second});
        npz_.add("unit_afferent", afferents_);
        npz_.add("unit_channel", channels_);
        if (!x_.empty()) npz_.add("unit_x_m", x_), npz_.add("unit_y_m", y_);
        const auto bytes = TRY(npz_.bytes());
        TRY(files_[0].write(bytes));
        return FileSink::commit();
    }
};

}  // namespace

extern const OutputFormat npz_format = {
    .names = {"spikes.npz"},
    .option = "--npz",
    .help = "with --out, also write spikes.npz: exact times for NumPy and SpikeInterface",
    .make = make_file_sink<NpzFile>,
};

}  // namespace corpuscle
