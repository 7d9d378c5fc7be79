#include "study/thesis/beside.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle {

Result<Beside> beside(const Asked& asked, const std::string& model) {
    auto chip = told_of(asked);
    if (!chip) return chip.error();
    auto train = train_of({model});
    if (!train) return train.error();
    return Beside{std::move(*chip), std::move(*train)};
}

double least_jump(const Line& trace, const std::vector<double>& spikes, double lasts) {
    double least = std::numeric_limits<double>::infinity();
    for (const double t : spikes)
        least = std::min(least, trace.between(t, t + lasts).most() / trace.between(t - 2 * lasts, t - lasts / 2).most());
    return least;
}

double longest_above(const Line& trace, double level) {
    double longest = 0, since = NAN;
    for (std::size_t k = 0; k < trace.x.size(); ++k) {
        if (trace.y[k] < level)
            since = NAN;
        else if (std::isnan(since))
            since = trace.x[k];
        else
            longest = std::max(longest, trace.x[k] - since);
    }
    return longest;
}

}  // namespace corpuscle
