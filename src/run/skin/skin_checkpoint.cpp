#include "run/skin/skin_checkpoint.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/bytes.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/input_files.hpp"
#include "io/output/output_check.hpp"
#include "io/output/output_file.hpp"
#include "io/table/archive.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

// FILE: header, fingerprint, checksum of the force, number and checksum of the spikes, the skin's state, checksum of all this.
constexpr std::string_view checkpoint_magic = "corpuscle checkpoint ", checkpoint_header = "corpuscle checkpoint 2\n";
constexpr std::size_t max_checkpoint = std::size_t{1} << 36;             // bytes of FILE
constexpr std::string_view spikes_header = "corpuscle told spikes 2\n";  // "told": handed to the sinks
static_assert(spikes_header.size() % sizeof(std::uint64_t) == 0);        // the spikes after the header are aligned

/// A spike as stored in FILE.spikes.
struct StoredSpike {
    std::int64_t step;
    double offset;
    std::uint64_t afferent_index;
};

Spike spike_of(const StoredSpike& s) { return {s.step, s.offset, static_cast<std::uint32_t>(s.afferent_index)}; }

/// The position in FILE.spikes of the spike with this index, bytes.
long position_of_spike(std::uint64_t index) { return static_cast<long>(spikes_header.size() + index * sizeof(StoredSpike)); }

/// The differences between the fingerprints of two runs, in words; "" if there are none.
std::string differences(const RunFingerprint& then, const RunFingerprint& now) {
    const auto value_in = [](const RunFingerprint& all, const std::string& name) {
        const auto at = std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.first == name; });
        return at == all.end() ? nullptr : &at->second;
    };
    std::vector<std::string> found;
    const auto compare = [&](const std::string& name) {
        const auto *before = value_in(then, name), *after = value_in(now, name);
        if (before && after && *before == *after) return;
        found.push_back(name.starts_with("contents of")
                            ? fmt::format("the {} have changed", name)
                            : fmt::format("{} was {} and now is {}", name, before ? *before : "not given", after ? *after : "not given"));
    };
    for (const auto& entry : then) compare(entry.first);
    for (const auto& entry : now)
        if (!value_in(then, entry.first)) compare(entry.first);
    return joined(found, "; ");
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
    TRY(checkpoint->check_file());
    TRY(checkpoint->lock_spikes());
    if (!peek_input(checkpoint->spikes_file_).starts_with(spikes_header))
        return bad_input(fmt::format("this file was not written by a checkpoint of this version and was left unchanged; move it away, or "
                                     "name another file than {} with --checkpoint",
                                     file),
                         {checkpoint->spikes_file_});
    std::error_code status;
    if (fs::exists(file, status)) TRY(checkpoint->resume());
    // Spikes after the last checkpoint are removed; this run computes them again.
    if (::ftruncate(::fileno(checkpoint->spikes_.get()), position_of_spike(checkpoint->spike_count_)) != 0)
        return checkpoint->system_error(checkpoint->spikes_file_);
    return checkpoint;
}

/// Removes FILE.spikes if there is no checkpoint that refers to it.
SkinCheckpoint::~SkinCheckpoint() {
    if (!spikes_) return;
    std::error_code ignored;
    if (!fs::exists(file_, ignored) && is_file_at(::fileno(spikes_.get()), spikes_file_) &&
        peek_input(spikes_file_).starts_with(spikes_header))
        fs::remove(spikes_file_, ignored);
}

/// Returns an error if FILE exists and is not a checkpoint of the current version.
Result<void> SkinCheckpoint::check_file() const {
    std::error_code status;
    if (!fs::exists(file_, status)) return {};
    const auto beginning = peek_input(file_);
    if (!beginning.starts_with(checkpoint_magic))
        return bad_input("this file is not a checkpoint and was left unchanged; name another with --checkpoint", {file_});
    if (!beginning.starts_with(checkpoint_header)) {
        const auto file_version = beginning.substr(0, beginning.find('\n')).substr(checkpoint_magic.size(), 20);
        return bad_input(
            fmt::format("this is a checkpoint of version {}; this program resumes only version 2 (version 1 does not record how "
                        "the force was made). Finish the run with the program that started it, or {}",
                        file_version.find_first_not_of("0123456789") == std::string::npos ? file_version : "?", remedy()),
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
        FileHandle spikes(::fdopen(file, "r+b"));
        if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
            if (errno != EWOULDBLOCK) return system_error(spikes_file_);
            return bad_input("another run is using this checkpoint; wait for it to end, or name another file with --checkpoint", {file_});
        }
        if (!is_file_at(file, spikes_file_)) continue;
        if (is_new && ::write(file, spikes_header.data(), spikes_header.size()) != static_cast<ssize_t>(spikes_header.size())) {
            const auto error = system_error(spikes_file_);
            ::unlink(spikes_file_.c_str());
            return error;
        }
        spikes_ = std::move(spikes);
        return {};
    }
    return bad_input("cannot be opened", {spikes_file_});
}

Result<void> SkinCheckpoint::resume() {
    const auto all = TRY(read_entire_input(file_, max_checkpoint, "checkpoint"));
    const auto damaged = bad_input(fmt::format("this checkpoint is damaged; {}", remedy()), {file_});
    ByteReader in(all);
    std::string header(checkpoint_header.size(), '\0');  // check_file() has read it
    RunFingerprint then;
    if (!in.check_checksum(std::as_bytes(std::span(all))) || !in.get_raw(header.data(), header.size()) || !in.get(then)) return damaged;
    if (const auto differing = differences(then, fingerprint_); !differing.empty())
        return bad_input(
            fmt::format("this checkpoint belongs to another run: {}. Repeat the run with its original options, {}", differing, remedy()),
            {file_});
    std::uint64_t spikes_sum = 0;
    std::vector<std::byte> state;
    if (!in.get(force_to_resumed_, spike_count_, spikes_sum, state) || !in.ended()) return damaged;
    if (auto ok = skin_.resume(state); !ok) return bad_input(fmt::format("{}; {}", ok.error().message, remedy()), {file_});
    resumed_samples_ = skin_.step();
    return check_spikes(spikes_sum);
}

