#include "run/skin/skin_checkpoint.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "io/output/output_file.hpp"
#include "io/table/seekable_bytes.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

// FILE: magic and version, fingerprint, checksum of the force, number and checksum of the spikes, the skin's state, checksum of all this.
constexpr std::string_view checkpoint_magic = "corpuscle checkpoint ", checkpoint_version = "2";
constexpr std::string_view spikes_header = "corpuscle told spikes 2\n";
static_assert(spikes_header.size() % sizeof(std::uint64_t) == 0);  // the spikes after the header are aligned

/// A spike as stored in FILE.spikes.
struct StoredSpike {
    std::int64_t step;
    double offset;
    std::uint64_t afferent_index;
};

template <class T>
void append_bytes(std::string& to, const T& x) {
    to.append(reinterpret_cast<const char*>(&x), sizeof x);
}

void append_text(std::string& to, std::string_view text) {
    append_bytes(to, std::uint64_t{text.size()});
    to += text;
}

template <class T>
bool take_front(std::string_view& from, T& x) {
    if (from.size() < sizeof x) return false;
    std::memcpy(&x, from.data(), sizeof x);
    from.remove_prefix(sizeof x);
    return true;
}

bool take_text(std::string_view& from, std::string& text) {
    std::uint64_t size = 0;
    if (!take_front(from, size) || size > from.size()) return false;
    text = from.substr(0, size);
    from.remove_prefix(size);
    return true;
}

bool take_fingerprint(std::string_view& from, RunFingerprint& out) {
    std::uint64_t count = 0;
    if (!take_front(from, count) || count > from.size()) return false;
    for (std::uint64_t k = 0; k < count; ++k)
        if (auto& [name, value] = out.emplace_back(); !take_text(from, name) || !take_text(from, value)) return false;
    return true;
}

/// Says how an entry of the fingerprint differs: `then` is its value in the checkpoint, `now` in this run; null if the entry is
/// missing.
std::string difference(const std::string& name, const std::string* then, const std::string* now) {
    if (name.starts_with("contents of")) return fmt::format("the {} have changed", name);
    if (!then) return fmt::format("{} was not given and now is {}", name, *now);
    return now ? fmt::format("{} was {} and now is {}", name, *then, *now) : fmt::format("{} was {} and now is not given", name, *then);
}

/// The differences between the fingerprints of two runs, in words; "" if there are none.
std::string differences(const RunFingerprint& then, const RunFingerprint& now) {
    const auto value_in = [](const RunFingerprint& all, const std::string& name) {
        const auto at = std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.first == name; });
        return at == all.end() ? nullptr : &at->second;
    };
    std::vector<std::string> found;
    for (const auto& [name, value] : then)
        if (const auto* other = value_in(now, name); !other || *other != value) found.push_back(difference(name, &value, other));
    for (const auto& [name, value] : now)
        if (!value_in(then, name)) found.push_back(difference(name, nullptr, &value));
    return fmt::format("{}", fmt::join(found, "; "));
}

/// True for a regular file that begins with this text.
bool begins_with(const std::string& path, std::string_view prefix) {
    std::error_code status;
    if (!fs::is_regular_file(path, status)) return false;
    std::ifstream in(path, std::ios::binary);
    std::string head(prefix.size(), '\0');
    return in.read(head.data(), static_cast<std::streamsize>(head.size())) && head == prefix;
}

/// True if the open file is still the file at this path.
bool is_file_at(int file, const std::string& path) {
    struct ::stat open_file = {}, file_at_path = {};
    return ::fstat(file, &open_file) == 0 && ::stat(path.c_str(), &file_at_path) == 0 && open_file.st_ino == file_at_path.st_ino &&
           open_file.st_dev == file_at_path.st_dev;
}

}  // namespace

Error SkinCheckpoint::system_error(const std::string& path) const { return bad_input(std::strerror(errno), {path}); }

std::string SkinCheckpoint::remedy() const {
    return fmt::format("remove {} and {} to start over, or name another file with --checkpoint", file_, spikes_file_);
}

