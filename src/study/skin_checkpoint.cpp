#include "study/skin_checkpoint.hpp"

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

#include "io/bytes.hpp"
#include "io/output.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

// FILE: magic, fingerprint, checksum of the force, number and checksum of the spikes, the skin's state, checksum of all of it.
constexpr std::string_view checkpoint_magic = "corpuscle checkpoint ", checkpoint_version = "2";
constexpr std::string_view spikes_header = "corpuscle told spikes 2\n";
static_assert(spikes_header.size() % sizeof(std::uint64_t) == 0);

/// A spike as FILE.spikes has it.
struct KeptSpike {
    std::int64_t step;
    double offset;
    std::uint64_t unit;
};

template <class T>
void append(std::string& to, const T& x) {
    to.append(reinterpret_cast<const char*>(&x), sizeof x);
}

void append_text(std::string& to, std::string_view text) {
    append(to, std::uint64_t{text.size()});
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

std::string difference(const std::string& name, const std::string* then, const std::string* now) {
    if (name.starts_with("contents of")) return fmt::format("the {} have changed", name);
    if (!then) return fmt::format("{} was not given and now is {}", name, *now);
    return now ? fmt::format("{} was {} and now is {}", name, *then, *now) : fmt::format("{} was {} and now is not given", name, *then);
}

/// What differs between two runs, in words; "": nothing.
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

/// Whether a regular file begins with these letters.
bool begins_with(const std::string& path, std::string_view letters) {
    std::error_code status;
    if (!fs::is_regular_file(path, status)) return false;
    std::ifstream in(path, std::ios::binary);
    std::string head(letters.size(), '\0');
    return in.read(head.data(), static_cast<std::streamsize>(head.size())) && head == letters;
}

bool is_file_of_name(int file, const std::string& path) {
    struct ::stat open_one = {}, there = {};
    return ::fstat(file, &open_one) == 0 && ::stat(path.c_str(), &there) == 0 && open_one.st_ino == there.st_ino &&
           open_one.st_dev == there.st_dev;
}

}  // namespace

Error SkinCheckpoint::broken(const std::string& path) const { return bad_input(std::strerror(errno), {path}); }

std::string SkinCheckpoint::remedy() const {
    return fmt::format("remove {} and {} to start over, or name another file with --checkpoint", file_, spikes_file_);
}

Error SkinCheckpoint::another_force() const {
    return bad_input(fmt::format("the force up to this checkpoint is not the one that it was made with; {}", remedy()), {file_});
}

Result<std::unique_ptr<SkinCheckpoint>> SkinCheckpoint::open(const std::string& file, Skin& skin, RunFingerprint fingerprint) {
    std::unique_ptr<SkinCheckpoint> made(new SkinCheckpoint(file, skin, std::move(fingerprint)));
    if (auto ok = made->check_file(); !ok) return ok.error();
    if (auto ok = made->lock_spikes(); !ok) return ok.error();
    std::error_code status;
    if (fs::exists(file, status))
        if (auto ok = made->resume(); !ok) return ok.error();
    const auto end = spikes_header.size() + made->count_ * sizeof(KeptSpike);
    if (::ftruncate(::fileno(made->spikes_), static_cast<off_t>(end)) != 0) return made->broken(made->spikes_file_);
    return made;
}

/// Spikes without a checkpoint that counts them are of no use.
SkinCheckpoint::~SkinCheckpoint() {
    if (!spikes_) return;
    std::error_code ignored;
    if (!fs::exists(file_, ignored) && is_file_of_name(::fileno(spikes_), spikes_file_) && begins_with(spikes_file_, spikes_header))
        fs::remove(spikes_file_, ignored);
    std::fclose(spikes_);
}

