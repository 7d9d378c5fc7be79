#pragma once
// The recording options as they apply to live frames. doc/live.md has the same table.

#include <string_view>

namespace corpuscle {

enum class LiveEffect { same, different, refused };

struct LiveOption {
    std::string_view option;
    LiveEffect effect;      ///< in comparison with the same recording
    std::string_view text;  ///< same, different: the effect; refused: the reason, with a remedy
};

inline constexpr std::string_view only_in_a_file = "it describes a file; the sender decides what it sends, and in which order";
inline constexpr std::string_view times_follow_from_the_rate =
    "the time of a frame is its number divided by --rate; use --stamp time if frames begin with their time";

inline constexpr LiveOption live_options[] = {
    {"--rate", LiveEffect::same, "the rate of the frames; it is required"},
    {"--unit", LiveEffect::same, "as for a recording"},
    {"--scale", LiveEffect::same, "as for a recording"},
    {"--offset", LiveEffect::same, "as for a recording"},
    {"--abs", LiveEffect::same, "as for a recording"},
    {"--notch", LiveEffect::same, "as for a recording; not together with --save-state and --resume"},
    {"--lowpass", LiveEffect::same, "as for a recording; not together with --save-state and --resume"},
    {"--layout", LiveEffect::same, "as for a recording; `channel` is the position in the frame"},
    {"--range", LiveEffect::different, "a reading out of range is replaced by the last force of its site, not interpolated"},
    {"--bad-fields", LiveEffect::refused,
     "a reading that is not valid is replaced by the last force of its site, because the next one is not known; remove the option"},
    {"--channel", LiveEffect::refused,
     "every number of a frame belongs to a site, in the order of the sites or of --layout; send only these columns, as cut -d, -f2 does"},
    {"--despike", LiveEffect::refused, "it needs twelve later readings, and live frames are processed at once; use --range or --lowpass"},
    {"--resample", LiveEffect::refused,
     "it needs later readings, and live frames are processed at once; send frames of the rate that --rate says"},
    {"--time", LiveEffect::refused, times_follow_from_the_rate},
    {"--time-unit", LiveEffect::refused, times_follow_from_the_rate},
    {"--skip", LiveEffect::refused, "it describes a file; send frames without these lines, as tail -n +3 does"},
    {"--dataset", LiveEffect::refused, only_in_a_file},
    {"--transpose", LiveEffect::refused, only_in_a_file},
    {"--no-transpose", LiveEffect::refused, only_in_a_file},
};

}  // namespace corpuscle
