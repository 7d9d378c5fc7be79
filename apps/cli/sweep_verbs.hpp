#pragma once
// The command-line options of `corpuscle sweep` and its sub-verbs, and the options that all verbs have.

#include "cli/verbs.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

/// Adds the options that every verb has: --json, --quiet.
void add_common(CLI::App& verb, CommonArguments&);
/// Adds --overwrite, for verbs that write complete files.
void add_overwrite(CLI::App& verb, CommonArguments&);

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
