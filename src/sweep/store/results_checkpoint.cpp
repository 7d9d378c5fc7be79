// Creates and replaces a results file, always by renaming a complete new file, because another program may be copying the old one.
//
// SQLite's wal_checkpoint is not enough for this: it writes into the file, so that a copy made meanwhile would have pages of both states.
// VACUUM INTO writes a new file, but gives its pages other numbers; the old -wal, which remains for a moment after the renaming, would
// damage such a file if the program were killed in that moment. SQLite's backup writes a new file whose pages have the same numbers.

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "io/output/output_file.hpp"
#include "sweep/store/sweep_results.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t min_checkpoint_size = std::int64_t{256} << 20;  // smallest size of a -wal for which add() makes a checkpoint, bytes

/// Size of a file in bytes; 0 if it does not exist.
std::int64_t size_of(const std::string& path) {
    std::error_code status;
    const auto size = fs::file_size(path, status);
    return status ? 0 : static_cast<std::int64_t>(size);
}

Error not_written(const std::string& path) {
    return bad_input(fmt::format("cannot be written ({}); the existing results are kept", std::strerror(errno)), {path});
}

/// Creates an empty file. Never follows a link or reuses an existing file.
Result<void> create_empty(const std::string& path) {
    ::unlink(path.c_str());
    const Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
    return file ? Result<void>() : not_written(path);
}

/// Opens a file that no other process knows yet. If it is in WAL mode, this ends it, so that other programs can read the file in a
/// read-only folder. Each transaction is written to disk at once. There is no journal: a file that cannot be completed is removed.
Result<sql::Database> open_new_file(const std::string& path) {
    auto file = TRY(sql::open(path, SQLITE_OPEN_READWRITE));
    TRY(file.run("PRAGMA locking_mode = EXCLUSIVE; PRAGMA synchronous = FULL; PRAGMA journal_mode = OFF"));
    return file;
}

/// Copies all pages of a database, including those in its -wal, to a new file.
Result<void> copy_pages(const sql::Database& from, const std::string& path) {
    const auto to = TRY(open_new_file(path));
    auto* backup = sqlite3_backup_init(to.file.get(), "main", from.file.get(), "main");
    if (!backup) return to.error();
    sqlite3_backup_step(backup, -1);
    if (sqlite3_backup_finish(backup) != SQLITE_OK) return to.error();
    return {};
}

/// Renames a new file, so that it replaces the other at once, also on the disk.
Result<void> move_into_place(const std::string& from, const std::string& to) {
    if (::rename(from.c_str(), to.c_str()) != 0) return not_written(to);
    (void)sync_directory_of(to);
    return {};
}

}  // namespace

/// Writes a new file with `write` and moves it to the path of the results.
Result<void> SweepResults::replace_file(const std::function<Result<void>(const std::string& new_path)>& write) const {
    auto ok = create_empty(checkpoint_path());
    if (ok) ok = write(checkpoint_path());
    if (ok) ok = move_into_place(checkpoint_path(), path());
    if (!ok) remove_new_file();
    return ok;
}

void SweepResults::remove_new_file() const { ::unlink(checkpoint_path().c_str()), ::unlink((checkpoint_path() + "-wal").c_str()); }

void SweepResults::remove_wal() const { ::unlink(wal_path().c_str()), ::unlink(shared_memory_path().c_str()); }

Result<void> SweepResults::create_file() const {
    remove_wal();  // of a file that was removed; it must not be applied to this file
    return replace_file([&](const std::string& new_path) -> Result<void> {
        auto opened = TRY(open_new_file(new_path));
        opened.path = path();
        return write(opened);
    });
}

void SweepResults::set_next_checkpoint_size() {
    next_checkpoint_size_ = std::max({min_checkpoint_size, size_of(path()), 2 * size_of(wal_path())});
}

// A kill between replacing the file and removing the -wal is safe: the new file with the old -wal has the same content. A copy of the old
// file without its -wal has the content of the previous checkpoint.
Result<void> SweepResults::checkpoint() {
    if (std::error_code status; !fs::exists(wal_path(), status) && !is_writing_) return {};  // no new rows
    auto ok = replace_file([&](const std::string& new_path) -> Result<void> {
        TRY(copy_pages(file_, new_path));
        TRY(open_new_file(new_path));  // ends WAL mode
        return {};
    });
    if (!ok) return ok;
    insert_item_ = {}, insert_spikes_ = {}, insert_probe_ = {}, is_writing_ = false;
    file_.file.reset();
    remove_wal();
    file_ = TRY(sql::open(path(), SQLITE_OPEN_READWRITE));
    return {};
}

}  // namespace corpuscle
