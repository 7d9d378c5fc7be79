// Arbitrary bytes as a table with several trials, identified by its column "trial". The first byte selects options. Expected: recordings with
// finite forces, or an error that names an existing line.

#include "io/recording/trial_recordings.hpp"

#include <cmath>

#include "recording.hpp"

using namespace corpuscle;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    static const std::string path = "/tmp/corpuscle-fuzz-trials-" + std::to_string(::getpid()) + ".csv";
    static const bool once = [] { return std::atexit([] { std::remove(path.c_str()); }), true; }();
    (void)once;
    if (std::FILE* f = std::fopen(path.c_str(), "wb")) {
        std::fwrite(data + 1, 1, size - 1, f);
        std::fclose(f);
    }
    RecordingOptions options;
    if (data[0] & 1) options.rate = 100;
    if (data[0] & 2) options.bad_fields = BadFields::interpolate;
    if (data[0] & 4) options.bad_fields = BadFields::drop;
    if (data[0] & 8) options.calibrations = {{"", {0, std::pair(0.0, 0.1)}, CalibrationPoint{0, std::pair(0.1, 1.0)}, 2}};
    TrialColumns columns{{"trial"}, {}};
    if (data[0] & 16) columns.label = "label";
    constexpr auto any_line = std::numeric_limits<long>::max();
    auto trials = open_trial_recordings(path, options, columns);
    if (!trials) return fuzz::check(trials.error(), any_line), 0;
    fuzz::require(!trials->empty());
    for (auto& trial : *trials) {
        Frames block(trial.source->channels().size(), 64);
        for (int k = 0; k < 20; ++k) {
            if (const auto ok = trial.source->read(block); !ok) {
                fuzz::check(ok.error(), any_line);
                break;
            }
            if (block.count == 0) break;
            for (const auto& channel : block.force)
                for (std::size_t n = 0; n < block.count; ++n) fuzz::require(std::isfinite(channel[n]));
        }
    }
    return 0;
}
