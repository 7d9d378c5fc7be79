#include "io/output/output_check.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <algorithm>
#include <filesystem>

#include "core/text/input_files.hpp"
#include "io/output/descriptor.hpp"

namespace corpuscle {
namespace {

/// The kind of file at a path, following links: nothing, an empty or another regular file, a device or pipe, a directory, or a broken link.
enum class FileKind { nothing, empty, regular, device, directory, broken_link };

FileKind kind_of_file(const std::string& path) {
    struct ::stat file_status = {};
    if (::stat(path.c_str(), &file_status) != 0)
        return ::lstat(path.c_str(), &file_status) == 0 ? FileKind::broken_link : FileKind::nothing;
    if (S_ISREG(file_status.st_mode)) return file_status.st_size == 0 ? FileKind::empty : FileKind::regular;
    return S_ISDIR(file_status.st_mode) ? FileKind::directory : FileKind::device;
}

/// Returns the kind of file at an output's path. An output that is also an input is an error.
Result<FileKind> check_not_input(const std::string& path) {
    if (const auto input = known_input_path(path))
        return bad_usage(*input == path ? fmt::format("{}: this output would replace an input of the command; name another", path)
                                        : fmt::format("{}: this output would replace an input of the command (as {}); name another", path,
                                                      *input == "-" ? "standard input" : *input));
    return kind_of_file(path);
}

/// True if replacing a file of this kind could destroy data that this program did not write.
bool may_be_foreign(FileKind kind) { return kind == FileKind::regular || kind == FileKind::broken_link; }

/// True for a regular file that no process has locked, so that the process that created it has ended.
bool is_abandoned(const std::string& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct ::stat file_status = {};
    return ::fstat(file.get(), &file_status) == 0 && S_ISREG(file_status.st_mode) && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0;
}

/// The output to which a temporary file belongs: "spikes.csv" for "spikes.csv.part-123" and "spikes.csv.part-123-2". "" for other files.
std::string_view output_of_part(std::string_view name) {
    constexpr std::string_view part = ".part-";
    const auto at = name.rfind(part);
    if (at == name.npos) return "";
    const auto number = name.substr(at + part.size());
    const bool is_number = !number.empty() && number.front() != '-' && number.find_first_not_of("0123456789-") == number.npos;
    return is_number ? name.substr(0, at) : "";
}

/// Removes the abandoned temporary files in a directory that belong to outputs for whose names `is_output` is true.
void remove_stale_parts_in(const std::string& directory, const std::function<bool(std::string_view)>& is_output) {
    struct Close {
        void operator()(::DIR* d) const { ::closedir(d); }
    };
    const std::unique_ptr<::DIR, Close> open(::opendir(directory.empty() ? "." : directory.c_str()));
    while (const auto* const entry = open ? ::readdir(open.get()) : nullptr) {
        const std::string_view name = entry->d_name;
        const auto output = output_of_part(name);
        const auto path = (std::filesystem::path(directory) / name).string();
        if (!output.empty() && is_output(output) && is_abandoned(path)) ::unlink(path.c_str());
    }
}

}  // namespace

void remove_stale_parts(const std::string& path) {
    const std::filesystem::path output(path);
    remove_stale_parts_in(output.parent_path().string(), [&](std::string_view name) { return name == output.filename().string(); });
}

/// Adds an output of the command. Two outputs with the same path are an error, except for a device.
Result<void> OutputCheck::add_output(const std::string& path) {
    std::error_code status;
    const std::filesystem::path output(path);
    const auto parent = output.parent_path();
    auto absolute = (std::filesystem::weakly_canonical(parent.empty() ? "." : parent, status) / output.filename()).string();
    if (kind_of_file(path) == FileKind::device) return {};
    if (std::find(outputs_.begin(), outputs_.end(), absolute) != outputs_.end())
        return bad_usage(fmt::format("{}: two outputs of this command have this name; rename one of them", path));
    outputs_.push_back(std::move(absolute));
    return {};
}

Result<void> OutputCheck::check_file(const std::string& path, Signature is_ours) {
    TRY(add_output(path));
    const auto kind = TRY(check_not_input(path));
    if (may_be_foreign(kind) && !overwrite_ && !is_ours(peek_input(path)))
        return bad_input("this file was not written by corpuscle; name another, or add --overwrite to replace it", {path});
    if (kind != FileKind::device) remove_stale_parts(path);
    return {};
}

bool is_file_at(int file, const std::string& path) {
    struct ::stat open_file = {}, file_at_path = {};
    return ::fstat(file, &open_file) == 0 && ::stat(path.c_str(), &file_at_path) == 0 && open_file.st_ino == file_at_path.st_ino &&
           open_file.st_dev == file_at_path.st_dev;
}

Result<void> OutputCheck::check_growing_file(const std::string& path, Signature is_ours) {
    TRY(check_file(path, is_ours));
    return kind_of_file(path) == FileKind::device ? Result<void>() : check_file(path + ".part", is_ours);
}

Result<void> OutputCheck::check_directory(const std::string& path, std::span<const std::string> names,
                                          const std::function<bool(const std::string&)>& is_listed, bool (*is_output)(std::string_view),
                                          Signature page) {
    for (const auto& name : names) {
        TRY(add_output(path + "/" + name));
        TRY(check_not_input(path + "/" + name));
    }
    for (const auto& name : names) {
        const auto output = path + "/" + name;
        if (!may_be_foreign(kind_of_file(output)) || overwrite_ || is_listed(name)) continue;
        if (name.ends_with(".html") && page(peek_input(output))) continue;
        return bad_input(
            "this file was not written by corpuscle (it is not listed in a summary.json in its directory); name another directory with "
            "--out, or add --overwrite to replace it",
            {output});
    }
    remove_stale_parts_in(path, is_output);
    return {};
}

}  // namespace corpuscle
