#pragma once
// SQLite with this project's errors: they name the file, the problem and a remedy.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/error.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace corpuscle::sql {

/// The error of the last SQLite call on this file; its message names the path.
Error error_of(sqlite3*, const std::string& path);

/// A table or column name, quoted for a statement.
std::string quoted_name(std::string_view);

/// Runs SQL statements that return no rows. In all functions, `path` is that of the file, for errors.
Result<void> run(sqlite3*, const std::string& path, const std::string& statements);

struct Deleter {
    void operator()(sqlite3*) const;
    void operator()(sqlite3_stmt*) const;
};
using Handle = std::unique_ptr<sqlite3, Deleter>;

/// Opens a file with these flags (SQLITE_OPEN_...). Statements on it wait up to 10 s for locks of other processes. Closing it does not copy
/// rows from the -wal to the file.
Result<Handle> open(const std::string& path, int flags);

/// A prepared SQL statement.
class Statement {
    std::unique_ptr<sqlite3_stmt, Deleter> statement_;
    sqlite3* database_ = nullptr;
    const std::string* path_ = nullptr;  // path of the file, which outlives the statement

public:
    Statement() = default;
    /// `path` is kept by reference.
    static Result<Statement> make(sqlite3*, const std::string& path, const std::string& text);

    /// Bind a value to a parameter of the statement. Positions count from 1. Text and bytes must stay valid until the statement has run.
    Statement& set(int position, std::int64_t);
    Statement& set(int position, double);  ///< NaN is stored as NULL
    Statement& set(int position, std::string_view);
    Statement& set(int position, std::span<const std::byte>);
    Statement& set_null(int position);

    /// Runs the statement up to its next row. Returns false if there are no more rows.
    Result<bool> step();
    /// Runs the statement to its end, ignoring its rows, and resets it.
    Result<void> finish();
    void reset();  ///< the next step() runs the statement from its beginning; the bound values remain

    /// Values of the current row; columns count from 0.
    std::int64_t integer(int column) const;
    double number(int column) const;  ///< NULL gives NaN
    std::string text(int column) const;
    bool is_null(int column) const;
    std::span<const std::byte> bytes(int column) const;  ///< valid until the next step
};

/// Runs a query: the first column of the first row; 0 if there is no row.
Result<std::int64_t> query_integer(sqlite3*, const std::string& path, const std::string& text);

}  // namespace corpuscle::sql
