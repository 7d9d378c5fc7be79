#pragma once
// Messages between rank 0, which owns the file, and the other ranks.

#include "io/message.hpp"
#include "study/sweep/sweep.hpp"

namespace corpuscle {

enum class RankWord : std::uint64_t {
    hello,     ///< handshake, in both directions
    beat,      ///< heartbeat, in both directions
    ask,       ///< requests a number of further items
    units,     ///< the requested items
    outcomes,  ///< of items
    fault,     ///< an error code and a message: the sweep itself is wrong
    over,      ///< 1: all ranks leave together; 0: each rank leaves alone
};

/// The machine and process of a rank, and a hash of its sweep's metadata. Ranks on the same machine can check if the process is alive.
struct RankHello {
    std::string host;
    std::uint64_t process = 0, facts = 0;

    static RankHello mine(const Sweep*);
    /// True if the process is certainly dead; can be seen only on the same machine.
    bool is_dead() const;
    /// True if is_dead() can detect its death.
    bool can_be_seen() const;
};

Message message(RankWord);
Message message(const RankHello&);
Message message(RankWord, std::uint64_t);
Message message(const std::vector<std::int64_t>& units);
Message message(const std::vector<UnitOutcome>&);
Message message(const Error&);

/// Decode what follows the message type; false or empty if the message is incomplete.
std::optional<RankWord> word_of(Message&);
bool get(Message&, RankHello&);
bool get(Message&, std::vector<std::int64_t>&);
bool get(Message&, std::vector<UnitOutcome>&);
bool get(Message&, Error&);

}  // namespace corpuscle
