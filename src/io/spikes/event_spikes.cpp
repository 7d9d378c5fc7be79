// Reads spike trains from the binary event formats: address events (address_events.hpp) and AEDAT 2.

#include <fmt/format.h>
#include <algorithm>
#include <unordered_map>

#include "core/bytes.hpp"
#include "io/spikes/address_events.hpp"
#include "io/spikes/train_collector.hpp"
#include "io/table/archive.hpp"

namespace corpuscle {
namespace {

namespace aer = address_events;

constexpr std::int64_t last_event_step = std::int64_t{1} << 53;  // a double holds integers up to here exactly
constexpr std::size_t events_at_once = 4096;                     // events in one block that is read

/// The spike trains of all addresses.
class AddressTrains {
    std::unordered_map<std::uint32_t, std::vector<double>*> by_address_;
    TrainCollector trains_;

public:
    /// The train of an address. `names_of` returns the names of its afferent and channel; it is called only at the first event.
    template <class NamesOf>
    std::vector<double>& train_at(std::uint32_t address, const NamesOf& names_of) {
        auto& train = by_address_[address];
        if (!train) {
            const auto [afferent, channel] = names_of(address);
            train = &trains_.train(afferent, channel);
        }
        return *train;
    }
    std::vector<NamedTrain> sorted() && { return std::move(trains_).sorted(); }
};

/// Calls `handle_event` with each event of a file. Every event has `size` bytes; the first one is at position `at`, where the file must be.
template <class Handler>
Result<void> each_event(SeekableBytes& file, std::uint64_t at, std::size_t size, const Handler& handle_event) {
    if ((file.size() - at) % size != 0)
        return bad_input(fmt::format("the last spike is incomplete: {} of {} bytes", (file.size() - at) % size, size), {file.name()});
    std::vector<std::byte> block(events_at_once * size);
    for (auto left = (file.size() - at) / size; left > 0;) {
        const auto count = std::min<std::uint64_t>(left, events_at_once);
        TRY(file.read(std::span(block).first(count * size)));
        for (std::size_t k = 0; k < count; ++k) TRY(handle_event(block.data() + k * size));
        left -= count;
    }
    return {};
}

/// A file of address events.
class AerFile {
    std::unique_ptr<SeekableBytes> file_;
    Clock clock_;
    std::vector<aer::NameRun> runs_, channels_;  // of afferents, and of channels
    std::uint64_t begin_ = 0;                    // position of the first spike

    Error format_error(std::string message) const { return bad_input(std::move(message), {file_->name()}); }

    Result<void> read_header() {
        std::byte header[aer::header_bytes];
        if (file_->size() < sizeof header) return format_error("the header of the address events is incomplete");
        TRY(file_->read(header));
        char magic[8];  // was checked before
        std::uint32_t runs = 0, bytes = 0;
        clock_ = {};
        ByteReader(header).get(magic, clock_.rate_numerator, clock_.rate_denominator, runs, bytes);
        if (clock_.rate_numerator < 1 || clock_.rate_denominator < 1)
            return format_error(fmt::format("invalid clock of {} samples in {} s: both numbers must be positive", clock_.rate_numerator,
                                            clock_.rate_denominator));
        if (file_->size() - sizeof header < bytes) return format_error("the names of the afferents are incomplete");
        begin_ = sizeof header + bytes;
        std::vector<std::byte> names(bytes);  // the runs, as in the file
        TRY(file_->read(names));
        ByteReader in(names);
        TRY(read_runs(in, runs, "afferents", runs_));
        return in.get(runs) ? read_runs(in, runs, "channels", channels_) : Result<void>();
    }

    /// Reads `count` runs. `kind` is the kind of run for messages: "afferents" or "channels".
    Result<void> read_runs(ByteReader& in, std::uint32_t count, std::string_view kind, std::vector<aer::NameRun>& out) const {
        for (std::uint32_t k = 0; k < count; ++k) {
            aer::NameRun run{};
            std::uint32_t letters = 0;
            if (!in.get(run.first_address, run.stride, run.first_number, run.count, letters) || in.rest().size() < letters)
                return format_error(fmt::format("the names of the {} end within run {} of {}", kind, k + 1, count));
            if (run.stride == 0 || run.count == 0)
                return format_error(fmt::format("run {} of {} has a stride or a count of 0", k + 1, kind));
            run.name.resize(letters);
            in.get_raw(run.name.data(), letters);
            char padding[3];
            in.get_raw(padding, std::min<std::size_t>(in.rest().size(), (4 - letters % 4) % 4));
            out.push_back(std::move(run));
        }
        return {};
    }