/// Checks that the spikes in FILE.spikes have the number and checksum that FILE says, are in order, and have valid afferent indexes and
/// times.
Result<void> SkinCheckpoint::check_spikes(std::uint64_t checksum) {
    std::error_code status;
    const auto size = fs::file_size(spikes_file_, status), in_file = (size - std::min(size, spikes_header.size())) / sizeof(StoredSpike);
    if (status || spike_count_ > in_file)
        return bad_input(fmt::format("it has {} spikes, but {} was written after {} spikes; {}", in_file, file_, spike_count_, remedy()),
                         {spikes_file_});
    std::fseek(spikes_.get(), position_of_spike(0), SEEK_SET);
    bool is_valid = true;
    Spike last{-1};
    for (std::uint64_t k = 0; k < spike_count_ && is_valid; ++k) {
        StoredSpike stored;
        if (std::fread(&stored, sizeof stored, 1, spikes_.get()) != 1) return system_error(spikes_file_);
        spikes_sum_.add(&stored, sizeof stored);
        const auto spike = spike_of(stored);
        is_valid = stored.afferent_index < skin_.innervation().afferents.size() && spike.step >= 0 && spike.step < resumed_samples_ &&
                   spike.offset > 0 && spike.offset <= 1 && last <= spike;
        last = spike;
    }
    if (is_valid && spikes_sum_.value() == checksum) return {};
    return bad_input(fmt::format("these spikes are damaged: they do not match {}; {}", file_, remedy()), {spikes_file_});
}

Result<void> SkinCheckpoint::add_force(const SkinForce::Block& block, std::int64_t first) {
    const auto steps = block.total_force.size();
    force_sum_.add(block.total_force.data(), block.total_force.size_bytes());
    block.force.for_each_component([&](const double* component) {
        block.force.for_each_site(skin_.sites(),
                                  [&](std::size_t site) { force_sum_.add(component + site * block.force.stride, steps * sizeof(double)); });
    });
    const auto end = first + static_cast<std::int64_t>(steps);
    // A checkpoint is made between two blocks. In the block that ends there, the force so far must have the same checksum.
    if (resumed_samples_ <= first || resumed_samples_ > end) return {};
    return resumed_samples_ == end && force_sum_.value() == force_to_resumed_ ? Result<void>() : changed_force_error();
}

Result<void> SkinCheckpoint::finish(std::int64_t samples) {
    return samples < resumed_samples_ ? Result<void>(changed_force_error()) : Result<void>();
}

Result<void> SkinCheckpoint::replay(std::int64_t end, std::vector<Spike>& spikes) {
    std::fseek(spikes_.get(), position_of_spike(replayed_), SEEK_SET);
    for (; replayed_ < spike_count_; ++replayed_) {
        StoredSpike stored;
        if (std::fread(&stored, sizeof stored, 1, spikes_.get()) != 1) return system_error(spikes_file_);
        if (stored.step >= end) return {};  // it belongs to a later block
        spikes.push_back(spike_of(stored));
    }
    return {};
}

Result<void> SkinCheckpoint::append(std::span<const Spike> spikes) {
    std::vector<StoredSpike> stored;
    for (const auto& s : spikes) stored.push_back({s.step, s.offset, s.afferent_index});
    std::fseek(spikes_.get(), position_of_spike(spike_count_), SEEK_SET);
    if (std::fwrite(stored.data(), sizeof(StoredSpike), stored.size(), spikes_.get()) != stored.size()) return system_error(spikes_file_);
    spikes_sum_.add(stored.data(), stored.size() * sizeof(StoredSpike));
    spike_count_ += stored.size();
    return {};
}

/// Writes the spikes to disk before FILE, which contains their number; FILE gets its name only when it is complete on disk.
Result<void> SkinCheckpoint::flush() {
    if (std::fflush(spikes_.get()) != 0 || ::fsync(::fileno(spikes_.get())) != 0) return system_error(spikes_file_);
    ByteWriter out;
    out.put_raw(checkpoint_header.data(), checkpoint_header.size());
    out.put(fingerprint_, force_sum_.value(), spike_count_, spikes_sum_.value(), skin_.save());
    out.put_checksum();
    return replace_file(file_, out.bytes());
}

/// The lock is held until both files are removed. An output of the same name is not a checkpoint and is not removed.
void SkinCheckpoint::remove_files() {
    std::error_code ignored;
    if (peek_input(file_).starts_with(checkpoint_magic)) fs::remove(file_, ignored);
    if (is_file_at(::fileno(spikes_.get()), spikes_file_)) fs::remove(spikes_file_, ignored);
    spikes_.reset();
}

Result<std::string> checksum_of_file(const std::string& path) {
    auto file = TRY(open_bytes(path));
    Checksum sum;
    std::vector<std::byte> buffer(std::size_t{1} << 20);
    for (auto left = file->size(); left > 0;) {
        const auto chunk = std::span(buffer).first(std::min<std::uint64_t>(buffer.size(), left));
        TRY(file->read(chunk));
        sum.add(chunk.data(), chunk.size());
        left -= chunk.size();
    }
    return fmt::format("{} bytes, checksum {:016x}", file->size(), sum.value());
}

}  // namespace corpuscle
