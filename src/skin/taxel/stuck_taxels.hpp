#pragma once
// Finds taxels of a recording that are probably dead: their readings never change, or are stuck at their highest value.

#include <span>
#include <string>
#include <vector>

#include "skin/taxel/taxel_layout.hpp"

namespace corpuscle {

class StuckTaxels {
    struct Readings {
        double first = 0, highest = 0;
        std::int64_t count = 0, run = 0;  // samples so far, and those at the end that are equal to the highest
        std::int64_t longest_run = 0;     // of samples at the highest
        bool varies = false;
    };
    std::vector<Readings> readings_;  // of each taxel
    TaxelLayout layout_;

public:
    explicit StuckTaxels(TaxelLayout layout) : readings_(layout.taxels.size()), layout_(std::move(layout)) {}
    /// Adds the next force of a taxel, N.
    void add(std::size_t taxel, double force);
    /// The names of the taxels that are probably dead, with a remedy; empty without any. A taxel that is always 0 N may only never have
    /// been touched, so it is left out. So are all taxels if none of them varies, those that stay at their highest value if most do, and
    /// those that the layout says are dead.
    std::vector<std::string> notes() const;
};

}  // namespace corpuscle
