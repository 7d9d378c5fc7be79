#pragma once
// Ranks: processes that mpirun starts together for one command, a sweep or a skin, and that exchange messages. Only ranks.cpp uses MPI.
// join() loads the MPI library, so that a start without mpirun does not take the time to load it.

#include <memory>
#include <optional>
#include <string>

#include "core/error.hpp"

namespace corpuscle {

/// The communication of this process, which is one of the ranks, with the others.
class Ranks {
public:
    /// True if mpirun, or another launcher, started more than one process.
    static bool are_started();
    /// True for rank 0 and for a process without mpirun: this process prints the errors that occur in all processes.
    static bool reports_errors();
    /// Initialises MPI; this waits until all other processes do the same.
    static Result<std::unique_ptr<Ranks>> join();
    ~Ranks();

    int rank() const;  ///< number of this process, from 0
    int size() const;  ///< number of ranks
    /// True if the launcher keeps the other processes alive when one dies, or if this is unknown.
    bool survive_death_of_one() const;

    /// Starts to send a message and returns at once; the message is kept until it has been sent.
    void send(int to, std::string message);
    std::size_t unsent() const;  ///< number of messages that have not been sent completely
    struct Received {
        int from;  ///< rank of the sender
        std::string message;
    };
    /// The next message that has arrived completely; no value if there is none. Messages of one sender keep their order.
    std::optional<Received> receive();
    /// Gives up the messages to and from this rank that are not complete, because the rank is dead.
    void drop_messages_of(int rank);
    /// Ends the communication of this process. `together`: all ranks are alive and leave as well; if false, this process must exit at once.
    void leave(bool together);
    bool left_together() const { return left_together_; }  ///< false after leave(false)

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    bool left_together_ = true;
    explicit Ranks(std::unique_ptr<Impl>);
};

}  // namespace corpuscle
