#pragma once
// The command-line options of `corpuscle stream`.

#include "cli/verbs.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

class StreamVerb {
    StreamArguments arguments_;

public:
    void add_to(CLI::App&, CommonArguments&);
    int run(const CommonArguments& common) const { return stream(arguments_, common); }
};

}  // namespace corpuscle
