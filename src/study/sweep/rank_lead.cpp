// Rank 0: owns the file, hands out blocks, takes them back from the dead.

#include <fmt/format.h>
#include <algorithm>
#include <thread>
#include <unordered_set>

#include "study/sweep/crew.hpp"
#include "study/sweep/rank_run.hpp"
#include "study/sweep/rank_time.hpp"
#include "study/sweep/rank_words.hpp"

namespace corpuscle {
namespace {

struct Follower {
    RankHello hello;
    bool is_seen = false, lives = true, is_counted = false;  // the last: among those that were lost
    std::unordered_set<std::int64_t> has;                    // units
    std::int64_t wants = 0;
    RankTime heard, told;

    bool is_gone() const { return is_seen && hello.is_dead(); }
};

class Leading {
    static constexpr double last_words = 0.5;  // s, for what others have ready when all is stopped
    static constexpr std::size_t much = 4096;  // outcomes

    Ranks& ranks_;
    const Sweep& sweep_;
    SweepResults& results_;
    const SweepRun& run_;
    SweepCount& count_;
    RanksLost& lost_;
    UnitQueue queue_;
    std::vector<Follower> others_;  // by rank; 0 is not used
    std::vector<UnitOutcome> unwritten_;
    const std::uint64_t facts_;
    const unsigned threads_;
    RankPace pace_;
    RankTime now_ = rank_time(), written_ = now_, stopped_at_ = now_;
    bool stopped_ = false;
    Result<void> fault_;
    Crew crew_;

    void say(std::size_t rank, const Message& m) {
        ranks_.send(static_cast<int>(rank), m.bytes());
        others_[rank].told = now_;
    }

    void take(UnitOutcome&& o) {
        count_.count(o);
        unwritten_.push_back(std::move(o));
    }

    void hear_hello(std::size_t rank, Message& m) {
        auto& other = others_[rank];
        if (!get(m, other.hello)) return;
        other.is_seen = other.hello.can_be_seen();
        if (other.hello.facts != 0 && other.hello.facts != facts_ && fault_)
            fault_ = bad_input(
                fmt::format("rank {} on {} reads another sweep than rank 0: give all of them the same files", rank, other.hello.host));
    }

    void hear(std::size_t rank, Message m) {
        auto& other = others_[rank];
        other.heard = now_;
        if (!other.lives) other.lives = !other.is_gone();  // its message may have been under way when it died
        const auto word = word_of(m);
        std::uint64_t number = 0;
        std::vector<UnitOutcome> outcomes;
        Error error;
        if (word == RankWord::hello) hear_hello(rank, m);
        if (word == RankWord::ask && m.get(number)) other.wants = static_cast<std::int64_t>(number);
        // What it no longer has was given to others when it was taken for dead.
        if (word == RankWord::outcomes && get(m, outcomes))
            for (auto& o : outcomes)
                if (other.has.erase(o.unit) > 0) take(std::move(o));
        if (word == RankWord::fault && get(m, error) && fault_)
            fault_ = Error{error.code, fmt::format("rank {} on {}: {}", rank, other.hello.host, error.sentence)};
    }

    void bury(std::size_t rank) {
        auto& other = others_[rank];
        queue_.put_back({other.has.begin(), other.has.end()});
        if (!std::exchange(other.is_counted, true)) ++lost_.dead;
        lost_.units += static_cast<std::int64_t>(other.has.size());
        other.lives = false, other.wants = 0;
        other.has.clear();
        ranks_.forget(static_cast<int>(rank));
    }

    void look_after(std::size_t rank) {
        auto& other = others_[rank];
        if (!other.lives) return;
        if (other.is_gone() || seconds_between(other.heard, now_) > longest_silence) return bury(rank);
        if (seconds_between(other.told, now_) > between_beats) say(rank, message(RankWord::beat));
    }

