// Creates and replaces a results file, always by renaming a complete new file, because another program may be copying the old one.

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "sweep/store/results_impl.hpp"

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

/// Makes the operating system write a file to disk, so that it survives a loss of power. `without_wal`: first marks it as a file without a
/// -wal (bytes 18 and 19 of SQLite's file format).
Result<void> sync_file(const std::string& path, bool without_wal) {
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0) return not_written(path);
    constexpr std::array<char, 2> versions = {1, 1};
    const bool ok = (!without_wal || ::pwrite(file, versions.data(), versions.size(), 18) == 2) && ::fsync(file) == 0;
    ::close(file);
    if (!ok) return not_written(path);
    return {};
}

Result<void> move_into_place(const std::string& from, const std::string& to) {
    if (::rename(from.c_str(), to.c_str()) != 0) return not_written(to);
    return {};
}

/// Creates an empty file. Never follows a link or reuses an existing file.
Result<void> create_empty(const std::string& path) {
    ::unlink(path.c_str());
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file < 0) return not_written(path);
    ::close(file);
    return {};
}

/// Makes the operating system write the folder of a file to disk, so that a rename survives a loss of power.
void sync_folder(const std::string& path) {
    const auto folder = fs::path(path).parent_path();
    const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return;
    ::fsync(file);
    ::close(file);
}

/// Copies all pages of one database, including those in its -wal, to the other, with the same page numbers. `path`: of the other, for
/// errors.
Result<void> copy_pages(sqlite3* from, sqlite3* to, const std::string& path) {
    auto* backup = sqlite3_backup_init(to, "main", from, "main");
    if (!backup) return sql::error_of(to, path);
    sqlite3_backup_step(backup, -1);
    if (sqlite3_backup_finish(backup) != SQLITE_OK) return sql::error_of(to, path);
    return {};
}

}  // namespace

Result<void> SweepResults::Impl::create_file() const {
    // A -wal that remains of a removed file must not be applied to this file.
    ::unlink(wal_path().c_str()), ::unlink(shared_memory_path().c_str());
    TRY(create_empty(checkpoint_path()));
    auto database = TRY(sql::open(checkpoint_path(), SQLITE_OPEN_READWRITE));
    TRY(sql::run(database.get(), path, "PRAGMA journal_mode = OFF"));
    auto ok = layout.write(database.get(), path);
    database.reset();
    if (ok) ok = sync_file(checkpoint_path(), false);
    if (ok) ok = move_into_place(checkpoint_path(), path);
    if (!ok) return ::unlink(checkpoint_path().c_str()), ok;
    sync_folder(path);
    return {};
}

void SweepResults::Impl::set_next_checkpoint_size() {
    next_checkpoint_size = std::max({min_checkpoint_size, size_of(path), 2 * size_of(wal_path())});
}

// The new file contains the newest version of each page. A crash between renaming it and removing the -wal is safe: the new file with the
// old -wal has the same content. A copy of the old file without its -wal has the content of the previous checkpoint.
Result<void> SweepResults::Impl::checkpoint(bool last) {
    if (std::error_code status; !fs::exists(wal_path(), status) && !is_writing) return {};  // no new rows
    {
        TRY(create_empty(checkpoint_path()));
        auto database = sql::open(checkpoint_path(), SQLITE_OPEN_READWRITE);
        auto ok = database ? sql::run(database->get(), checkpoint_path(), "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF")
                           : database.error();
        if (ok) ok = copy_pages(file.get(), database->get(), checkpoint_path());
        if (ok) database->reset(), ok = sync_file(checkpoint_path(), last);
        if (!ok) return ::unlink(checkpoint_path().c_str()), ok;
    }
    insert_item = {}, insert_spikes = {}, insert_probe = {}, is_writing = false;
    file.reset();
    TRY(move_into_place(checkpoint_path(), path));
    ::unlink(wal_path().c_str()), ::unlink(shared_memory_path().c_str());
    sync_folder(path);
    return open_file(SQLITE_OPEN_READWRITE);
}

Result<void> SweepResults::checkpoint() { return impl_->checkpoint(true); }

}  // namespace corpuscle
