// The ranks that are not rank 0: ask for units, hand in outcomes.

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <thread>

#include "study/sweep/crew.hpp"
#include "study/sweep/rank_run.hpp"
#include "study/sweep/rank_time.hpp"
#include "study/sweep/rank_words.hpp"

namespace corpuscle {
namespace {

class Following {
    static constexpr double between_outcomes = 0.1;  // s
    static constexpr std::size_t most_unsent = 8;    // messages, before the crew has to wait

    Ranks& ranks_;
    const SweepRun& run_;
    const unsigned threads_;
    std::optional<Crew> crew_;
    RankHello leader_;
    RankTime now_, heard_ = rank_time(), beaten_ = heard_, handed_ = heard_;
    RankPace pace_;
    bool asked_ = false, told_fault_ = false, over_ = false, together_ = true, stopped_ = false, knows_leader_ = false;

    void say(const Message& m) {
        ranks_.send(0, m.bytes());
        beaten_ = now_;
    }

    void hear(Message m) {
        heard_ = now_;
        const auto word = word_of(m);
        std::uint64_t together = 0;
        std::vector<std::int64_t> units;
        if (word == RankWord::hello && get(m, leader_)) knows_leader_ = leader_.can_be_seen();
        if (word == RankWord::over && m.get(together)) over_ = true, together_ = together != 0;
        if (word == RankWord::units && get(m, units) && crew_) crew_->give(units), asked_ = false;
    }

    void hand_in() {
        if (seconds_between(handed_, now_) < between_outcomes || ranks_.unsent() >= most_unsent) return;
        const auto outcomes = crew_->collect(0);
        pace_.ended(outcomes.size(), now_);
        handed_ = now_;
        if (!outcomes.empty()) say(message(outcomes));
    }

    void ask() {
        const auto wanted = pace_.ahead(threads_);
        const auto waiting = static_cast<std::int64_t>(crew_->waiting());
        if (asked_ || stopped_ || 2 * waiting > wanted) return;
        asked_ = true;
        say(message(RankWord::ask, static_cast<std::uint64_t>(wanted - waiting)));
    }

    void work() {
        hand_in();
        if (const auto ok = crew_->fault(); !ok && !told_fault_) say(message(ok.error())), told_fault_ = true;
        ask();
        if (!stopped_ && run_.stop()) stopped_ = true, crew_->stop();
    }

    bool leader_is_gone() const { return (knows_leader_ && leader_.is_dead()) || seconds_between(heard_, now_) > longest_silence; }

public:
    Following(Ranks& ranks, const Result<std::unique_ptr<Sweep>>& sweep, const SweepRun& run)
        : ranks_(ranks), run_(run), threads_(std::max(1U, run.threads)) {
        now_ = rank_time();
        say(message(RankHello::mine(sweep ? sweep->get() : nullptr)));
        if (sweep)
            crew_.emplace(**sweep, threads_);
        else
            say(message(sweep.error()));
    }

    Result<void> follow() {
        for (; !over_; std::this_thread::sleep_for(rank_tick)) {
            now_ = rank_time();
            while (auto received = ranks_.receive()) hear(Message(std::move(received->message)));
            if (crew_) work();
            if (seconds_between(beaten_, now_) > between_beats) say(message(RankWord::beat));
            if (leader_is_gone()) {
                ranks_.leave(false);
                return bad_input(
                    fmt::format("rank {}: rank 0, which writes the results, is gone; what it wrote is kept: the same command "
                                "goes on",
                                ranks_.rank()));
            }
        }
        crew_.reset();
        ranks_.leave(together_);
        return {};
    }
};

}  // namespace

Result<void> follow(Ranks& ranks, const Result<std::unique_ptr<Sweep>>& sweep, const SweepRun& run) {
    return Following(ranks, sweep, run).follow();
}

}  // namespace corpuscle