    void hand_out() {
        if (stopped_ || queue_.left() == 0) return;
        const auto alive = 1 + std::count_if(others_.begin() + 1, others_.end(), [](const Follower& f) { return f.lives; });
        // So that the last blocks are small and all end together.
        const auto share = [&] { return std::max<std::int64_t>(1, queue_.left() / (2 * alive)); };
        for (std::size_t rank = 1; rank < others_.size() && queue_.left() > 0; ++rank) {
            auto& other = others_[rank];
            if (!other.lives || other.wants == 0) continue;
            const auto units = queue_.take(std::min(other.wants, share()));
            other.has.insert(units.begin(), units.end());
            other.wants = 0;
            say(rank, message(units));
        }
        const auto wanted = pace_.ahead(threads_), waiting = static_cast<std::int64_t>(crew_.waiting());
        if (2 * waiting <= wanted && queue_.left() > 0) crew_.give(queue_.take(std::min(wanted - waiting, share())));
    }

    Result<void> write() {
        if (unwritten_.size() < much && seconds_between(written_, now_) < run_.between_writes) return {};
        auto ok = results_.add(sweep_, std::exchange(unwritten_, {}));
        written_ = now_ = rank_time();
        run_.seen(count_);
        return ok;
    }

    bool is_over() const {
        if (stopped_) return crew_.is_done() && seconds_between(stopped_at_, now_) > last_words;
        return queue_.left() == 0 && crew_.is_done() && unwritten_.empty() &&
               std::all_of(others_.begin() + 1, others_.end(), [](const Follower& f) { return f.has.empty(); });
    }

    Result<void> lead_on() {
        for (; !is_over(); std::this_thread::sleep_for(rank_tick)) {
            now_ = rank_time();
            while (auto received = ranks_.receive()) hear(static_cast<std::size_t>(received->from), Message(std::move(received->message)));
            for (std::size_t rank = 1; rank < others_.size(); ++rank) look_after(rank);
            hand_out();
            auto own = crew_.collect(0);
            pace_.ended(own.size(), now_);
            for (auto& o : own) take(std::move(o));
            if (auto ok = write(); !ok) return ok;
            if (auto ok = crew_.fault(); !ok && fault_) fault_ = ok;
            if (!fault_) break;
            if (!stopped_ && run_.stop()) stopped_ = true, stopped_at_ = now_, crew_.stop();
        }
        if (auto ok = results_.add(sweep_, std::exchange(unwritten_, {})); !ok) return ok;
        if (!fault_) return fault_;
        if (stopped_) return Error{Code::interrupted, "interrupted"};
        return {};
    }

public:
    Leading(Ranks& ranks, const Sweep& sweep, SweepResults& results, const SweepRun& run, SweepCount& count, RanksLost& lost,
            std::vector<UnitQueue::Range> missing)
        : ranks_(ranks), sweep_(sweep), results_(results), run_(run), count_(count), lost_(lost), queue_(std::move(missing), run.shard),
          others_(static_cast<std::size_t>(ranks.size())), facts_(RankHello::mine(&sweep).facts), threads_(std::max(1U, run.threads)),
          crew_(sweep, threads_) {
        count_ = {.to_do = queue_.left()};
        results_.note(count_.to_do);
        for (std::size_t rank = 1; rank < others_.size(); ++rank) {
            others_[rank].heard = now_;
            say(rank, message(RankHello::mine(&sweep)));
        }
    }

    Result<void> lead() {
        auto ok = lead_on();
        crew_.stop();
        return ok;
    }

    bool all_live() const {
        return std::all_of(others_.begin() + 1, others_.end(), [](const Follower& f) { return f.lives; });
    }
};

/// All are told; of those that are dead nobody waits for an answer.
void end_all(Ranks& ranks, bool together) {
    for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(rank, message(RankWord::over, together).bytes());
    const auto begun = rank_time();
    while (ranks.unsent() > 0 && seconds_between(begun, rank_time()) < between_beats) std::this_thread::sleep_for(rank_tick);
    ranks.leave(together);
}

}  // namespace

Result<void> lead(Ranks& ranks, const Sweep& sweep, SweepResults& results, const SweepRun& run, SweepCount& count, RanksLost& lost) {
    auto missing = results.missing();
    if (!missing) {
        dismiss(ranks);
        return missing.error();
    }
    Leading leading(ranks, sweep, results, run, count, lost, std::move(*missing));
    auto ok = leading.lead();
    end_all(ranks, leading.all_live());
    return ok;
}

void dismiss(Ranks& ranks) { end_all(ranks, true); }

}  // namespace corpuscle
