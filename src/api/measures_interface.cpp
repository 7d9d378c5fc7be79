#include "corpuscle/measures.hpp"

#include "api/result.hpp"
#include "measure/measures.hpp"

namespace corpuscle {

std::vector<MeasureDescription> measure_catalogue() {
    std::vector<MeasureDescription> out;
    for (const auto& m : measures) out.push_back({std::string(m.name), std::string(m.unit), std::string(m.description)});
    return out;
}

std::vector<double> measure_train(std::span<const double> train, double from, double to) {
    if (!(from < to)) throw InputError("a window must end after it begins");
    MeasureAccumulator accumulator({TimeWindow{from, to}}, 1);
    for (const double t : train) accumulator.spike(0, t);
    return accumulator.values(0, 0);
}

}  // namespace corpuscle
