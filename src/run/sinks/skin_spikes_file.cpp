#include "run/sinks/skin_spikes_file.hpp"

#include <iterator>

#include "io/spikes/spike_files.hpp"

namespace corpuscle {

SkinSpikesFile::SkinSpikesFile(OutputFile file) : file_(std::move(file)) {
    (void)file_.write("afferent,channel,time_s\n");  // commit() reports an error
}

Result<void> SkinSpikesFile::begin(const SkinInput& input) {
    names_and_regions_.clear();
    for (std::size_t u = 0; u < input.skin.afferents.size(); ++u)
        names_and_regions_.push_back(quote_csv_field(input.skin.afferent_name(u)) + "," +
                                     quote_csv_field(input.skin.plan.sites.regions[input.skin.afferents[u].region]));
    return {};
}

Result<void> SkinSpikesFile::put(const Clock& clock, std::span<const Spike> spikes) {
    text_.clear();
    for (const auto& s : spikes)
        fmt::format_to(std::back_inserter(text_), "{},{:.9f}\n", names_and_regions_[s.afferent_index], clock.time(s.step, s.offset));
    return file_.write({text_.data(), text_.size()});
}

Result<void> SkinSpikesFile::block(const SkinInput& input, const SkinRunBlock& block) { return put(input.clock, block.spikes); }

Result<void> SkinSpikesFile::end(const SkinInput& input, std::int64_t, std::span<const Spike> last) { return put(input.clock, last); }

}  // namespace corpuscle
