#pragma once
// Messages between rank 0, the coordinator, which owns the results file, and the other ranks, the workers.

#include "io/sandbox/message.hpp"
#include "sweep/spec/sweep.hpp"

namespace corpuscle {

enum class RankMessageType : std::uint64_t {
    handshake,    ///< contains a RankHandshake, in both directions
    heartbeat,    ///< the sender is alive, in both directions
    request,      ///< from a worker: the number of further items that it requests
    items,        ///< to a worker: items, not more than it requested
    outcomes,     ///< from a worker: outcomes of finished items
    sweep_error,  ///< from a worker: an error code and a message; the sweep itself is wrong
    shutdown,     ///< to a worker: the run ends; 1: all ranks leave together, 0: each rank leaves alone
};

/// The machine and process of a rank, and a hash of its sweep. A rank on the same machine can check whether the process is alive.
struct RankHandshake {
    std::string host;
    std::uint64_t process = 0;        ///< process id
    std::uint64_t metadata_hash = 0;  ///< equal for equal sweeps; 0: the rank could not read the sweep

    /// `sweep`: null if it could not be read.
    static RankHandshake of_this_process(const Sweep* sweep);
    /// True if this machine has no process with this id. Means that the rank is dead only if is_on_this_machine() was true before.
    bool is_dead() const;
    /// True if the host is this one and has a process with this id.
    bool is_on_this_machine() const;
};

/// Encode a message. The type follows from the other contents, or is given.
Message rank_message(RankMessageType);
Message rank_message(const RankHandshake&);
Message rank_message(RankMessageType, std::uint64_t number);
Message rank_message(const std::vector<std::int64_t>& items);
Message rank_message(const std::vector<ItemOutcome>&);
Message rank_message(const Error&);

/// Decode the message type, then the contents after it. Return nullopt or false if the type is unknown or the message is incomplete.
std::optional<RankMessageType> decode_rank_message_type(Message&);
bool decode_rank_message(Message&, RankHandshake&);
bool decode_rank_message(Message&, std::vector<std::int64_t>&);
bool decode_rank_message(Message&, std::vector<ItemOutcome>&);
bool decode_rank_message(Message&, Error&);

}  // namespace corpuscle
