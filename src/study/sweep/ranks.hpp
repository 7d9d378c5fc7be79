#pragma once
// Processes of one sweep, started together by mpirun, that exchange messages. Only ranks.cpp uses MPI. The MPI library is loaded by join(),
// so that a start without mpirun does not take the time to load it.

#include <memory>
#include <optional>
#include <string>

#include "signal/error.hpp"

namespace corpuscle {

class Ranks {
public:
    /// True if mpirun, or another launcher, started more than one process.
    static bool are_started();
    /// True for the first process or the only one. Only this process prints errors that occur in all processes.
    static bool reports_errors();
    /// Initialises MPI, which waits for all other processes.
    static Result<std::unique_ptr<Ranks>> join();
    ~Ranks();

    int rank() const;
    int size() const;
    /// True if the launcher keeps the other processes alive when one dies, or if this is unknown.
    bool survive_death_of_one() const;

    /// Does not block; the message is kept until it has been sent.
    void send(int to, std::string message);
    std::size_t unsent() const;  ///< number of kept messages
    struct Received {
        int from;
        std::string message;
    };
    /// A completely received message, if there is one.
    std::optional<Received> receive();
    /// Drops the messages that are kept for this rank, because it is dead.
    void drop_messages_to(int rank);
    /// Ends the communication of this rank. `together`: all ranks are alive and leave as well; otherwise the process must exit at once.
    void leave(bool together);
    bool left_together() const { return left_together_; }

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    bool left_together_ = true;
    explicit Ranks(std::unique_ptr<Impl>);
};

}  // namespace corpuscle
