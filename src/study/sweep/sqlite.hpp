#pragma once
// SQLite, with errors as ours are: what went wrong with which file, and what to do.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "signal/error.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace corpuscle::sql {

/// What the last call on this file came to.
Error failed(sqlite3*, const std::string& path);

/// A name of a table or column as it stands in a statement.
std::string name(std::string_view);

Result<void> run(sqlite3*, const std::string& path, const std::string& statements);

struct Closer {
    void operator()(sqlite3*) const;
    void operator()(sqlite3_stmt*) const;
};
using Handle = std::unique_ptr<sqlite3, Closer>;

/// Opened with these flags (SQLITE_OPEN_...); its close never writes into the file, and what another holds is waited for a while.
Result<Handle> open(const std::string& path, int flags);

class Statement {
    std::unique_ptr<sqlite3_stmt, Closer> statement_;
    sqlite3* of_ = nullptr;
    const std::string* path_ = nullptr;  // the file's, which outlives it

public:
    Statement() = default;
    static Result<Statement> make(sqlite3*, const std::string& path, const std::string& text);

    /// Places count from 1. Text and bytes stay where they are until the statement is run.
    Statement& set(int place, std::int64_t);
    Statement& set(int place, double);  ///< NaN: nothing
    Statement& set(int place, std::string_view);
    Statement& set(int place, std::span<const std::byte>);
    Statement& set_nothing(int place);

    /// Whether there is a row (more).
    Result<bool> step();
    /// For one that gives no rows: to its end, and ready to be run again.
    Result<void> finish();
    void rewind();

    /// Of the row; columns count from 0.
    std::int64_t integer(int column) const;
    double number(int column) const;  ///< nothing: NaN
    std::string text(int column) const;
    bool is_nothing(int column) const;
    std::span<const std::byte> bytes(int column) const;  ///< until the next step
};

/// The first column of the first row; nothing found: 0.
Result<std::int64_t> integer(sqlite3*, const std::string& path, const std::string& text);

}  // namespace corpuscle::sql
