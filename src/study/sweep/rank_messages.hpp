#pragma once
// Messages between rank 0, which owns the file, and the other ranks.

#include "io/message.hpp"
#include "study/sweep/sweep.hpp"

namespace corpuscle {

enum class RankMessageType : std::uint64_t {
    handshake,    ///< contains a RankHandshake, in both directions
    heartbeat,    ///< the sender is alive, in both directions
    request,      ///< requests a number of further items
    items,        ///< the requested items
    outcomes,     ///< outcomes of finished items
    sweep_error,  ///< an error code and a message: the sweep itself is wrong
    shutdown,     ///< 1: all ranks leave together, 0: each rank leaves alone
};

/// The machine and process of a rank, and a hash of its sweep's metadata. Ranks on the same machine can check whether the process is alive.
struct RankHandshake {
    std::string host;
    std::uint64_t process = 0, metadata_hash = 0;

    static RankHandshake of_this_process(const Sweep*);
    /// True if the process is certainly dead; detected only on the same machine.
    bool is_dead() const;
    /// True if is_dead() can detect its death.
    bool is_on_this_machine() const;
};

Message rank_message(RankMessageType);
Message rank_message(const RankHandshake&);
Message rank_message(RankMessageType, std::uint64_t);
Message rank_message(const std::vector<std::int64_t>& items);
Message rank_message(const std::vector<ItemOutcome>&);
Message rank_message(const Error&);

/// Decode the message type, or the contents after it; return nullopt or false if the message is incomplete.
std::optional<RankMessageType> decode_rank_message_type(Message&);
bool decode_rank_message(Message&, RankHandshake&);
bool decode_rank_message(Message&, std::vector<std::int64_t>&);
bool decode_rank_message(Message&, std::vector<ItemOutcome>&);
bool decode_rank_message(Message&, Error&);

}  // namespace corpuscle
