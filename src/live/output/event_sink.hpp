#pragma once
// Destinations of a stream's events, which are its spikes in an output format. Events are put into a ring buffer of fixed size, which never
// blocks, and stay there until the reader accepts them. When the ring is full, the caller waits for space, or drops whole events and counts
// them.

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <functional>

#include "io/spikes/events.hpp"
#include "live/input/sockets.hpp"

namespace corpuscle {

/// Passes bytes from one thread to another without a lock: a ring buffer of fixed size with one writer and one reader. Both may be the same
/// thread.
class ByteRing {
    alignas(64) std::atomic<std::size_t> put_ = 0;  // number of bytes written so far; modulo the size it is the index of the next one
    std::vector<char> bytes_;
    alignas(64) std::atomic<std::size_t> taken_ = 0;  // number of bytes read so far

public:
    /// The size is at least `min_size` bytes, rounded up to a power of two.
    explicit ByteRing(std::size_t min_size) : bytes_(std::bit_ceil(std::max<std::size_t>(min_size, 64))) {}
    std::size_t size() const { return bytes_.size(); }
    std::size_t total_put() const { return put_.load(std::memory_order_acquire); }
    std::size_t total_taken() const { return taken_.load(std::memory_order_acquire); }
    /// Number of bytes that have been written and not yet read.
    std::size_t filled() const { return put_.load(std::memory_order_acquire) - taken_.load(std::memory_order_acquire); }

    bool has_space(std::size_t bytes) const { return bytes <= bytes_.size() - filled(); }

    /// Writes all of the text and returns true, or writes nothing and returns false if it does not fit. For the writing thread only.
    bool put(std::string_view text) {
        const auto at = put_.load(std::memory_order_relaxed);
        if (text.size() > bytes_.size() - (at - taken_.load(std::memory_order_acquire))) return false;
        const auto begin = at & (bytes_.size() - 1), first = std::min(text.size(), bytes_.size() - begin);
        std::memcpy(bytes_.data() + begin, text.data(), first);
        std::memcpy(bytes_.data(), text.data() + first, text.size() - first);
        put_.store(at + text.size(), std::memory_order_release);
        return true;
    }

    /// The next bytes to read, as far as they are contiguous in memory; empty if there are none. For the reading thread only, as consume().
    std::string_view readable() const {
        const auto at = taken_.load(std::memory_order_relaxed), filled = put_.load(std::memory_order_acquire) - at;
        const auto begin = at & (bytes_.size() - 1);
        return {bytes_.data() + begin, std::min(filled, bytes_.size() - begin)};
    }
    /// Removes the first `bytes` bytes of readable().
    void consume(std::size_t bytes) { taken_.store(taken_.load(std::memory_order_relaxed) + bytes, std::memory_order_release); }
};

/// How long a sink waits, at the end of a stream, for a reader that accepts nothing.
struct FinishPolicy {
    std::int64_t timeout = 1'000'000'000;               ///< ns
    bool waits_for_stop = false;                        ///< true: waits without limit until stop() returns true, then for `timeout`
    std::function<bool()> stop = [] { return false; };  ///< called at least ten times a second
};

class EventSink {
protected:
    ByteRing ring_;
    const EventFormat& format_;
    std::int64_t dropped_ = 0, connections_ = 1;  // see dropped() and connections()
    std::size_t header_end_ = 0;                  // ring_.total_put() just after the last header; events begin there

    void put_header() { ring_.put(format_.header()), header_end_ = ring_.total_put(); }
    void drop_all();  ///< discards the contents of the ring, and counts the events among them

public:
    /// `ring`: size of the ring buffer in bytes; a larger one is used if it would be too small for a few events.
    EventSink(const EventFormat& format, std::size_t ring)
        : ring_(std::max(ring, 4 * format.max_bytes()) + format.header().size()), format_(format) {}
    virtual ~EventSink() = default;

    /// Puts a whole event into the ring; returns false if there is no space for it.
    bool put(std::string_view event) { return ring_.put(event); }
    /// Waits up to `ms` milliseconds for space for `bytes`. Returns false if there is still not enough.
    virtual Result<bool> wait_for_space(std::size_t bytes, int ms) = 0;
    /// True for a file. It always accepts data sooner or later, so the caller waits for space and drops nothing.
    virtual bool is_file() const { return false; }
    /// Writes as much as possible without blocking.
    virtual Result<void> flush() = 0;
    /// A descriptor to poll for writing before flush() is called; -1: flush() need not be called.
    virtual int poll_fd() const { return -1; }
    /// Writes everything that is left, as long as the reader accepts it.
    virtual Result<void> finish(const FinishPolicy&) = 0;
    virtual std::string description() const = 0;
    std::int64_t dropped() const { return dropped_; }  ///< number of events discarded from the ring, because no reader accepted them
    std::int64_t connections() const { return connections_; }  ///< number of connections so far, of which one is open at a time
};

/// A sink that writes to standard output, which may be a pipe, a terminal or a file. Writing is an error if the reader has closed it.
Result<std::unique_ptr<EventSink>> open_standard_output(const EventFormat&, std::size_t ring);

/// A sink that writes to `fd`, an open pipe, terminal or socket. `own` is the same descriptor if the sink shall close it, otherwise empty.
std::unique_ptr<EventSink> make_pipe_sink(Descriptor own, int fd, std::string name, const EventFormat&, std::size_t ring);

/// A sink that writes to the open descriptor `fd` of a file, and does not close it. `name` is for messages.
Result<std::unique_ptr<EventSink>> make_file_sink(int fd, const std::string& name, const EventFormat&, std::size_t ring);

/// A sink that discards all events; they do not count as dropped.
std::unique_ptr<EventSink> make_null_sink(const EventFormat&, std::size_t ring);

/// A sink that creates a file. It is written as PATH.part and renamed when it is complete; a named pipe is written directly.
Result<std::unique_ptr<EventSink>> create_event_file(const std::string& path, const EventFormat&, std::size_t ring);

/// A sink that connects as a TCP client. If the connection is lost, it tries to reconnect once a second; events in between are dropped and
/// counted. The name is resolved once, before this function returns, because the name service might not respond later.
Result<std::unique_ptr<EventSink>> connect_event_client(const std::string& endpoint, const EventFormat&, std::size_t ring);
Result<std::unique_ptr<EventSink>> connect_event_client(ResolvedEndpoint, const EventFormat&, std::size_t ring);

}  // namespace corpuscle
