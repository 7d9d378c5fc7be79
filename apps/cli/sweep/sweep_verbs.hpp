#pragma once
// The command-line options of `corpuscle sweep` and its sub-verbs, and the options that all verbs have.

#include "cli/verbs.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

class SweepVerbs {
    SweepArguments sweep_;
    SweepMergeArguments merge_;
    std::string dump_path_;
    SweepShowArguments show_;
    SweepCalibrateArguments calibrate_;
    CLI::App* verb_ = nullptr;  // `sweep`, after add_to()

public:
    void add_to(CLI::App&, CommonArguments&);
    /// Runs the requested verb; returns its exit status.
    int run(const CommonArguments&) const;
};

}  // namespace corpuscle
