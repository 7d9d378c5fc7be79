#pragma once
// Spikes as bytes, one after another as they come: lines, JSON lines, binary address events, AEDAT 2 (doc/events.md). What a stream
// writes and what a file holds are the same bytes.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"
#include "signal/spike.hpp"

namespace corpuscle {

/// How events are addressed: what each unit is called, and its address. All by unit.
struct EventUnits {
    Clock clock;
    std::vector<std::string> names;           ///< "sa1#17"
    std::vector<std::uint32_t> addresses;     ///< empty: the unit's number
    std::vector<std::string> afferents = {};  ///< as text formats call it: "sa1" on a channel, "sa1#17" in a skin; empty: the name
    std::vector<std::string> channels = {};   ///< "press", "palm"; empty: none
};

class EventFormat {
public:
    virtual ~EventFormat() = default;
    virtual std::string_view name() const = 0;        ///< "lines"
    virtual std::size_t most_bytes() const = 0;       ///< of one spike
    virtual bool same_size() const { return false; }  ///< every spike takes most_bytes(); else each is a line
    virtual std::string header() const = 0;           ///< what comes before the first; "" if nothing does
    /// Writes one spike at `at`, where most_bytes() are free; returns how many it took. Allocates nothing.
    virtual std::size_t put(const Spike&, char* at) const = 0;
};

/// "lines", "jsonl", "aer", "aedat2".
Result<std::unique_ptr<EventFormat>> event_format(std::string_view name, EventUnits);

struct EventFormatName {
    std::string_view name, extension, sentence;
};
std::span<const EventFormatName> event_formats();

}  // namespace corpuscle
