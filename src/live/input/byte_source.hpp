#pragma once
// Sources of bytes, which contain frames: standard input, a socket, a serial line.

#include <chrono>
#include <cstdint>
#include <limits>
#include <span>

#include "core/error.hpp"

namespace corpuscle {

/// The time of a clock that never jumps, in nanoseconds since an arbitrary time.
inline std::int64_t steady_now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A time that steady_now() does not reach: never.
inline constexpr std::int64_t steady_never = std::numeric_limits<std::int64_t>::max();

/// Result of a read.
struct ReadResult {
    enum Status {
        bytes,         ///< `count` bytes have been read
        nothing,       ///< no bytes have arrived yet
        disconnected,  ///< the sender has disconnected; another may connect
        end,           ///< there will be no more bytes
    } status;
    std::size_t count = 0;
    bool is_new_sender = false;  ///< true: the bytes are the first ones of another sender than before
};

/// Statistics of senders on a network.
struct SenderCounts {
    std::int64_t idle = 0;     ///< number of senders that were replaced by another one after SenderLimits::idle
    std::int64_t ignored = 0;  ///< number of datagrams that were ignored because they came from another sender than the current one
    std::int64_t dropped = 0;  ///< number of datagrams that the system dropped because they were not read fast enough
};

class ByteSource {
public:
    virtual ~ByteSource() = default;
    virtual int poll_fd() const = 0;  ///< file descriptor to poll for reading
    /// The steady_now() at which read() must be called even if nothing has arrived.
    virtual std::int64_t due_time() const { return steady_never; }
    virtual Result<ReadResult> read(std::span<char> out) = 0;  ///< reads what has arrived, without waiting
    virtual std::string description() const = 0;               ///< "listening on 127.0.0.1:7000"
    /// Requests that poll() reports bytes only after this number of bytes has arrived. A source that cannot do this ignores the request.
    virtual void set_low_watermark(std::size_t) {}
    virtual std::int64_t sender_count() const { return 1; }  ///< number of senders so far
    virtual SenderCounts sender_counts() const { return {}; }
    virtual bool has_one_sender() const { return true; }  ///< false: another may connect later, so an error of one does not end the stream
    virtual bool is_live() const { return true; }         ///< false: the source is a file, so its bytes can wait
    virtual bool has_datagrams() const { return false; }  ///< true: each read() returns one datagram, which must consist of whole frames
    virtual std::size_t unread_bytes() const;             ///< bytes that have arrived but have not been read
};

Result<std::unique_ptr<ByteSource>> open_standard_input();

/// Limits for senders on a network, of which only one at a time is accepted.
struct SenderLimits {
    std::int64_t clients = 0;            ///< number of senders after which the stream ends; 0: never
    std::int64_t idle = 10'000'000'000;  ///< ns; a sender that is silent for this time is replaced if another one connects; 0: never
};

/// Listens on a port (0: any free one) of a local address, for one client at a time. The next client is accepted after this one has
/// disconnected or has been idle for the limit.
Result<std::unique_ptr<ByteSource>> listen_on(const std::string& address, int port, const SenderLimits&);

/// Receives datagrams at a port of a local address, from one sender at a time. An empty datagram means that its sender has finished.
Result<std::unique_ptr<ByteSource>> receive_datagrams(const std::string& address, int port, const SenderLimits&);
/// Maximum size of a datagram, bytes.
inline constexpr std::size_t max_datagram = 65507;

/// Opens a serial device for raw bytes at `baud` bits per second, with 8 data bits, no parity and one stop bit.
Result<std::unique_ptr<ByteSource>> open_serial(const std::string& path, long baud);

}  // namespace corpuscle
