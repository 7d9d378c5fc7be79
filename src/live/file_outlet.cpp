#include "live/file_outlet.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "io/output.hpp"
#include "live/descriptor.hpp"

namespace corpuscle {
namespace {

using Writing = std::function<Result<void>(std::string_view)>;

class FileOutlet final : public EventOutlet {
    std::string name_;
    Writing write_;
    std::function<Result<void>()> commit_;
    std::atomic<bool> ending_ = false, failed_ = false;
    std::optional<Error> error_;  // the thread's, to be read when failed_
    // Only where the ring is full: the writer is not to sleep on, and the one that puts sleeps until there is room.
    std::mutex full_;
    std::condition_variable hurry_, room_;
    std::atomic<bool> is_awaited_ = false;
    std::thread thread_;

    void tell_of_room() {
        const std::lock_guard lock(full_);
        is_awaited_ = false;
        room_.notify_one();
    }

    void write_on() {
        for (;;) {
            const bool last = ending_.load(std::memory_order_acquire);  // before a look at the ring: what was put before is seen
            for (auto piece = ring_.next(); !piece.empty(); piece = ring_.next()) {
                if (auto ok = write_(piece); !ok) {
                    error_ = ok.error();
                    failed_.store(true, std::memory_order_release);
                    return tell_of_room();
                }
                ring_.took(piece.size());
                if (is_awaited_) tell_of_room();
            }
            if (last) return;
            std::unique_lock lock(full_);
            hurry_.wait_for(lock, std::chrono::milliseconds(2), [this] { return is_awaited_.load(); });
        }
    }

    Result<void> state() const { return failed_.load(std::memory_order_acquire) ? Result<void>(*error_) : Result<void>(); }

    void join() {
        ending_.store(true, std::memory_order_release);
        if (thread_.joinable()) thread_.join();
    }

public:
    FileOutlet(const EventFormat& format, std::size_t ring, std::string name, Writing write, std::function<Result<void>()> commit)
        : EventOutlet(format, ring), name_(std::move(name)), write_(std::move(write)), commit_(std::move(commit)) {
        put_header();
        thread_ = std::thread([this] { write_on(); });
    }
    ~FileOutlet() override { join(); }
    std::string sentence() const override { return name_; }
    Result<void> flush() override { return state(); }
    bool is_file() const override { return true; }
    Result<bool> wait_for_room(std::size_t bytes, int ms) override {
        std::unique_lock lock(full_);
        const auto is_settled = [&] { return ring_.has_room(bytes) || failed_; };
        if (!is_settled()) {
            is_awaited_ = true;
            hurry_.notify_one();
            room_.wait_for(lock, std::chrono::milliseconds(ms), is_settled);
        }
        if (auto ok = state(); !ok) return ok.error();
        return ring_.has_room(bytes);
    }
    Result<void> finish(const EventPatience&) override {
        join();
        lose_all();
        if (auto ok = state(); !ok) return ok;
        return commit_();
    }
};

Result<void> write_all(int fd, const std::string& name, std::string_view text) {
    while (!text.empty()) {
        const auto count = ::write(fd, text.data(), text.size());
        if (count < 0 && errno != EINTR) return bad_input(fmt::format("cannot be written: {}", std::strerror(errno)), {name});
        if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
    }
    return {};
}

}  // namespace

Result<std::unique_ptr<EventOutlet>> plain_file_outlet(int fd, const std::string& name, const EventFormat& format, std::size_t ring) {
    return std::unique_ptr<EventOutlet>(std::make_unique<FileOutlet>(
        format, ring, name, [fd, name](std::string_view text) { return write_all(fd, name, text); }, [] { return Result<void>(); }));
}

Result<std::unique_ptr<EventOutlet>> event_file(const std::string& path, const EventFormat& format, std::size_t ring) {
    struct ::stat facts = {};
    if (::stat(path.c_str(), &facts) == 0 && !S_ISREG(facts.st_mode) && !S_ISDIR(facts.st_mode)) {
        Descriptor own(::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
        if (!own) return bad_input(fmt::format("cannot be written: {}", std::strerror(errno)), {path});
        const int fd = own.get();
        return pipe_outlet(std::move(own), fd, path, format, ring);
    }
    auto opened = OutputFile::growing(path);
    if (!opened) return opened.error();
    const auto file = std::make_shared<OutputFile>(std::move(*opened));
    return std::unique_ptr<EventOutlet>(std::make_unique<FileOutlet>(
        format, ring, path, [file](std::string_view text) { return file->write(text); },
        [file] {
            const auto done = file->commit();
            return done && file->is_synced() ? sync_directory_of(file->path()) : done;
        }));
}

}  // namespace corpuscle
