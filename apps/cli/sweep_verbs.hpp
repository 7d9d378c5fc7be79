#pragma once
// `corpuscle sweep` and its sub-verbs: their options on the command line.

#include "verbs.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

/// Adds the options that every verb has: --json, --quiet.
void add_common(CLI::App& verb, Common&);
/// Adds --overwrite, for verbs that write complete files.
void add_overwrite(CLI::App& verb, Common&);

class SweepVerbs {
    SweepWords sweep_;
    SweepMergeWords merge_;
    std::string dumped_;
    SweepShowWords show_;
    SweepCalibrateWords calibrate_;
    CLI::App* verb_ = nullptr;

public:
    void add_to(CLI::App&, Common&);
    /// Runs the requested verb; returns its exit status.
    int run(const Common&) const;
};

}  // namespace corpuscle
