#pragma once
// Spikes on their way from the skin to where the nerve is listened to: each unit's take a time of their own, so they arrive in another
// order than they left.

#include "skin/innervation.hpp"

namespace corpuscle {

class Conduction {
public:
    /// Of a skin's units, for samples T apart.
    Conduction(const Innervation&, double T);

    /// Takes what left the skin and appends to `arrived`, in order of time, then unit, all that arrives up to sample `now`; none that
    /// leaves later can arrive before. At most `reach` samples at a time.
    void carry(std::span<const Spike> left, std::int64_t now, std::vector<Spike>& arrived);
    static constexpr std::size_t reach = 64;

    /// Those still on their way, in order.
    std::vector<Spike> on_their_way() const;
    /// Whether a saved spike can be among them.
    bool can_carry(const Spike& s, std::int64_t now) const {
        return s.unit < delays_.size() && s.step > now && s.step < now + static_cast<std::int64_t>(arriving_.size()) && s.offset > 0 &&
               s.offset <= 1;
    }
    void put_back(std::span<const Spike>, std::int64_t now);  ///< what on_their_way() gave, after sample `now`

private:
    struct Delay {
        std::int32_t steps;
        double rest;  // of a step, [0, 1)
    };
    std::vector<Delay> delays_;                 // of each unit; empty: all arrive at once
    std::vector<std::vector<Spike>> arriving_;  // by step, modulo how many there are
    std::int64_t told_ = -1;                    // up to this sample all have been told

    std::vector<Spike>& at(std::int64_t step) { return arriving_[static_cast<std::size_t>(step) % arriving_.size()]; }
};

}  // namespace corpuscle
