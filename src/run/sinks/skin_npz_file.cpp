#include "run/sinks/skin_npz_file.hpp"

#include <cmath>
#include <numeric>

#include "run/sinks/npz_file.hpp"

namespace corpuscle {

void SkinNpzFile::put(const Clock& clock, std::span<const Spike> spikes) {
    auto since_start = clock;
    since_start.t0 = 0;
    for (const auto& s : spikes) {
        indexes_.push_back(std::llround(since_start.time(s.step, s.offset) * NpzFile::ticks_per_second));
        labels_.push_back(s.afferent_index);
        times_.push_back(clock.time(s.step, s.offset));
    }
}

Result<void> SkinNpzFile::block(const SkinInput& input, const SkinRunBlock& block) {
    return put(input.clock, block.spikes), Result<void>();
}

Result<void> SkinNpzFile::end(const SkinInput& input, std::int64_t, std::span<const Spike> last) {
    put(input.clock, last);
    const auto& skin = input.skin;
    std::vector<std::int64_t> ids(skin.afferents.size());
    std::iota(ids.begin(), ids.end(), std::int64_t{0});
    std::vector<std::string> names, regions;
    std::vector<double> x, y;
    for (std::size_t u = 0; u < skin.afferents.size(); ++u) {
        names.push_back(skin.afferent_name(u)), regions.push_back(skin.plan.sites.regions[skin.afferents[u].region]);
        x.push_back(skin.afferents[u].position.x), y.push_back(skin.afferents[u].position.y);
    }
    npz_.add("spike_indexes_seg0", indexes_), npz_.add("spike_labels_seg0", labels_), npz_.add("spike_times_seg0", times_);
    npz_.add("unit_ids", ids), npz_.add("num_segment", std::vector<std::int64_t>{1});
    npz_.add("sampling_frequency", std::vector{NpzFile::ticks_per_second});
    npz_.add("unit_afferent", names), npz_.add("unit_channel", regions);
    npz_.add("unit_x_m", x), npz_.add("unit_y_m", y);
    return {};
}

Result<void> SkinNpzFile::commit() {
    const auto bytes = npz_.bytes();
    if (!bytes) return bytes.error();
    if (auto ok = file_.write(*bytes); !ok) return ok;
    return file_.commit();
}

}  // namespace corpuscle
