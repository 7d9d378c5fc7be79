#pragma once
// `corpuscle stream`: its options on the command line.

#include "verbs.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

class StreamVerb {
    StreamWords words_;

public:
    void add_to(CLI::App&, Common&);
    int run(const Common& common) const { return stream(words_, common); }
};

}  // namespace corpuscle
