#pragma once
// JSON as a table: a record a line (JSON lines), a list of records or of rows, or an object of columns.

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/lines.hpp"

namespace corpuscle {

/// A field of a record. Members of members are called "wrench.force.x", those of lists "taxels.1".
struct JsonField {
    std::string name;
    const nlohmann::ordered_json* value;  ///< a number, a word, true, false or null
};

/// What a document says beside its table.
struct JsonFacts {
    std::optional<double> rate = {};  ///< Hz: a number called fs, rate ...
    std::string unit = {};            ///< of columns that have none in their name: a word called unit
    std::vector<std::string> remarks = {};
};

/// Gives the records one after another; `line`: of a record of JSON lines, else 0. An error of `take` ends it, and so does a `keep_on`
/// that returns false, which is asked every few thousand values.
Result<void> read_json_records(
    Lines&, const std::function<Result<void>(std::span<const JsonField>, long line)>& take,
    const std::function<bool()>& keep_on = [] { return true; }, JsonFacts* facts = nullptr);

/// Does the text begin as JSON does? Rewinds it.
Result<bool> begins_like_json(Lines&);

}  // namespace corpuscle
