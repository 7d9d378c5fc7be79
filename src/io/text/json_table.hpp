#pragma once
// JSON lines, and JSON documents of records or columns, as tables. All values are kept in memory.

#include "io/table/table.hpp"
#include "io/text/line_reader.hpp"

namespace corpuscle {

/// Reads the entire text. `should_continue` is called now and then while reading; if it returns false, the result is an error with the code
/// ErrorCode::interrupted.
Result<std::unique_ptr<Table>> open_json_table(LineReader, const std::function<bool()>& should_continue);

}  // namespace corpuscle