    /// The run that contains an address; null if none does.
    static const aer::NameRun* run_at(const std::vector<aer::NameRun>& runs, std::uint32_t address) {
        for (const auto& r : runs)
            if (address >= r.first_address && (address - r.first_address) % r.stride == 0 &&
                (address - r.first_address) / r.stride < r.count)
                return &r;
        return nullptr;
    }

    /// The names of the afferent and the channel of an address: {"sa1", "fz"}. If the file names no channel of this address: {"sa1#17",
    /// ""}. If it names no afferent, the address as text is the name.
    std::pair<std::string, std::string> names_of(std::uint32_t address) const {
        const auto *const run = run_at(runs_, address), *const channel = run_at(channels_, address);
        if (!run) return {std::to_string(address), channel ? channel->name : ""};
        if (channel) return {run->name, channel->name};
        const auto number = std::uint64_t{run->first_number} + (address - run->first_address) / run->stride;
        return {run->first_number == 0 ? run->name : fmt::format("{}#{}", run->name, number), ""};
    }

public:
    explicit AerFile(std::unique_ptr<SeekableBytes> file) : file_(std::move(file)) {}

    Result<std::vector<NamedTrain>> read() {
        TRY(read_header());
        AddressTrains trains;
        std::int64_t count = 0;  // spikes read so far
        const auto ok = each_event(*file_, begin_, aer::spike_bytes, [&](const std::byte* at) -> Result<void> {
            aer::EncodedSpike spike;
            std::memcpy(&spike, at, sizeof spike);
            if (spike.step < 0 || spike.step > last_event_step)
                return format_error(fmt::format("spike {} is at step {}, outside 0 to 2^53", count, spike.step));
            trains.train_at(spike.address, [&](std::uint32_t a) { return names_of(a); })
                .push_back(clock_.time(spike.step, aer::decode_offset(spike.fraction)));
            ++count;
            return {};
        });
        if (!ok) return ok.error();
        return std::move(trains).sorted();
    }
};

/// The big-endian number of four bytes.
std::uint32_t big_endian_at(const std::byte* at) {
    std::uint32_t number = 0;
    for (int k = 0; k < 4; ++k) number = number << 8 | std::to_integer<std::uint32_t>(at[k]);
    return number;
}

/// Moves the file to the first event, after the comment lines (which begin with #). Returns its position.
Result<std::uint64_t> skip_comments(SeekableBytes& file) {
    std::vector<std::byte> head(std::min<std::uint64_t>(file.size(), 65536));
    TRY(file.read(head));
    std::size_t at = 0;
    while (at < head.size() && head[at] == std::byte{'#'}) {
        const auto end = std::find(head.begin() + static_cast<std::ptrdiff_t>(at), head.end(), std::byte{'\n'});
        if (end == head.end()) return bad_input("a comment in the header has no end", {file.name()});
        at = static_cast<std::size_t>(end - head.begin()) + 1;
    }
    TRY(file.seek(at));
    return at;
}

}  // namespace

Result<std::vector<NamedTrain>> read_aer_spikes(const std::string& path) { return AerFile(TRY(open_bytes(path))).read(); }

Result<std::vector<NamedTrain>> read_aedat2_spikes(const std::string& path) {
    auto file = TRY(open_bytes(path));
    const auto begin = TRY(skip_comments(*file));
    AddressTrains trains;
    std::int64_t now = 0;  // time of the previous event, us
    bool first = true;
    const auto ok = each_event(*file, begin, 8, [&](const std::byte* at) -> Result<void> {
        const auto stamp = big_endian_at(at + 4);
        // A time stamp has the lowest 32 bits of the time. Of all times with these bits, the one closest to the previous time is meant.
        now = std::exchange(first, false) ? stamp : now + static_cast<std::int32_t>(stamp - static_cast<std::uint32_t>(now));
        trains.train_at(big_endian_at(at), [](std::uint32_t a) { return std::pair(std::to_string(a), std::string()); })
            .push_back(static_cast<double>(now) * 1e-6);
        return {};
    });
    if (!ok) return ok.error();
    return std::move(trains).sorted();
}

}  // namespace corpuscle
