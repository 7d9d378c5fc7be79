#pragma once
// Reads JSON as records, which are the rows of a table. The text has one record on each line (JSON lines), or it is a document: a list
// with one element for each record (an object, or a list of values), or an object of columns.

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "io/table/table.hpp"
#include "io/text/line_reader.hpp"

namespace corpuscle {

/// A field of a record. A member of a nested object is called "wrench.force.x", an element of a list "taxels.1" (counted from 1).
struct JsonField {
    std::string name;
    const nlohmann::ordered_json* value;  ///< a number, a string, true, false or null
};

/// Properties that a document states outside its table.
struct JsonMetadata {
    std::optional<double> rate = {};      ///< Hz, from a number called fs, rate ...; nullopt: not stated
    std::string unit = {};                ///< unit of the columns without a unit in their name, from a string called unit; "": not stated
    std::vector<std::string> notes = {};  ///< notes for the user about lists that were ignored
};

/// Calls `on_record` for each record. `line` is the line number of the record for JSON lines, and 0 for a document. Stops with an error if
/// `on_record` returns an error, or if `should_continue`, which is called every few thousand values, returns false.
Result<void> read_json_records(
    LineReader&, const std::function<Result<void>(std::span<const JsonField>, long line)>& on_record,
    const std::function<bool()>& should_continue = [] { return true; }, JsonMetadata* metadata = nullptr);

/// True if the first line that is not empty begins like JSON. Rewinds the text.
Result<bool> looks_like_json(LineReader&);

/// Reads the entire text. `should_continue` is called now and then while reading; if it returns false, the result is an error with the code
/// ErrorCode::interrupted.
Result<std::unique_ptr<Table>> open_json_table(LineReader, const std::function<bool()>& should_continue);

}  // namespace corpuscle
