// Writes events to a file in a separate thread, because a write to a disk may take long, and the stream must not wait for it.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <cerrno>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "io/output/output_file.hpp"
#include "live/output/event_sink.hpp"

namespace corpuscle {
namespace {

using WriteFunction = std::function<Result<void>(std::string_view)>;

class FileEventSink final : public EventSink {
    std::string name_;
    WriteFunction write_;
    std::function<Result<void>()> commit_;               // called once, after all events have been written
    std::atomic<bool> ending_ = false, failed_ = false;  // set by join(), by the writing thread
    std::optional<Error> error_;                         // set by the writing thread before failed_, and only read after it
    // Used only when the ring is full: wake_writer_ wakes the writing thread, and space_ wakes the thread that puts events.
    std::mutex full_;
    std::condition_variable wake_writer_, space_;
    std::atomic<bool> is_space_awaited_ = false;
    std::thread thread_;

    /// Wakes the thread that waits for space, or for the news that writing has failed.
    void notify_space() {
        const std::lock_guard lock(full_);
        is_space_awaited_ = false;
        space_.notify_one();
    }

    void write_loop() {
        for (;;) {
            // Read before the ring, so that all events put before join() are written.
            const bool last = ending_.load(std::memory_order_acquire);
            for (auto chunk = ring_.readable(); !chunk.empty(); chunk = ring_.readable()) {
                if (auto ok = write_(chunk); !ok) {
                    error_ = ok.error();
                    failed_.store(true, std::memory_order_release);
                    return notify_space();
                }
                ring_.consume(chunk.size());
                if (is_space_awaited_) notify_space();
            }
            if (last) return;
            // A new event does not wake this thread, so it looks at the ring every 2 ms.
            std::unique_lock lock(full_);
            wake_writer_.wait_for(lock, std::chrono::milliseconds(2), [this] { return is_space_awaited_.load(); });
        }
    }

    /// The error of the writing thread, if writing has failed.
    Result<void> state() const { return failed_.load(std::memory_order_acquire) ? Result<void>(*error_) : Result<void>(); }

    void join() {
        ending_.store(true, std::memory_order_release);
        if (thread_.joinable()) thread_.join();
    }

public:
    FileEventSink(const EventFormat& format, std::size_t ring, std::string name, WriteFunction write, std::function<Result<void>()> commit)
        : EventSink(format, ring), name_(std::move(name)), write_(std::move(write)), commit_(std::move(commit)) {
        put_header();
        thread_ = std::thread([this] { write_loop(); });
    }
    ~FileEventSink() override { join(); }
    std::string description() const override { return name_; }
    Result<void> flush() override { return state(); }
    bool is_file() const override { return true; }
    Result<bool> wait_for_space(std::size_t bytes, int ms) override {
        std::unique_lock lock(full_);
        const auto is_done = [&] { return ring_.has_space(bytes) || failed_; };
        if (!is_done()) {
            is_space_awaited_ = true;
            wake_writer_.notify_one();
            space_.wait_for(lock, std::chrono::milliseconds(ms), is_done);
        }
        TRY(state());
        return ring_.has_space(bytes);
    }
    Result<void> finish(const FinishPolicy&) override {
        join();
        drop_all();
        TRY(state());
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

Result<std::unique_ptr<EventSink>> make_file_sink(int fd, const std::string& name, const EventFormat& format, std::size_t ring) {
    return std::unique_ptr<EventSink>(std::make_unique<FileEventSink>(
        format, ring, name, [fd, name](std::string_view text) { return write_all(fd, name, text); }, [] { return Result<void>(); }));
}

Result<std::unique_ptr<EventSink>> create_event_file(const std::string& path, const EventFormat& format, std::size_t ring) {
    struct ::stat info = {};
    // An existing path that is not a regular file is a named pipe or a device: it is written directly.
    if (::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode)) {
        Descriptor own(::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
        if (!own) return bad_input(fmt::format("cannot be written: {}", std::strerror(errno)), {path});
        const int fd = own.get();
        return make_pipe_sink(std::move(own), fd, path, format, ring);
    }
    auto opened = TRY(OutputFile::create_growing(path));
    const auto file = std::make_shared<OutputFile>(std::move(opened));
    return std::unique_ptr<EventSink>(std::make_unique<FileEventSink>(
        format, ring, path, [file](std::string_view text) { return file->write(text); },
        [file] {
            const auto done = file->commit();
            return done && file->is_synced() ? sync_directory_of(file->path()) : done;
        }));
}

}  // namespace corpuscle
