#pragma once
// Where bytes of frames come from: standard input, a socket, a serial line.

#include <memory>
#include <span>
#include <string>

#include "live/steady_clock.hpp"
#include "signal/error.hpp"

namespace corpuscle {

/// What a read found.
struct Came {
    enum What {
        bytes,    ///< so many
        nothing,  ///< for now
        gone,     ///< whoever sent has gone; another may come
        end,      ///< nothing more will come
    } what;
    std::size_t count = 0;
    bool from_another = false;  ///< these bytes are the first of another sender
};

/// Of senders on a network.
struct SenderCounts {
    std::int64_t idle = 0;       ///< that had sent nothing for the idle limit when another wanted to send
    std::int64_t strangers = 0;  ///< datagrams of others than the one whose turn it was, left out
    std::int64_t lost = 0;       ///< datagrams that came faster than they were read: the system had no room for them
};

class ByteSource {
public:
    virtual ~ByteSource() = default;
    virtual int waits_on() const = 0;                          ///< to be polled for reading
    virtual std::int64_t due() const { return steady_never; }  ///< when it is to be read whether anything came or not
    virtual Result<Came> read(std::span<char>) = 0;
    virtual std::string sentence() const = 0;  ///< "127.0.0.1, port 7000"
    /// There is no hurry to read fewer bytes than these: a source that can lets the reader sleep until so many are there.
    virtual void enough(std::size_t) {}
    virtual std::int64_t producers() const { return 1; }  ///< that sent until now
    virtual SenderCounts senders() const { return {}; }
    virtual bool has_one_sender() const { return true; }  ///< false: others may come, of whom one that errs ends nothing
    virtual bool is_live() const { return true; }         ///< false: a file, which can wait
    virtual bool has_datagrams() const { return false; }  ///< each read gives one datagram, of whole frames
    virtual std::size_t unread() const;                   ///< bytes that have come and wait to be read
};

Result<std::unique_ptr<ByteSource>> standard_input();

/// Who may send over the network, one after another.
struct SenderLimits {
    std::int64_t clients = 0;            ///< the stream ends after so many; 0: never
    std::int64_t idle = 10'000'000'000;  ///< ns: a sender that was silent for so long makes way for another that wants to send; 0: never
};

/// Listens at a port (0: any that is free) of an address of this machine, for one client at a time, the next when it has gone.
Result<std::unique_ptr<ByteSource>> listen_on(const std::string& address, int port, const SenderLimits&);

/// The same for datagrams: each holds whole frames, and an empty one says that its sender has ended. One sender at a time.
Result<std::unique_ptr<ByteSource>> receive_datagrams(const std::string& address, int port, const SenderLimits&);
/// A datagram holds no more bytes.
inline constexpr std::size_t max_datagram = 65507;

/// A serial device: raw bytes at so many baud, 8 bits, no parity, one stop bit.
Result<std::unique_ptr<ByteSource>> open_serial(const std::string& path, long baud);

}  // namespace corpuscle
