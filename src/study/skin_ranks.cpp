#include "study/skin_ranks.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <deque>
#include <thread>

namespace corpuscle {
namespace {

/// The first byte of what ranks of a skin say to one another.
enum SkinWord : char {
    spikes_of_block = 's',  ///< follower: PackedRankSpike after PackedRankSpike
    what_was_done = 'w',    ///< follower, last of all: SkinWork
    went_wrong = 'e',       ///< follower: a code and a sentence
    thanks = 't',           ///< leader: a block was taken
    dismissed = 'd',        ///< leader: it is over
};

/// A follower is at most so many blocks ahead of what was taken from it.
constexpr int most_ahead = 8;

struct PackedRankSpike {
    std::int64_t step;
    double offset;
    std::uint64_t unit;
};

std::string packed(const std::vector<Spike>& spikes) {
    std::string text(1 + spikes.size() * sizeof(PackedRankSpike), spikes_of_block);
    for (std::size_t k = 0; k < spikes.size(); ++k) {
        const PackedRankSpike s{spikes[k].step, spikes[k].offset, spikes[k].unit};
        std::memcpy(text.data() + 1 + k * sizeof s, &s, sizeof s);
    }
    return text;
}

void unpack_into(const std::string& text, std::vector<Spike>& spikes) {
    for (std::size_t at = 1; at + sizeof(PackedRankSpike) <= text.size(); at += sizeof(PackedRankSpike)) {
        PackedRankSpike s;
        std::memcpy(&s, text.data() + at, sizeof s);
        spikes.push_back({s.step, s.offset, static_cast<std::uint32_t>(s.unit)});
    }
}

std::string told_error(const Error& error) { return std::string(1, went_wrong) + static_cast<char>(error.code) + error.text(); }

void doze() { std::this_thread::sleep_for(std::chrono::microseconds(20)); }

class LeadingAnswerer final : public SkinAnswerer {
    Ranks& ranks_;
    Skin& own_;
    Pool& pool_;
    std::vector<std::deque<std::string>> heard_;  // of each rank
    SkinWork others_;

    /// The next that a rank said.
    Result<std::string> next_of(int rank) {
        auto& queue = heard_[static_cast<std::size_t>(rank)];
        while (queue.empty()) {
            if (auto m = ranks_.receive())
                heard_[static_cast<std::size_t>(m->from)].push_back(std::move(m->message));
            else
                doze();
        }
        auto text = std::move(queue.front());
        queue.pop_front();
        if (text[0] == went_wrong) return Error{static_cast<Code>(static_cast<unsigned char>(text[1])), text.substr(2)};
        return text;
    }

    Result<void> add_others(std::vector<Spike>& spikes) {
        for (int rank = 1; rank < ranks_.size(); ++rank) {
            auto text = next_of(rank);
            if (!text) return text.error();
            unpack_into(*text, spikes);
            ranks_.send(rank, std::string(1, thanks));
        }
        (void)ranks_.unsent();
        std::sort(spikes.begin(), spikes.end());
        return {};
    }

public:
    LeadingAnswerer(Ranks& ranks, Skin& own, Pool& pool)
        : ranks_(ranks), own_(own), pool_(pool), heard_(static_cast<std::size_t>(ranks.size())) {}

    Result<void> answer(const SiteForce& force, std::size_t steps, std::vector<Spike>& spikes) override {
        if (auto ok = own_.respond(force, steps, spikes, pool_); !ok) return ok;
        return add_others(spikes);
    }
    Result<void> last(std::vector<Spike>& spikes) override {
        own_.last(spikes);
        if (auto ok = add_others(spikes); !ok) return ok;
        for (int rank = 1; rank < ranks_.size(); ++rank) {
            auto text = next_of(rank);
            if (!text) return text.error();
            SkinWork work;
            std::memcpy(&work, text->data() + 1, std::min(sizeof work, text->size() - 1));
            others_.afferent_steps += work.afferent_steps, others_.at_rest += work.at_rest, others_.spikes += work.spikes;
            others_.capped += work.capped;
        }
        return {};
    }
    SkinWork work() const override {
        auto all = own_.work();
        all.afferent_steps += others_.afferent_steps, all.at_rest += others_.at_rest, all.spikes += others_.spikes;
        all.capped += others_.capped;
        return all;
    }
};

/// What a follower has sent and not been thanked for.
class Follower {
    Ranks& ranks_;
    int ahead_ = 0;
    bool dismissed_ = false;

    void listen() {
        while (auto m = ranks_.receive()) {
            if (m->message[0] == thanks) --ahead_;
            if (m->message[0] == dismissed) dismissed_ = true;
        }
    }

public:
    explicit Follower(Ranks& ranks) : ranks_(ranks) {}
    /// False: dismissed.
    bool say(std::string text) {
        ++ahead_;
        ranks_.send(0, std::move(text));
        for (listen(); !dismissed_ && ahead_ >= most_ahead; listen()) doze();
        return !dismissed_;
    }
    void wait_for_the_end() {
        for (listen(); !dismissed_ || ranks_.unsent() > 0; listen()) doze();
    }
};

/// False: dismissed before the end.
Result<bool> follow_force(Follower& follower, SkinForce& force, Skin& skin, Pool& pool) {
    std::vector<Spike> spikes;
    for (;;) {
        auto block = force.next();
        if (!block) return block.error();
        if (block->total.empty()) break;
        spikes.clear();
        if (auto ok = skin.respond(block->force, block->total.size(), spikes, pool); !ok) return ok.error();
        if (!follower.say(packed(spikes))) return false;
    }
    spikes.clear();
    skin.last(spikes);
    if (!follower.say(packed(spikes))) return false;
    const auto work = skin.work();
    return follower.say(std::string(1, what_was_done) + std::string(reinterpret_cast<const char*>(&work), sizeof work));
}

}  // namespace

std::unique_ptr<SkinAnswerer> leading_answerer(Ranks& ranks, Skin& own, Pool& pool) {
    return std::make_unique<LeadingAnswerer>(ranks, own, pool);
}

void dismiss_skin(Ranks& ranks) {
    for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(rank, std::string(1, dismissed));
    while (ranks.unsent() > 0) {
        (void)ranks.receive();
        doze();
    }
    ranks.leave(true);
}

Result<void> follow_skin(Ranks& ranks, Result<SkinForce*> force, Skin* skin, Pool& pool) {
    Follower follower(ranks);
    auto done = force ? follow_force(follower, **force, *skin, pool) : Result<bool>(force.error());
    if (!done) (void)follower.say(told_error(done.error()));
    follower.wait_for_the_end();
    ranks.leave(true);
    return {};
}

}  // namespace corpuscle
