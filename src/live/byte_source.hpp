#pragma once
// Where bytes of frames come from: standard input, a socket, a serial line.

#include <memory>
#include <span>
#include <string>

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
};

class ByteSource {
public:
    virtual ~ByteSource() = default;
    virtual int waits_on() const = 0;  ///< to be polled for reading
    virtual Result<Came> read(std::span<char>) = 0;
    virtual std::string sentence() const = 0;  ///< "127.0.0.1, port 7000"
    /// There is no hurry to read fewer bytes than these: a source that can lets the reader sleep until so many are there.
    virtual void enough(std::size_t) {}
    virtual std::int64_t producers() const { return 1; }  ///< that sent until now
};

Result<std::unique_ptr<ByteSource>> standard_input();

/// Listens at a port (0: any that is free) of an address of this machine, for one client at a time, the next when it has gone; ends after
/// `clients` of them (0: never).
Result<std::unique_ptr<ByteSource>> listen_on(const std::string& address, int port, std::int64_t clients);

/// A serial device: raw bytes at so many baud, 8 bits, no parity, one stop bit.
Result<std::unique_ptr<ByteSource>> open_serial(const std::string& path, long baud);

}  // namespace corpuscle
