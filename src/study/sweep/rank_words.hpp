#pragma once
// What ranks say to one another: rank 0, which owns the file, and the others.

#include "io/message.hpp"
#include "study/sweep/sweep.hpp"

namespace corpuscle {

enum class RankWord : std::uint64_t {
    hello,     ///< who I am; both ways
    beat,      ///< I live; both ways
    ask,       ///< a number: so many units more, please
    units,     ///< here they are
    outcomes,  ///< of units
    fault,     ///< a code and a sentence: the sweep itself is wrong
    over,      ///< 1: we all leave together; 0: each by itself
};

/// Where a rank runs, so that one on the same machine can see whether it lives; and what its sweep is made of.
struct RankHello {
    std::string host;
    std::uint64_t process = 0, facts = 0;

    static RankHello mine(const Sweep*);
    /// It is certain that it is dead: this can be seen on the same machine alone.
    bool is_dead() const;
    /// Whether is_dead() can ever say so.
    bool can_be_seen() const;
};

Message message(RankWord);
Message message(const RankHello&);
Message message(RankWord, std::uint64_t);
Message message(const std::vector<std::int64_t>& units);
Message message(const std::vector<UnitOutcome>&);
Message message(const Error&);

/// These read what follows the word; false or nothing: it is not whole.
std::optional<RankWord> word_of(Message&);
bool get(Message&, RankHello&);
bool get(Message&, std::vector<std::int64_t>&);
bool get(Message&, std::vector<UnitOutcome>&);
bool get(Message&, Error&);

}  // namespace corpuscle
