#include "study/sweep/sqlite.hpp"

#include <fmt/format.h>
#include <sqlite3.h>
#include <cerrno>
#include <cstring>
#include <limits>

namespace corpuscle::sql {
namespace {

constexpr int wait_ms = 10'000;  // for another program's short hold on the file

std::string reason(sqlite3* file) {
    const int cause = file ? sqlite3_system_errno(file) : errno;
    return cause ? std::strerror(cause) : file ? sqlite3_errmsg(file) : "no memory";
}

/// Too large for the file system, for a quota, or for `ulimit -f`.
bool is_full(sqlite3* file) {
    const int cause = sqlite3_system_errno(file);
    return sqlite3_errcode(file) == SQLITE_FULL || cause == ENOSPC || cause == EDQUOT || cause == EFBIG;
}

}  // namespace

Error failed(sqlite3* file, const std::string& path) {
    const int code = file ? sqlite3_errcode(file) : SQLITE_NOMEM;
    const auto say = [&](const std::string& sentence) { return bad_input(sentence, {path}); };
    if (file && is_full(file))
        return say("the disk is full; all that was written before is kept: make room there and give the same command again");
    switch (code & 0xff) {
        case SQLITE_NOTADB:
            return say("is no SQLite file, so no results of a sweep; give another with --out");
        case SQLITE_CORRUPT:
            return say(fmt::format("is damaged ({}); if it is a copy, copy it together with its -wal file; else give another with --out",
                                   sqlite3_errmsg(file)));
        case SQLITE_READONLY:
        case SQLITE_PERM:
        case SQLITE_CANTOPEN:
            return say(fmt::format("cannot be opened for writing ({}); give a place that can be written to with --out", reason(file)));
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            return say("another program holds this file and does not let go; close it, and give the same command again");
        case SQLITE_IOERR:
            return say(
                fmt::format("cannot be read or written ({}); what was written before is kept: see to the disk and give the same "
                            "command again",
                            reason(file)));
        default:
            return say(fmt::format("SQLite: {}", file ? sqlite3_errmsg(file) : "no memory"));
    }
}

std::string name(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
    return out + "\"";
}

void Closer::operator()(sqlite3* file) const { sqlite3_close(file); }
void Closer::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Result<void> run(sqlite3* file, const std::string& path, const std::string& statements) {
    if (sqlite3_exec(file, statements.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) return failed(file, path);
    return {};
}

Result<Handle> open(const std::string& path, int flags) {
    sqlite3* raw = nullptr;
    const int code = sqlite3_open_v2(path.c_str(), &raw, flags | SQLITE_OPEN_EXRESCODE, nullptr);
    Handle file(raw);
    if (code != SQLITE_OK) return failed(raw, path);
    sqlite3_busy_timeout(raw, wait_ms);
    sqlite3_db_config(raw, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    return file;
}

Result<Statement> Statement::make(sqlite3* file, const std::string& path, const std::string& text) {
    Statement out;
    sqlite3_stmt* raw = nullptr;
    if (sqlite3_prepare_v3(file, text.c_str(), static_cast<int>(text.size()), SQLITE_PREPARE_PERSISTENT, &raw, nullptr) != SQLITE_OK)
        return failed(file, path);
    out.statement_.reset(raw), out.of_ = file, out.path_ = &path;
    return out;
}

// A place that is not there is a mistake of ours; the step that follows would give wrong rows, and tests see it.
Statement& Statement::set(int place, std::int64_t x) { return sqlite3_bind_int64(statement_.get(), place, x), *this; }
Statement& Statement::set(int place, double x) { return sqlite3_bind_double(statement_.get(), place, x), *this; }
Statement& Statement::set(int place, std::string_view x) {
    return sqlite3_bind_text64(statement_.get(), place, x.data() ? x.data() : "", x.size(), SQLITE_STATIC, SQLITE_UTF8), *this;
}
Statement& Statement::set(int place, std::span<const std::byte> x) {
    return sqlite3_bind_blob64(statement_.get(), place, x.data(), x.size(), SQLITE_STATIC), *this;
}
Statement& Statement::set_nothing(int place) { return sqlite3_bind_null(statement_.get(), place), *this; }

Result<bool> Statement::step() {
    const int code = sqlite3_step(statement_.get());
    if (code == SQLITE_ROW) return true;
    if (code == SQLITE_DONE) return false;
    const auto error = failed(of_, *path_);
    rewind();
    return error;
}

Result<void> Statement::finish() {
    for (;;) {
        const auto more = step();
        if (!more) return more.error();
        if (!*more) break;
    }
    rewind();
    return {};
}

void Statement::rewind() { sqlite3_reset(statement_.get()); }

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }
double Statement::number(int column) const {
    return is_nothing(column) ? std::numeric_limits<double>::quiet_NaN() : sqlite3_column_double(statement_.get(), column);
}
std::string Statement::text(int column) const {
    const auto bytes_there = bytes(column);
    return {reinterpret_cast<const char*>(bytes_there.data()), bytes_there.size()};
}
bool Statement::is_nothing(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL; }
std::span<const std::byte> Statement::bytes(int column) const {
    const auto* data = static_cast<const std::byte*>(sqlite3_column_blob(statement_.get(), column));
    return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

Result<std::int64_t> integer(sqlite3* file, const std::string& path, const std::string& text) {
    auto statement = Statement::make(file, path, text);
    if (!statement) return statement.error();
    const auto found = statement->step();
    if (!found) return found.error();
    return *found ? statement->integer(0) : 0;
}

}  // namespace corpuscle::sql