Error SkinCheckpoint::changed_force_error() const {
    return bad_input(fmt::format("the force before this checkpoint differs from the force of the run that wrote it; {}", remedy()),
                     {file_});
}

Result<std::unique_ptr<SkinCheckpoint>> SkinCheckpoint::open(const std::string& file, Skin& skin, RunFingerprint fingerprint) {
    std::unique_ptr<SkinCheckpoint> checkpoint(new SkinCheckpoint(file, skin, std::move(fingerprint)));
    if (auto ok = checkpoint->check_file(); !ok) return ok.error();
    if (auto ok = checkpoint->lock_spikes(); !ok) return ok.error();
    std::error_code status;
    if (fs::exists(file, status))
        if (auto ok = checkpoint->resume(); !ok) return ok.error();
    // Spikes after the last checkpoint are removed; this run computes them again.
    const auto end = spikes_header.size() + checkpoint->spike_count_ * sizeof(StoredSpike);
    if (::ftruncate(::fileno(checkpoint->spikes_), static_cast<off_t>(end)) != 0) return checkpoint->system_error(checkpoint->spikes_file_);
    return checkpoint;
}

/// Removes FILE.spikes if there is no checkpoint that refers to it.
SkinCheckpoint::~SkinCheckpoint() {
    if (!spikes_) return;
    std::error_code ignored;
    if (!fs::exists(file_, ignored) && is_file_at(::fileno(spikes_), spikes_file_) && begins_with(spikes_file_, spikes_header))
        fs::remove(spikes_file_, ignored);
    std::fclose(spikes_);
}

/// Returns an error if FILE exists and is not a checkpoint of the current version.
Result<void> SkinCheckpoint::check_file() const {
    std::error_code status;
    if (!fs::exists(file_, status)) return {};
    if (!begins_with(file_, checkpoint_magic))
        return bad_input("this file is not a checkpoint and was left unchanged; name another with --checkpoint", {file_});
    if (!begins_with(file_, fmt::format("{}{}\n", checkpoint_magic, checkpoint_version))) {
        std::ifstream in(file_, std::ios::binary);
        std::string line;
        std::getline(in, line);
        const auto file_version = line.substr(checkpoint_magic.size(), 20);
        return bad_input(
            fmt::format("this is a checkpoint of version {}; this program resumes only version {} (version 1 does not record how "
                        "the force was made). Finish the run with the program that started it, or {}",
                        file_version.find_first_not_of("0123456789") == std::string::npos ? file_version : "?", checkpoint_version,
                        remedy()),
            {file_});
    }
    if (!fs::exists(spikes_file_, status))
        return bad_input(fmt::format("its spikes, {}, are missing; remove {} to start over, or name another file with --checkpoint",
                                     spikes_file_, file_),
                         {file_});
    return {};
}

