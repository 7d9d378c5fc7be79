#pragma once
// The units of one input at work: side by side on lanes where they can, one by one where they cannot, on all threads.

#include "model/population.hpp"
#include "study/ahead.hpp"
#include "study/respond.hpp"

namespace corpuscle {

class Units {
public:
    /// `probed`: what the units show is wanted; then they go one by one.
    static Result<Units> make(Input input, const RespondOptions& options, bool probed);

    const Input& input() const { return input_; }
    std::int64_t samples() const { return samples_; }
    /// What left its afferent's ranges: a sentence for each range, on the channel on which it was outside longest.
    std::vector<std::string> outside() const;

    /// One block through all units to all listeners; false at the end of the source.
    Result<bool> answer_block(Source& source, std::span<Listener* const> listeners, Pool& pool, Work& work);

private:
    /// Units that go on lanes together.
    struct Crowd {
        std::unique_ptr<Population> population;
        std::vector<std::uint32_t> units;  // of the input, rising
        bool one_channel;                  // its force is one profile
    };
    /// A unit that goes alone.
    struct Single {
        std::uint32_t unit;
        State state;
        std::vector<Spike> spikes = {};
        std::int64_t capped = 0, clipped = 0, overflowed = 0, steps = 0, rejected = 0, iterations = 0;
        std::vector<Outside> outside = {};  // of each of the afferent's ranges
        Spent spent = {};
        std::optional<Error> error = {};
        bool lost = false;  // a netlist that did not converge: it says no more
    };

    Units(Input input, std::size_t block, bool probed);
    Result<void> seat(const RespondOptions& options, InstructionSet set);
    Result<void> seat_crowds(std::span<const std::size_t> plans, const Run& run, const RespondOptions& options, InstructionSet set);
    Result<void> answer_crowd(Crowd& crowd, Pool& pool, Work& work);
    void answer_single(Single& single);
    Result<void> answer_force(Single& single, Answer& answer, std::span<double* const> shown);
    Result<void> answer_singles(Pool& pool, Work& work);
    std::pair<const Single*, std::size_t> longest_outside(std::size_t plan, std::size_t range) const;
    Error of_unit(Error error, std::size_t unit) const;
    const double* force_of(std::size_t unit) const { return force_.force[input_.channel_of(unit)].data(); }

    Input input_;
    bool probed_;
    Frames force_;
    Ahead ahead_;
    std::vector<std::unique_ptr<Afferent>> afferents_;  // of each plan; none where its units are in crowds
    std::vector<std::span<const Probe>> probes_of_;
    std::vector<Crowd> crowds_;
    std::vector<Single> singles_;
    std::vector<Spike> spikes_;
    std::vector<std::vector<std::vector<double>>> shown_;
    std::int64_t samples_ = 0;
};

}  // namespace corpuscle