/// FILE is a checkpoint of a version that can be read, or is not there.
Result<void> SkinCheckpoint::check_file() const {
    std::error_code status;
    if (!fs::exists(file_, status)) return {};
    if (!begins_with(file_, checkpoint_magic))
        return bad_input("this file is not a checkpoint and is left as it is; name another with --checkpoint", {file_});
    if (!begins_with(file_, fmt::format("{}{}\n", checkpoint_magic, checkpoint_version))) {
        std::ifstream in(file_, std::ios::binary);
        std::string line;
        std::getline(in, line);
        const auto version = line.substr(checkpoint_magic.size(), 20);
        return bad_input(
            fmt::format("a checkpoint of version {}; this program goes on from version {} only (version 1 does not hold what "
                        "the force was made of). Finish the run with the program that began it, or {}",
                        version.find_first_not_of("0123456789") == std::string::npos ? version : "?", checkpoint_version, remedy()),
            {file_});
    }
    if (!fs::exists(spikes_file_, status))
        return bad_input(fmt::format("its spikes, {}, are missing; remove {} to start over, or name another file with --checkpoint",
                                     spikes_file_, file_),
                         {file_});
    return {};
}

/// Opens FILE.spikes and locks it. Another process may remove it between the opening and the lock: then once more.
Result<void> SkinCheckpoint::lock_spikes() {
    for (int tries = 0; tries < 100; ++tries) {
        int file = ::open(spikes_file_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        const bool is_new = file >= 0;
        if (!is_new && errno != EEXIST) return broken(spikes_file_);
        if (!is_new) file = ::open(spikes_file_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
        if (file < 0 && errno == ENOENT) continue;
        if (file < 0) return broken(spikes_file_);
        if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
            const int why = errno;
            ::close(file);
            errno = why;
            if (why != EWOULDBLOCK) return broken(spikes_file_);
            return bad_input("another run is using this checkpoint; wait for it to end, or name another file with --checkpoint", {file_});
        }
        if (!is_file_of_name(file, spikes_file_)) {
            ::close(file);
            continue;
        }
        if (is_new && ::write(file, spikes_header.data(), spikes_header.size()) != static_cast<ssize_t>(spikes_header.size())) {
            const auto error = broken(spikes_file_);
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
    return bad_input(fmt::format("this file was not written with a checkpoint of this version and is left as it is; move it away, or name "
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
    if (const auto what = differences(then, fingerprint_); !what.empty())
        return bad_input(fmt::format("this checkpoint is of another run: {}. Repeat the run as it was begun, {}", what, remedy()), {file_});
    std::string state;
    if (!take_front(left, force_to_resumed_) || !take_front(left, count_) || !take_front(left, spikes_sum) || !take_text(left, state) ||
        !left.empty())
        return damaged;
    if (auto ok = skin_.resume(std::as_bytes(std::span(state))); !ok)
        return bad_input(fmt::format("{}; {}", ok.error().sentence, remedy()), {file_});
    resumed_ = skin_.step();
    return check_spikes(spikes_sum);
}

/// The spikes are as many as FILE has it, in order, of units of this skin, and what was written.
Result<void> SkinCheckpoint::check_spikes(std::uint64_t checksum) {
    std::error_code status;
    const auto size = fs::file_size(spikes_file_, status), have = (size - std::min(size, spikes_header.size())) / sizeof(KeptSpike);
    if (status || count_ > have)
        return bad_input(fmt::format("it has {} spikes, and {} was written after {}; {}", have, file_, count_, remedy()), {spikes_file_});
    std::fseek(spikes_, static_cast<long>(spikes_header.size()), SEEK_SET);
    std::array<KeptSpike, 1024> some;
    Spike last;
    bool sound = true;
    for (std::uint64_t at = 0; at < count_ && sound;) {
        const auto count = std::fread(some.data(), sizeof some[0], std::min<std::uint64_t>(some.size(), count_ - at), spikes_);
        if (count == 0) return broken(spikes_file_);
        spikes_sum_.add(some.data(), count * sizeof some[0]);
        for (std::size_t k = 0; k < count; ++k) {
            const auto& s = some[k];
            const Spike spike{s.step, s.offset, static_cast<std::uint32_t>(s.unit)};
            sound &= s.unit < skin_.innervation().units.size() && s.step >= 0 && s.step < resumed_ && s.offset > 0 && s.offset <= 1 &&
                     ((at == 0 && k == 0) || last <= spike);
            last = spike;
        }
        at += count;
    }
    if (sound && spikes_sum_.value() == checksum) return {};
    return bad_input(fmt::format("these spikes are damaged: they are not what {} was written after; {}", file_, remedy()), {spikes_file_});
}

Result<void> SkinCheckpoint::force(const SkinForce::Block& block, std::int64_t first) {
    const auto steps = block.total.size();
    force_sum_.add(block.total.data(), block.total.size_bytes());
    const auto add = [&](std::size_t site) { force_sum_.add(block.force.of + site * block.force.stride, steps * sizeof(double)); };
    for (std::size_t s = 0; block.force.all && s < skin_.sites(); ++s) add(s);
    for (const auto s : block.force.touched)
        if (!block.force.all) add(s);
    const auto end = first + static_cast<std::int64_t>(steps);
    if (resumed_ <= first || resumed_ > end) return {};
    return resumed_ == end && force_sum_.value() == force_to_resumed_ ? Result<void>() : another_force();
}

Result<void> SkinCheckpoint::ended(std::int64_t samples) { return samples < resumed_ ? Result<void>(another_force()) : Result<void>(); }

Result<void> SkinCheckpoint::told(std::int64_t end, std::vector<Spike>& spikes) {
    // Spikes of a block are those that arrive up to its last sample.
    if (told_ == 0 && ahead_.empty()) std::fseek(spikes_, static_cast<long>(spikes_header.size()), SEEK_SET);
    for (KeptSpike kept{};;) {
        if (ahead_.empty()) {
            if (told_ >= count_) return {};
            if (std::fread(&kept, sizeof kept, 1, spikes_) != 1) return broken(spikes_file_);
            ++told_;
            ahead_.push_back({kept.step, kept.offset, static_cast<std::uint32_t>(kept.unit)});
        }
        if (ahead_[0].step >= end) return {};
        spikes.push_back(ahead_[0]);
        ahead_.clear();
    }
}

Result<void> SkinCheckpoint::answered(std::span<const Spike> spikes) {
    std::string bytes;
    for (const auto& s : spikes) append(bytes, KeptSpike{s.step, s.offset, s.unit});
    std::fseek(spikes_, static_cast<long>(spikes_header.size() + count_ * sizeof(KeptSpike)), SEEK_SET);
    if (std::fwrite(bytes.data(), 1, bytes.size(), spikes_) != bytes.size()) return broken(spikes_file_);
    spikes_sum_.add(bytes.data(), bytes.size());
    count_ += spikes.size();
    return {};
}

/// The spikes are on disk before FILE says that they are, and FILE before it has its name.
Result<void> SkinCheckpoint::keep() {
    if (std::fflush(spikes_) != 0 || ::fsync(::fileno(spikes_)) != 0) return broken(spikes_file_);
    std::string bytes = fmt::format("{}{}\n", checkpoint_magic, checkpoint_version);
    append(bytes, std::uint64_t{fingerprint_.size()});
    for (const auto& [name, value] : fingerprint_) append_text(bytes, name), append_text(bytes, value);
    append(bytes, force_sum_.value()), append(bytes, count_), append(bytes, spikes_sum_.value());
    const auto state = skin_.save();
    append_text(bytes, {reinterpret_cast<const char*>(state.data()), state.size()});
    append(bytes, checksum_of(std::as_bytes(std::span(bytes))));
    auto out = OutputFile::create(file_);
    if (!out) return out.error();
    if (auto ok = out->write(bytes); !ok) return ok;
    if (auto ok = out->commit(Sync::always); !ok) return ok;
    return sync_directory_of(file_);
}

/// The lock is held until both are gone; an output of the same name is no checkpoint and stays.
void SkinCheckpoint::done() {
    std::error_code ignored;
    if (begins_with(file_, checkpoint_magic)) fs::remove(file_, ignored);
    if (is_file_of_name(::fileno(spikes_), spikes_file_)) fs::remove(spikes_file_, ignored);
    std::fclose(std::exchange(spikes_, nullptr));
}

Result<std::string> contents_of(const std::string& path) {
    auto file = open_bytes(path);
    if (!file) return file.error();
    Checksum sum;
    std::vector<std::byte> some(std::size_t{1} << 20);
    for (auto left = (*file)->size(); left > 0;) {
        const auto piece = std::span(some).first(std::min<std::uint64_t>(some.size(), left));
        if (auto ok = (*file)->read(piece); !ok) return ok.error();
        sum.add(piece.data(), piece.size());
        left -= piece.size();
    }
    return fmt::format("{} bytes, checksum {:016x}", (*file)->size(), sum.value());
}

}  // namespace corpuscle
