#pragma once
// Processes of one sweep, started together by mpirun, that send one another messages. What knows MPI is ranks.cpp alone; MPI's library is
// loaded when join() is called, so that a start without mpirun does not pay for it.

#include <memory>
#include <optional>
#include <string>

#include "signal/error.hpp"

namespace corpuscle {

class Ranks {
public:
    /// Whether mpirun, or another such launcher, has started more than one of us.
    static bool are_started();
    /// Whether this one is the first of those, or the only one: it is enough if one says what is wrong with all.
    static bool speaks();
    /// Waits for all the others.
    static Result<std::unique_ptr<Ranks>> join();
    ~Ranks();

    int rank() const;
    int size() const;
    /// Whether the launcher lets the others live when one dies; of one that cannot be asked: true.
    bool outlive_one() const;

    /// Never waits: the message is kept until it has gone.
    void send(int to, std::string message);
    std::size_t unsent() const;  ///< messages that are kept
    struct Received {
        int from;
        std::string message;
    };
    /// A message that is there in whole, if there is one.
    std::optional<Received> receive();
    /// What is still kept for this one is forgotten: it is dead.
    void forget(int rank);
    /// Ends this rank's part. `together`: all are there, and leave too; else the process must end without further ado.
    void leave(bool together);
    bool left_together() const { return together_; }

private:
    struct Held;
    std::unique_ptr<Held> held_;
    bool together_ = true;
    explicit Ranks(std::unique_ptr<Held>);
};

}  // namespace corpuscle
