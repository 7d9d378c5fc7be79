#pragma once
// Event formats, which encode spikes one after another: lines, JSON lines, binary address events, AEDAT 2 (doc/events.md). The bytes of a
// stream and of a file are the same.

#include <cmath>
#include <cstddef>
#include <string_view>

#include "core/spike.hpp"

namespace corpuscle {

/// Computes spike times as integer nanoseconds, whose precision does not depend on the length of the stream.
/// A cycle is rate_numerator samples, which last rate_denominator seconds. Complete cycles are counted as integers, and only the
/// remainder is a double, so a spike after a year is as precise as the first one.
class EventTime {
    std::int64_t samples_per_cycle_, cycle_ns_, start_ns_;  // cycle_ns_: length of a cycle; start_ns_: time of sample 0
    double sample_ns_;                                      // sample period

public:
    explicit EventTime(const Clock& clock)
        : samples_per_cycle_(clock.rate_numerator), cycle_ns_(clock.rate_denominator * 1'000'000'000),
          start_ns_(std::llround(clock.t0 * 1e9)),
          sample_ns_(static_cast<double>(clock.rate_denominator) * 1e9 / static_cast<double>(clock.rate_numerator)) {}

    /// The time of the spike, rounded to the nearest nanosecond.
    std::int64_t nanoseconds(const Spike& s) const {
        std::int64_t cycles = (s.step - 1) / samples_per_cycle_, rest = (s.step - 1) % samples_per_cycle_;
        if (rest < 0) rest += samples_per_cycle_, --cycles;
        return start_ns_ + cycles * cycle_ns_ +
               static_cast<std::int64_t>(std::floor((static_cast<double>(rest) + s.offset) * sample_ns_ + 0.5));
    }
};

/// Names and addresses of the afferents. All lists are indexed by Spike::afferent_index.
struct EventAddressing {
    Clock clock;
    std::vector<std::string> names;           ///< names that are unique in the run: "sa1#17"
    std::vector<std::uint32_t> addresses;     ///< empty: the afferent index is the address
    std::vector<std::string> afferents = {};  ///< names in text formats: "sa1" on a channel, "sa1#17" in a skin; empty: as `names`
    std::vector<std::string> channels = {};   ///< name of each afferent's channel or region: "press", "palm"; empty: without
};

/// Encodes spikes in one format.
class EventFormat {
public:
    virtual ~EventFormat() = default;
    virtual std::string_view name() const = 0;             ///< "lines", "jsonl", "aer" or "aedat2"
    virtual std::size_t max_bytes() const = 0;             ///< upper bound on the size of an encoded spike
    virtual bool has_fixed_size() const { return false; }  ///< true: every spike takes max_bytes(), false: every spike is a line
    virtual std::string header() const = 0;                ///< bytes before the first spike; may be ""
    /// Writes one spike at `at`, where max_bytes() must be free. Returns the number of bytes written. Does not allocate.
    virtual std::size_t write(const Spike&, char* at) const = 0;
};

/// Creates a format by name: "lines", "jsonl", "aer", "aedat2".
Result<std::unique_ptr<EventFormat>> make_event_format(std::string_view name, EventAddressing);

struct EventFormatInfo {
    std::string_view name, extension, description;  ///< extension: of files in this format, with the dot
};
/// All event formats.
std::span<const EventFormatInfo> event_formats();

std::unique_ptr<EventFormat> make_aer_format(const EventAddressing&);
std::unique_ptr<EventFormat> make_aedat2_format(const EventAddressing&);

}  // namespace corpuscle
