#pragma once
// Event formats, which encode spikes one after another: lines, JSON lines, binary address events, AEDAT 2 (doc/events.md). The bytes of a
// stream and of a file are the same.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/spike.hpp"

namespace corpuscle {

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
