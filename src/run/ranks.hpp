#pragma once
// Ranks: processes that mpirun starts together for one command, a sweep or a skin. Rank 0 (the coordinator) writes the files; the others
// (the workers) send it what they have computed. If one of them dies, mpirun ends all. Only ranks.cpp uses MPI.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/error.hpp"

namespace corpuscle {

/// The communication of this process, which is one of the ranks, with the others. One thread uses it.
class Ranks {
public:
    /// True for rank 0 and for a process without mpirun: this process prints the errors that occur in all processes.
    static bool reports_errors();
    /// Joins the other processes, and waits until they do the same. Null: mpirun, or another launcher, did not start more than one process.
    static Result<std::unique_ptr<Ranks>> join();
    /// Leaves the other ranks, and waits until they do the same.
    virtual ~Ranks() = default;

    virtual int rank() const = 0;  ///< number of this process, from 0
    virtual int size() const = 0;  ///< number of ranks

    /// Sends a message, and waits until the other rank receives it; so no rank stores more than one message that it has not asked for.
    virtual void send(int to, const std::string& message) = 0;
    /// For a worker: sends an error to the coordinator, which receives it instead of a message.
    virtual void send_error(const Error&) = 0;
    struct Received {
        int from;                     ///< rank of the sender
        Result<std::string> message;  ///< or the error that it sent
    };
    /// The next message of any rank. No value: none has begun to arrive, or it is still arriving (for ever, if its sender was killed).
    virtual std::optional<Received> receive_any() = 0;
    /// The next message of this rank, or the error that it sent; waits for it.
    virtual Result<std::string> receive(int from) = 0;
    /// Ends all ranks at once, with this exit status.
    [[noreturn]] virtual void abort(int exit_status) = 0;
};

/// The result of a rank's work; an exception becomes an error, to be sent or reported. The other ranks would wait for ever for one that
/// only leaves them.
Result<void> without_exceptions(const std::function<Result<void>()>& work);

}  // namespace corpuscle
