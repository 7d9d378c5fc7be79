#pragma once
// The arguments of `corpuscle stream`, the frame source that they describe, the reports about a stream, and the function that runs it.

#include "cli/arguments/shared_arguments.hpp"
#include "live/stream_loop.hpp"
#include "skin/taxel/taxel_layout.hpp"

namespace corpuscle {

struct StreamArguments {
    std::string population = "sa1,fa1", in = "-", listen = "127.0.0.1", frames = "csv", stamp = "none", pace = "real";
    std::string taxels;  ///< file with the layout of the taxels; "": not given
    std::vector<ParameterOverride> settings;
    RecordingOptions recording;                          ///< live_options says which of them apply to live frames
    double max_force = 1e3;                              ///< N
    double hold = 0.1, max_gap = 10, idle_timeout = 10;  ///< s
    double buffer = 1e6;                                 ///< bytes
    std::string out = "-", to, format = "lines", save_state, resume;
    std::uint64_t channel_count = 1;  ///< forces per frame, if `population` is a list of afferents
    std::uint64_t batch_frames = 1;   ///< frames per batch
    std::int64_t clients = 0;         ///< number of senders, one after another, after which the stream ends; 0: unlimited
    std::int64_t baud = 115200;
    std::optional<std::uint32_t> serve;        ///< port of the page server; not set: no server
    std::string bind;                          ///< address of the page server; "": loopback
    std::optional<std::uint32_t> max_viewers;  ///< number of pages that may be connected to it
    bool sampled = false, busy_poll = false, allow_drops = false;
};

// The recording options as they apply to live frames. doc/live.md has the same table.

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
    {"--calibrate", LiveEffect::refused, "give --offset and --scale; 'corpuscle respond' prints them for a recording that is calibrated"},
    {"--abs", LiveEffect::same, "as for a recording"},
    {"--notch", LiveEffect::same, "as for a recording; not together with --save-state and --resume"},
    {"--lowpass", LiveEffect::same, "as for a recording; not together with --save-state and --resume"},
    {"--zero", LiveEffect::same, "as for a recording; not together with --save-state and --resume"},
    {"--deadband", LiveEffect::same, "as for a recording; not together with --save-state and --resume"},
    {"--layout", LiveEffect::same, "as for a recording; `channel` is the position in the frame"},
    {"--range", LiveEffect::different, "a reading out of range is replaced by the last force of its site, not interpolated"},
    {"--bad-fields", LiveEffect::refused,
     "a reading that is not valid is replaced by the last force of its site, because the next one is not known; remove the option"},
    {"--channel", LiveEffect::refused,
     "every number of a frame belongs to a site, in the order of the sites or of --layout; send only these columns, as cut -d, -f2 does"},
    {"--despike", LiveEffect::refused, "it needs twelve later readings, and live frames are processed at once; use --range or --lowpass"},
    {"--resample", LiveEffect::refused,
     "it needs later readings, and live frames are processed at once; send frames of the rate that --rate says"},
    {"--interpolation", LiveEffect::refused,
     "it needs later readings, and live frames are processed at once; send frames of the rate that --rate says"},
    {"--time", LiveEffect::refused, times_follow_from_the_rate},
    {"--time-unit", LiveEffect::refused, times_follow_from_the_rate},
    {"--skip", LiveEffect::refused, "it describes a file; send frames without these lines, as tail -n +3 does"},
    {"--dataset", LiveEffect::refused, only_in_a_file},
    {"--transpose", LiveEffect::refused, only_in_a_file},
    {"--no-transpose", LiveEffect::refused, only_in_a_file},
};

/// True for a live input (-, tcp:PORT, udp:PORT, serial:DEVICE), false for a recording or a stimulus.
bool is_live_input(const std::string& in);
/// The name of an input in messages: "standard input" for "-", otherwise as typed, such as "tcp:7000" or "grip.csv".
std::string input_name(const std::string& in);

/// Opens the recording, read as by `respond`, or the stimulus of --in.
Result<Applied<std::unique_ptr<ForceSource>>> open_stream_source(const StreamArguments&, const CommonArguments&);

/// Returns an error, with the reason, if a recording option was given that live frames cannot have.
Result<void> check_live_options(const StreamArguments&, const CommonArguments&);
/// The clock of live frames.
Result<Clock> live_clock(const StreamArguments&);
/// The layout of live frames. `sites`: number of forces in a frame.
Result<FrameLayout> live_layout(const StreamArguments&, std::size_t sites, const Clock&);
/// Opens a live input: standard input, a port or a serial device.
Result<std::unique_ptr<ByteSource>> open_live_input(const StreamArguments&, const FrameLayout&);

/// Makes the function that interprets the headers of live frames: the site, or taxel, and the unit of each column. `mapped` is the site of
/// each column by --layout, or empty. `report` receives notes about the units. The arguments must outlive the function.
HeaderReader make_header_reader(const StreamArguments&, const Sites&, const TaxelLayout*, std::vector<std::uint32_t> mapped,
                                std::function<void(const std::vector<std::string>& notes)> report);

/// The last remedy for a column of live frames that is not a force.
inline constexpr std::string_view send_only_forces = "send only the columns that are forces, as cut -d, -f2 does";

class StreamPage;

/// The parts of a running or finished stream that the reports read.
struct StreamReportInput {
    const SkinStream& skin;
    const FrameSource& frames;
    const EventSink& sink;
    const EventFormat& format;
    const StreamLoop& loop;
    const StreamPage* page;  ///< null: without a page server
};

/// The summary at the end of a stream.
std::string stream_summary(const StreamReportInput&);
/// The status line during a stream.
std::string stream_status(const StreamReportInput&);
/// The summary as a JSON document.
nlohmann::ordered_json stream_document(const StreamReportInput&);

/// Runs one live stream until its input ends: opens input, skin and output, simulates, and prints a summary. If it is interrupted, which is
/// an error, the summary has been printed.
Result<void> run_live(const StreamArguments&, const CommonArguments&);

}  // namespace corpuscle
