#pragma once
// JSON as a table: one record on each line (JSON lines), a list of records or of rows, or an object of columns.

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/line_reader.hpp"

namespace corpuscle {

/// A field of a record. Nested members are called "wrench.force.x", list elements "taxels.1".
struct JsonField {
    std::string name;
    const nlohmann::ordered_json* value;  ///< a number, a string, true, false or null
};

/// Information in a document outside its table.
struct JsonMetadata {
    std::optional<double> rate = {};  ///< Hz, from a number called fs, rate ...
    std::string unit = {};            ///< unit of columns without a unit in their name, from a string called unit
    std::vector<std::string> notes = {};
};

/// Calls `on_record` for each record, with the line number for JSON lines and 0 otherwise. Stops if `on_record` returns an error, or if
/// `should_continue`, which is called every few thousand values, returns false.
Result<void> read_json_records(
    LineReader&, const std::function<Result<void>(std::span<const JsonField>, long line)>& on_record,
    const std::function<bool()>& should_continue = [] { return true; }, JsonMetadata* metadata = nullptr);

/// True if the text begins like JSON. Rewinds the text.
Result<bool> looks_like_json(LineReader&);

}  // namespace corpuscle
