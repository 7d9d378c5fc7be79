#include "io/wav_table.hpp"

#include <fmt/format.h>

#include "io/remote_samples.hpp"

namespace corpuscle {

Result<std::unique_ptr<Table>> open_wav_table(const std::string& path, const TableOptions& options) {
    if (options.dataset) return bad_usage(fmt::format("--dataset {}: a sound file has only one array", *options.dataset));
    if (options.transpose) return bad_usage("--transpose: in a sound file each channel is known");
    return table_of(remote_samples(path, {"corpuscle-sound", "libsndfile"}, options), path);
}

}  // namespace corpuscle
