#pragma once
// Sources of the bytes of frames: standard input, a socket, a serial line.

#include <memory>
#include <span>
#include <string>

#include "live/steady_clock.hpp"
#include "signal/error.hpp"

namespace corpuscle {

/// Result of a read.
struct ReadResult {
    enum Status {
        bytes,    ///< `count` bytes
        nothing,  ///< nothing yet
        disconnected,///< the sender has disconnected; another may connect
        end,      ///< no more data
    } status;
    std::size_t count = 0;
    bool is_new_sender = false;  ///< these are the first bytes of another sender
};

/// Statistics of senders on a network.
struct SenderCounts {
    std::int64_t idle = 0;     ///< senders that were replaced by another, because they were idle for the time limit
    std::int64_t ignored = 0;  ///< datagrams of senders other than the current one; ignored
    std::int64_t dropped = 0;  ///< datagrams dropped by the system because they were not read fast enough
};

class ByteSource {
public:
    virtual ~ByteSource() = default;
    virtual int poll_fd() const = 0;                                ///< file descriptor to poll for reading
    virtual std::int64_t due_time() const { return steady_never; }  ///< steady_now() at which it must be read even if nothing has arrived
    virtual Result<ReadResult> read(std::span<char>) = 0;
    virtual std::string description() const = 0;  ///< "listening on 127.0.0.1:7000"
    /// Requests that poll() reports bytes only after this number has arrived. A source that cannot do this ignores the request.
    virtual void set_low_watermark(std::size_t) {}
    virtual std::int64_t sender_count() const { return 1; }  ///< senders so far
    virtual SenderCounts sender_counts() const { return {}; }
    virtual bool has_one_sender() const { return true; }  ///< false: others may connect, so an error of one sender does not end the stream
    virtual bool is_live() const { return true; }         ///< false: a file, which can wait
    virtual bool has_datagrams() const { return false; }  ///< each read returns one datagram, which contains whole frames
    virtual std::size_t unread_bytes() const;             ///< bytes that have arrived but have not been read
};

Result<std::unique_ptr<ByteSource>> open_standard_input();

/// Limits for the senders on a network, which send one after another.
struct SenderLimits {
    std::int64_t clients = 0;            ///< the stream ends after this many; 0: never
    std::int64_t idle = 10'000'000'000;  ///< ns; a sender that is silent for this time is replaced if another connects; 0: never
};

/// Listens on a port (0: any free one) of a local address, for one client at a time. The next is accepted after it has disconnected.
Result<std::unique_ptr<ByteSource>> listen_on(const std::string& address, int port, const SenderLimits&);

/// The same for datagrams, from one sender at a time. Each contains whole frames; an empty one means that its sender has finished.
Result<std::unique_ptr<ByteSource>> receive_datagrams(const std::string& address, int port, const SenderLimits&);
/// Maximum size of a datagram, bytes.
inline constexpr std::size_t max_datagram = 65507;

/// A serial device: raw bytes at `baud`, 8 bits, no parity, one stop bit.
Result<std::unique_ptr<ByteSource>> open_serial(const std::string& path, long baud);

}  // namespace corpuscle
