#pragma once
// .save: which curves are kept.

#include "circuit/analysis/bench.hpp"

namespace corpuscle::circuit {

struct Saved {
    std::string name;  ///< "v(out)", "v(a,b)", "i(v1)"
    Wanted of;
};

/// What .save names; "out" is v(out). Empty: everything, as it is without .save, or with "all".
Result<std::vector<Saved>> saved_of(const System&);

}  // namespace corpuscle::circuit
