#include "study/skin_checkpoint.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "io/output.hpp"

namespace corpuscle {
namespace {

constexpr std::string_view checkpoint_magic = "corpuscle checkpoint 1\n";

/// A spike as the file has it.
struct KeptSpike {
    std::int64_t step;
    double offset;
    std::uint64_t unit;
};

template <class T>
void append(std::string& to, const T& x) {
    to.append(reinterpret_cast<const char*>(&x), sizeof x);
}

template <class T>
bool take_front(std::string_view& from, T& x) {
    if (from.size() < sizeof x) return false;
    std::memcpy(&x, from.data(), sizeof x);
    from.remove_prefix(sizeof x);
    return true;
}

}  // namespace

Error SkinCheckpoint::broken(const std::string& path) const { return bad_input(fmt::format("{}: {}", path, std::strerror(errno))); }

Result<std::unique_ptr<SkinCheckpoint>> SkinCheckpoint::open(const std::string& file, Skin& skin, const std::string& likeness) {
    std::unique_ptr<SkinCheckpoint> made(new SkinCheckpoint(file, skin, likeness));
    std::error_code status;
    if (std::filesystem::exists(file, status))
        if (auto ok = made->resume(); !ok) return ok.error();
    const std::string path = file + ".spikes";
    made->spikes_ = std::fopen(path.c_str(), made->resumed_ > 0 ? "r+b" : "w+b");
    if (!made->spikes_) return made->broken(path);
    const auto bytes = made->count_ * sizeof(KeptSpike);
    std::fseek(made->spikes_, 0, SEEK_END);
    if (static_cast<std::uint64_t>(std::ftell(made->spikes_)) < bytes)
        return bad_input(fmt::format("{}: it has fewer spikes than {} says ({}); remove both to begin anew", path, file, made->count_));
    if (::ftruncate(::fileno(made->spikes_), static_cast<off_t>(bytes)) != 0) return made->broken(path);
    std::rewind(made->spikes_);
    return made;
}

SkinCheckpoint::~SkinCheckpoint() {
    if (spikes_) std::fclose(spikes_);
}

Result<void> SkinCheckpoint::resume() {
    std::ifstream in(file_, std::ios::binary);
    const std::string all((std::istreambuf_iterator<char>(in)), {});
    std::string_view left = all;
    std::uint64_t words = 0;
    if (!left.starts_with(checkpoint_magic)) return bad_input(fmt::format("{}: this is no checkpoint; name another file", file_));
    left.remove_prefix(checkpoint_magic.size());
    if (!take_front(left, words) || words > left.size()) return bad_input(fmt::format("{}: the checkpoint is cut short", file_));
    if (left.substr(0, words) != likeness_)
        return bad_input(fmt::format("{}: this run is another ({}); the checkpoint is of: {}", file_, likeness_, left.substr(0, words)));
    left.remove_prefix(words);
    if (!take_front(left, count_)) return bad_input(fmt::format("{}: the checkpoint is cut short", file_));
    if (auto ok = skin_.resume(std::as_bytes(std::span(left))); !ok) return bad_input(fmt::format("{}: {}", file_, ok.error().sentence));
    resumed_ = skin_.step();
    return {};
}

Result<void> SkinCheckpoint::told(std::int64_t end, std::vector<Spike>& spikes) {
    // Spikes of a block are those that arrive up to its last sample.
    for (KeptSpike kept{};;) {
        if (ahead_.empty()) {
            if (static_cast<std::uint64_t>(std::ftell(spikes_)) >= count_ * sizeof kept) return {};
            if (std::fread(&kept, sizeof kept, 1, spikes_) != 1) return broken(file_ + ".spikes");
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
    std::fseek(spikes_, static_cast<long>(count_ * sizeof(KeptSpike)), SEEK_SET);
    if (std::fwrite(bytes.data(), 1, bytes.size(), spikes_) != bytes.size()) return broken(file_ + ".spikes");
    count_ += spikes.size();
    return {};
}

Result<void> SkinCheckpoint::keep() {
    if (std::fflush(spikes_) != 0) return broken(file_ + ".spikes");
    std::string bytes(checkpoint_magic);
    append(bytes, std::uint64_t{likeness_.size()});
    bytes += likeness_;
    append(bytes, count_);
    const auto state = skin_.save();
    bytes.append(reinterpret_cast<const char*>(state.data()), state.size());
    auto out = OutputFile::create(file_);
    if (!out) return out.error();
    if (auto ok = out->write(bytes); !ok) return ok;
    return out->commit(Sync::always);
}

void SkinCheckpoint::done() {
    std::fclose(std::exchange(spikes_, nullptr));
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
    std::filesystem::remove(file_ + ".spikes", ignored);
}

}  // namespace corpuscle
