#pragma once
// SQLite with this project's errors: they name the file, the problem and a remedy.

#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace corpuscle::sql {

/// A table or column name, quoted for a statement.
std::string quoted_name(std::string_view);

struct Deleter {
    void operator()(sqlite3*) const;
    void operator()(sqlite3_stmt*) const;
};

/// A prepared SQL statement.
class Statement {
    std::unique_ptr<sqlite3_stmt, Deleter> statement_;
    std::string path_;  // of the file, for errors

public:
    Statement() = default;
    Statement(sqlite3_stmt* statement, std::string path) : statement_(statement), path_(std::move(path)) {}

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
    /// The numbers of a blob; an incomplete last number is ignored.
    template <class T>
    std::vector<T> numbers(int column) const {
        const auto blob = bytes(column);
        std::vector<T> out(blob.size() / sizeof(T));
        if (!out.empty()) std::memcpy(out.data(), blob.data(), out.size() * sizeof(T));
        return out;
    }
};

/// An open SQLite file. It remains open until its last statement has been destroyed.
struct Database {
    std::string path;  ///< for errors
    std::unique_ptr<sqlite3, Deleter> file = {};

    /// Runs SQL statements that return no rows.
    Result<void> run(const std::string& statements) const;
    Result<Statement> prepare(const std::string& statement) const;
    /// Runs a query: the first column of the first row; 0 if there is no row.
    Result<std::int64_t> query_integer(const std::string& query) const;
    /// The error of the last SQLite call on this file.
    Error error() const;
};

/// Opens a file with these flags (SQLITE_OPEN_...). Statements on it wait up to 10 s for locks of other processes. Closing it does not copy
/// rows from the -wal to the file.
Result<Database> open(const std::string& path, int flags);

}  // namespace corpuscle::sql