/// Opens FILE.spikes and locks it. Tries again if another process removes it between the two steps.
Result<void> SkinCheckpoint::lock_spikes() {
    for (int tries = 0; tries < 100; ++tries) {
        int file = ::open(spikes_file_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        const bool is_new = file >= 0;
        if (!is_new && errno != EEXIST) return system_error(spikes_file_);
        if (!is_new) file = ::open(spikes_file_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
        if (file < 0 && errno == ENOENT) continue;
        if (file < 0) return system_error(spikes_file_);
        if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
            const int why = errno;
            ::close(file);
            errno = why;
            if (why != EWOULDBLOCK) return system_error(spikes_file_);
            return bad_input("another run is using this checkpoint; wait for it to end, or name another file with --checkpoint", {file_});
        }
        if (!is_file_at(file, spikes_file_)) {
            ::close(file);
            continue;
        }
        if (is_new && ::write(file, spikes_header.data(), spikes_header.size()) != static_cast<ssize_t>(spikes_header.size())) {
            const auto error = system_error(spikes_file_);
            ::unlink(spikes_file_.c_str());
            ::close(file);
            return error;
        }
        spikes_ = ::fdopen(file, "r+b");
        return check_spikes_header();
    }
    return bad_input("cannot be opened", {spikes_file_});
}

Result<void> SkinCheckpoint::check_spikes_header() const {
    if (begins_with(spikes_file_, spikes_header)) return {};
    return bad_input(fmt::format("this file was not written by a checkpoint of this version and was left unchanged; move it away, or name "
                                 "another file than {} with --checkpoint",
                                 file_),
                     {spikes_file_});
}

Result<void> SkinCheckpoint::resume() {
    std::ifstream in(file_, std::ios::binary);
    const std::string all((std::istreambuf_iterator<char>(in)), {});
    const auto damaged = bad_input(fmt::format("this checkpoint is damaged; {}", remedy()), {file_});
    std::uint64_t sum = 0, spikes_sum = 0;
    if (all.size() < sizeof sum) return damaged;
    std::memcpy(&sum, all.data() + all.size() - sizeof sum, sizeof sum);
    std::string_view left(all.data(), all.size() - sizeof sum);
    if (checksum_of(std::as_bytes(std::span(left))) != sum) return damaged;
    left.remove_prefix(std::min(left.size(), left.find('\n') + 1));
    RunFingerprint then;
    if (!take_fingerprint(left, then)) return damaged;
    if (const auto differing = differences(then, fingerprint_); !differing.empty())
        return bad_input(
            fmt::format("this checkpoint belongs to another run: {}. Repeat the run with its original options, {}", differing, remedy()),
            {file_});
    std::string state;
    if (!take_front(left, force_to_resumed_) || !take_front(left, spike_count_) || !take_front(left, spikes_sum) ||
        !take_text(left, state) || !left.empty())
        return damaged;
    if (auto ok = skin_.resume(std::as_bytes(std::span(state))); !ok)
        return bad_input(fmt::format("{}; {}", ok.error().message, remedy()), {file_});
    resumed_samples_ = skin_.step();
    return check_spikes(spikes_sum);
}

/// Checks that the spikes in FILE.spikes have the number and checksum that FILE says, are in order, and have valid afferent indexes and
/// times.
Result<void> SkinCheckpoint::check_spikes(std::uint64_t checksum) {
    std::error_code status;
    const auto size = fs::file_size(spikes_file_, status), stored = (size - std::min(size, spikes_header.size())) / sizeof(StoredSpike);
    if (status || spike_count_ > stored)
        return bad_input(fmt::format("it has {} spikes, but {} was written after {} spikes; {}", stored, file_, spike_count_, remedy()),
                         {spikes_file_});
    std::fseek(spikes_, static_cast<long>(spikes_header.size()), SEEK_SET);
    std::array<StoredSpike, 1024> buffer;
    Spike last;
    bool is_valid = true;
    for (std::uint64_t at = 0; at < spike_count_ && is_valid;) {
        const auto count = std::fread(buffer.data(), sizeof buffer[0], std::min<std::uint64_t>(buffer.size(), spike_count_ - at), spikes_);
        if (count == 0) return system_error(spikes_file_);
        spikes_sum_.add(buffer.data(), count * sizeof buffer[0]);
        for (std::size_t k = 0; k < count; ++k) {
            const auto& s = buffer[k];
            const Spike spike{s.step, s.offset, static_cast<std::uint32_t>(s.afferent_index)};
            is_valid &= s.afferent_index < skin_.innervation().afferents.size() && s.step >= 0 && s.step < resumed_samples_ &&
                        s.offset > 0 && s.offset <= 1 && ((at == 0 && k == 0) || last <= spike);
            last = spike;
        }
        at += count;
    }
    if (is_valid && spikes_sum_.value() == checksum) return {};
    return bad_input(fmt::format("these spikes are damaged: they do not match {}; {}", file_, remedy()), {spikes_file_});
}

Result<void> SkinCheckpoint::add_force(const SkinForce::Block& block, std::int64_t first) {
    const auto steps = block.total_force.size();
    force_sum_.add(block.total_force.data(), block.total_force.size_bytes());
    block.force.for_each_site(
        skin_.sites(), [&](std::size_t site) { force_sum_.add(block.force.data + site * block.force.stride, steps * sizeof(double)); });
    const auto end = first + static_cast<std::int64_t>(steps);
    // A checkpoint is made between two blocks. In the block that ends there, the force so far must have the same checksum.
    if (resumed_samples_ <= first || resumed_samples_ > end) return {};
    return resumed_samples_ == end && force_sum_.value() == force_to_resumed_ ? Result<void>() : changed_force_error();
}

Result<void> SkinCheckpoint::finish(std::int64_t samples) {
    return samples < resumed_samples_ ? Result<void>(changed_force_error()) : Result<void>();
}

Result<void> SkinCheckpoint::replay(std::int64_t end, std::vector<Spike>& spikes) {
    // A block includes the spikes with a step before `end`, the first sample of the next block.
    if (replayed_ == 0 && read_ahead_.empty()) std::fseek(spikes_, static_cast<long>(spikes_header.size()), SEEK_SET);
    for (StoredSpike stored{};;) {
        if (read_ahead_.empty()) {
            if (replayed_ >= spike_count_) return {};
            if (std::fread(&stored, sizeof stored, 1, spikes_) != 1) return system_error(spikes_file_);
            ++replayed_;
            read_ahead_.push_back({stored.step, stored.offset, static_cast<std::uint32_t>(stored.afferent_index)});
        }
        if (read_ahead_[0].step >= end) return {};
        spikes.push_back(read_ahead_[0]);
        read_ahead_.clear();
    }
}

Result<void> SkinCheckpoint::append(std::span<const Spike> spikes) {
    std::string bytes;
    for (const auto& s : spikes) append_bytes(bytes, StoredSpike{s.step, s.offset, s.afferent_index});
    std::fseek(spikes_, static_cast<long>(spikes_header.size() + spike_count_ * sizeof(StoredSpike)), SEEK_SET);
    if (std::fwrite(bytes.data(), 1, bytes.size(), spikes_) != bytes.size()) return system_error(spikes_file_);
    spikes_sum_.add(bytes.data(), bytes.size());
    spike_count_ += spikes.size();
    return {};
}

/// Writes the spikes to disk before FILE, which contains their number; FILE gets its name only when it is complete on disk.
Result<void> SkinCheckpoint::flush() {
    if (std::fflush(spikes_) != 0 || ::fsync(::fileno(spikes_)) != 0) return system_error(spikes_file_);
    std::string bytes = fmt::format("{}{}\n", checkpoint_magic, checkpoint_version);
    append_bytes(bytes, std::uint64_t{fingerprint_.size()});
    for (const auto& [name, value] : fingerprint_) append_text(bytes, name), append_text(bytes, value);
    append_bytes(bytes, force_sum_.value()), append_bytes(bytes, spike_count_), append_bytes(bytes, spikes_sum_.value());
    const auto state = skin_.save();
    append_text(bytes, {reinterpret_cast<const char*>(state.data()), state.size()});
    append_bytes(bytes, checksum_of(std::as_bytes(std::span(bytes))));
    auto out = OutputFile::create(file_);
    if (!out) return out.error();
    if (auto ok = out->write(bytes); !ok) return ok;
    if (auto ok = out->commit(SyncPolicy::always); !ok) return ok;
    return sync_directory_of(file_);
}

/// The lock is held until both files are removed. An output of the same name is not a checkpoint and is not removed.
void SkinCheckpoint::remove_files() {
    std::error_code ignored;
    if (begins_with(file_, checkpoint_magic)) fs::remove(file_, ignored);
    if (is_file_at(::fileno(spikes_), spikes_file_)) fs::remove(spikes_file_, ignored);
    std::fclose(std::exchange(spikes_, nullptr));
}

Result<std::string> checksum_of_file(const std::string& path) {
    auto file = open_bytes(path);
    if (!file) return file.error();
    Checksum sum;
    std::vector<std::byte> buffer(std::size_t{1} << 20);
    for (auto left = (*file)->size(); left > 0;) {
        const auto chunk = std::span(buffer).first(std::min<std::uint64_t>(buffer.size(), left));
        if (auto ok = (*file)->read(chunk); !ok) return ok.error();
        sum.add(chunk.data(), chunk.size());
        left -= chunk.size();
    }
    return fmt::format("{} bytes, checksum {:016x}", (*file)->size(), sum.value());
}

}  // namespace corpuscle
