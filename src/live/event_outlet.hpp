#pragma once
// Where a stream's events go. They are put into a ring of fixed size, which takes no time; a slow reader's wait there. When it is full,
// the caller waits for room, or leaves whole events out and counts them.

#include <functional>
#include <memory>
#include <string>

#include "io/events.hpp"
#include "live/byte_ring.hpp"
#include "live/descriptor.hpp"
#include "live/network.hpp"

namespace corpuscle {

/// How long a reader is waited for at the end that takes nothing.
struct EventPatience {
    std::int64_t longest = 1'000'000'000;               ///< ns
    bool is_endless = false;                            ///< that counts from when it is stopped
    std::function<bool()> stop = [] { return false; };  ///< asked at least ten times a second
};

class EventOutlet {
protected:
    ByteRing ring_;
    const EventFormat& format_;
    std::int64_t lost_ = 0, readers_ = 1;
    std::size_t header_end_ = 0;  // of all bytes that were put

    void put_header() { ring_.put(format_.header()), header_end_ = ring_.all_put(); }
    void lose_all();  ///< what is in the ring, counted

public:
    EventOutlet(const EventFormat& format, std::size_t ring)
        : ring_(std::max(ring, 4 * format.most_bytes()) + format.header().size()), format_(format) {}
    virtual ~EventOutlet() = default;

    /// A whole event, or nothing: the ring is full.
    bool take(std::string_view event) { return ring_.put(event); }
    /// Waits for room for so many bytes, at most for so long; false: there is none yet.
    virtual Result<bool> wait_for_room(std::size_t bytes, int ms) = 0;
    /// Room comes as fast as a disk writes, and no reader can withhold it: nothing is ever left out.
    virtual bool is_file() const { return false; }
    /// Writes what can be written without waiting.
    virtual Result<void> flush() = 0;
    /// To be polled for writing, then flush() is to be called; -1: nothing waits to be written here.
    virtual int waits_on() const { return -1; }
    /// All that is left, as long as somebody takes it.
    virtual Result<void> finish(const EventPatience&) = 0;
    virtual std::string sentence() const = 0;
    std::int64_t lost() const { return lost_; }        ///< events that were in the ring when their reader went
    std::int64_t readers() const { return readers_; }  ///< connections, one after another
};

/// A pipe, a terminal, a file: what standard output is. An error when nobody reads it any more.
Result<std::unique_ptr<EventOutlet>> standard_output(const EventFormat&, std::size_t ring);

/// A pipe, a terminal, a socket that somebody has opened; `own` closes with it.
std::unique_ptr<EventOutlet> pipe_outlet(Descriptor own, int fd, std::string name, const EventFormat&, std::size_t ring);

/// A file, which grows as PATH.part and has its name when it is whole; a named pipe is written as it is.
Result<std::unique_ptr<EventOutlet>> event_file(const std::string& path, const EventFormat&, std::size_t ring);

/// A reader who listens; once gone it is tried again every second, and what comes meanwhile is left out and counted. The name service is
/// asked once, before this returns: it might not answer later.
Result<std::unique_ptr<EventOutlet>> event_client(const std::string& endpoint, const EventFormat&, std::size_t ring);
Result<std::unique_ptr<EventOutlet>> event_client(ResolvedEndpoint, const EventFormat&, std::size_t ring);

}  // namespace corpuscle
