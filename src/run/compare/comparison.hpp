#pragma once
// Compares all trains of two files, and writes the differences as a table and as JSON.

#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "run/compare/train_comparison.hpp"

namespace corpuscle {

/// The differences of all pairs, and of all together.
struct TrainDifferences {
    std::vector<TrainDifference> pairs = {};
    TrainDifference total = {};
};

/// The trains of files A and B. A column that the user requests needs to be in one of the files only; the other is then read with the
/// default columns.
Result<std::pair<std::vector<NamedTrain>, std::vector<NamedTrain>>> read_both(const std::string& a, const std::string& b,
                                                                              const SpikeColumns&);

/// Compares the trains of A and B. `should_continue` gets the completed fraction; if it returns false, the error is `interrupted`.
Result<TrainDifferences> compare_all(const std::vector<NamedTrain>& a, const std::vector<NamedTrain>& b, const CompareOptions&,
                                     const std::function<bool(double fraction)>& should_continue);

/// The table of `corpuscle compare`, and its JSON document.
std::string comparison_table(const CompareOptions&, const TrainDifferences&);
nlohmann::ordered_json document_of(const CompareOptions&, const TrainDifferences&);

}  // namespace corpuscle
