#include "sweep/store/sqlite.hpp"

#include <fmt/format.h>
#include <sqlite3.h>
#include <cerrno>
#include <cstring>
#include <limits>

namespace corpuscle::sql {
namespace {

constexpr int wait_ms = 10'000;           // longest wait for locks of other processes
constexpr int max_value_size = 64 << 20;  // bytes of one text or blob, such as the 16 million samples of a probe

/// Disables triggers and views that a file contains, since another program may have written it. Also makes a name in double quotes that is
/// not a column an error, not a text, and limits the size of values.
void restrict_connection(sqlite3* file) {
    for (const int option : {SQLITE_DBCONFIG_DQS_DML, SQLITE_DBCONFIG_DQS_DDL, SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_ENABLE_VIEW,
                             SQLITE_DBCONFIG_TRUSTED_SCHEMA})
        sqlite3_db_config(file, option, 0, nullptr);
    sqlite3_limit(file, SQLITE_LIMIT_LENGTH, max_value_size);
}

/// The errno of the failed system call. SQLite does not keep it for a -wal that cannot be written.
int cause_of(sqlite3* file) {
    const int cause = sqlite3_system_errno(file);
    return cause == 0 && sqlite3_extended_errcode(file) == SQLITE_IOERR_WRITE ? errno : cause;
}

/// The system's message, or SQLite's if no system call failed.
std::string error_reason(sqlite3* file) {
    const int cause = cause_of(file);
    return cause ? std::strerror(cause) : sqlite3_errmsg(file);
}

/// True if the file system or its quota is full.
bool is_full(sqlite3* file) {
    const int cause = cause_of(file);
    return sqlite3_errcode(file) == SQLITE_FULL || cause == ENOSPC || cause == EDQUOT;
}

/// The error of the last SQLite call on a file; null: it could not be opened.
Error error_of(sqlite3* file, const std::string& path) {
    const auto error = [&](const std::string& sentence) { return bad_input(sentence, {path}); };
    if (!file) return error("there is not enough memory to open it");
    if (cause_of(file) == EFBIG)
        return error(
            "has reached the limit on file sizes ('ulimit -f'); everything written before is kept: raise that limit and repeat the "
            "command");
    if (is_full(file)) return error("the disk is full; everything written before is kept: free some space and repeat the command");
    switch (sqlite3_errcode(file) & 0xff) {
        case SQLITE_NOTADB:
            return error("is not an SQLite file, and so not a results file of a sweep; name another file");
        case SQLITE_CORRUPT:
            return error(
                fmt::format("is damaged ({}); if it is a copy, copy it together with its -wal file; otherwise give another with --out",
                            sqlite3_errmsg(file)));
        case SQLITE_READONLY:
        case SQLITE_PERM:
        case SQLITE_CANTOPEN:
            return error(fmt::format("cannot be opened for writing ({}); give a writable path with --out", error_reason(file)));
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            return error("another program has locked this file; close it, and repeat the command");
        case SQLITE_IOERR:
            return error(
                fmt::format("cannot be read or written ({}); what was written before is kept: check the disk and repeat the "
                            "command",
                            error_reason(file)));
        case SQLITE_TOOBIG:
            return error(
                fmt::format("a text or a blob is larger than {} MB; keep fewer traces, or increase 'every'", max_value_size >> 20));
        case SQLITE_ERROR:
            return error(fmt::format(
                "is not a results file as a sweep writes it ({}): it was changed by another program; use an earlier copy, or give "
                "another file with --out",
                sqlite3_errmsg(file)));
        default:
            return error(fmt::format("SQLite: {}", sqlite3_errmsg(file)));
    }
}

}  // namespace

std::string quoted_name(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
    return out + "\"";
}

void Deleter::operator()(sqlite3* file) const { sqlite3_close_v2(file); }
void Deleter::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Error Database::error() const { return error_of(file.get(), path); }

Result<void> Database::run(const std::string& statements) const {
    if (sqlite3_exec(file.get(), statements.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) return error();
    return {};
}

Result<Statement> Database::prepare(const std::string& text) const {
    sqlite3_stmt* opened = nullptr;
    if (sqlite3_prepare_v3(file.get(), text.c_str(), static_cast<int>(text.size()), SQLITE_PREPARE_PERSISTENT, &opened, nullptr) !=
        SQLITE_OK)
        return error();
    return Statement(opened, path);
}

Result<std::int64_t> Database::query_integer(const std::string& query) const {
    auto statement = TRY(prepare(query));
    return TRY(statement.step()) ? statement.integer(0) : 0;
}

Result<Database> open(const std::string& path, int flags) {
    sqlite3* opened = nullptr;
    const int code = sqlite3_open_v2(path.c_str(), &opened, flags | SQLITE_OPEN_EXRESCODE, nullptr);
    Database out{path, std::unique_ptr<sqlite3, Deleter>(opened)};
    if (code != SQLITE_OK) return out.error();
    sqlite3_busy_timeout(opened, wait_ms);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    restrict_connection(opened);
    return out;
}

// A position that does not exist is a programming error; the next step would return wrong rows, which tests detect.
Statement& Statement::set(int position, std::int64_t x) { return sqlite3_bind_int64(statement_.get(), position, x), *this; }
Statement& Statement::set(int position, double x) { return sqlite3_bind_double(statement_.get(), position, x), *this; }
Statement& Statement::set(int position, std::string_view x) {
    return sqlite3_bind_text64(statement_.get(), position, x.data() ? x.data() : "", x.size(), SQLITE_STATIC, SQLITE_UTF8), *this;
}
Statement& Statement::set(int position, std::span<const std::byte> x) {
    return sqlite3_bind_blob64(statement_.get(), position, x.data(), x.size(), SQLITE_STATIC), *this;
}
Statement& Statement::set_null(int position) { return sqlite3_bind_null(statement_.get(), position), *this; }

Result<bool> Statement::step() {
    const int code = sqlite3_step(statement_.get());
    if (code == SQLITE_ROW) return true;
    if (code == SQLITE_DONE) return false;
    const auto error = error_of(sqlite3_db_handle(statement_.get()), path_);
    reset();
    return error;
}

Result<void> Statement::finish() {
    while (TRY(step())) {
    }
    reset();
    return {};
}

void Statement::reset() { sqlite3_reset(statement_.get()); }

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }
double Statement::number(int column) const {
    return is_null(column) ? std::numeric_limits<double>::quiet_NaN() : sqlite3_column_double(statement_.get(), column);
}
std::string Statement::text(int column) const {
    const auto data = bytes(column);
    return {reinterpret_cast<const char*>(data.data()), data.size()};
}
bool Statement::is_null(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL; }
std::span<const std::byte> Statement::bytes(int column) const {
    const auto* data = static_cast<const std::byte*>(sqlite3_column_blob(statement_.get(), column));
    return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

}  // namespace corpuscle::sql
