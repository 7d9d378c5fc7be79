#pragma once
// `corpuscle sweep` and the verbs below it, as words of the command line.

#include "verbs.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

/// What every verb has: --json, --quiet.
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
    /// The one that was asked for; its exit status.
    int run(const Common&) const;
};

}  // namespace corpuscle
