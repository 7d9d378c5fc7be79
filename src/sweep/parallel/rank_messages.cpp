#include "sweep/parallel/rank_messages.hpp"

#include <signal.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <limits>
#include <type_traits>

#include "sweep/store/results_layout.hpp"

namespace corpuscle {
namespace {

std::string host_name() {
    std::array<char, 256> host = {};
    ::gethostname(host.data(), host.size() - 1);
    return host.data();
}

/// FNV-1a hash of everything that must be equal in all ranks of a sweep.
std::uint64_t hash_of(const Sweep& sweep) {
    std::uint64_t hash = 0xcbf29ce484222325;
    const auto add = [&](const std::string& text) {
        for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
        hash *= 0x100000001b3;
    };
    for (const auto& entry : sweep.metadata()) add(entry.name), add(entry.text);
    for (const auto& name : ResultsLayout::of(sweep).stored_column_names) add(name);
    add(std::to_string(sweep.item_count()));
    return hash;
}

/// Writes the length, then the numbers.
template <class T>
void put(Message& m, const std::vector<T>& numbers) {
    static_assert(std::is_arithmetic_v<T>);
    m.put(std::uint64_t{numbers.size()});
    m.put(numbers.data(), numbers.size() * sizeof(T));
}

template <class T>
bool get_numbers(Message& m, std::vector<T>& numbers) {
    std::uint64_t size = 0;
    if (!m.get(size) || size > m.bytes().size() / sizeof(T)) return false;
    numbers.resize(size);
    return m.get(numbers.data(), size * sizeof(T));
}

template <class T>
void put_all(Message& m, const std::vector<std::vector<T>>& rows) {
    m.put(std::uint64_t{rows.size()});
    for (const auto& row : rows) put(m, row);
}

template <class T>
bool get_all(Message& m, std::vector<std::vector<T>>& rows) {
    std::uint64_t size = 0;
    if (!m.get(size) || size > m.bytes().size()) return false;
    rows.resize(size);
    for (auto& row : rows)
        if (!get_numbers(m, row)) return false;
    return true;
}

bool get(Message& m, ItemOutcome& o) {
    std::array<std::uint64_t, 5> numbers = {};
    if (!m.get(numbers.data(), sizeof numbers)) return false;
    o.item = static_cast<std::int64_t>(numbers[0]), o.end = static_cast<ItemEnd>(numbers[1]);
    o.steps = static_cast<std::int64_t>(numbers[2]), o.iterations = static_cast<std::int64_t>(numbers[3]), o.ran_alone = numbers[4] != 0;
    return numbers[1] <= static_cast<std::uint64_t>(ItemEnd::diverged) && m.get(o.reason) && get_numbers(m, o.measures) &&
           get_all(m, o.spikes) && get_all(m, o.probes);
}

}  // namespace

RankHandshake RankHandshake::of_this_process(const Sweep* sweep) {
    return {host_name(), static_cast<std::uint64_t>(::getpid()), sweep ? hash_of(*sweep) : 0};
}
bool RankHandshake::is_dead() const {
    const bool is_id =
        process > 0 && process <= std::numeric_limits<pid_t>::max();  // 0 and negative numbers would mean process groups to kill()
    return is_id && ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
}
bool RankHandshake::is_on_this_machine() const { return host == host_name() && !is_dead(); }

Message rank_message(RankMessageType type) {
    Message m;
    m.put(static_cast<std::uint64_t>(type));
    return m;
}

Message rank_message(const RankHandshake& handshake) {
    auto m = rank_message(RankMessageType::handshake);
    m.put(handshake.host), m.put(handshake.process), m.put(handshake.metadata_hash);
    return m;
}

Message rank_message(RankMessageType type, std::uint64_t number) {
    auto m = rank_message(type);
    m.put(number);
    return m;
}

Message rank_message(const std::vector<std::int64_t>& items) {
    auto m = rank_message(RankMessageType::items);
    put(m, items);
    return m;
}

Message rank_message(const std::vector<ItemOutcome>& outcomes) {
    auto m = rank_message(RankMessageType::outcomes);
    m.put(std::uint64_t{outcomes.size()});
    for (const auto& o : outcomes) {
        const std::array<std::uint64_t, 5> numbers = {static_cast<std::uint64_t>(o.item), static_cast<std::uint64_t>(o.end),
                                                      static_cast<std::uint64_t>(o.steps), static_cast<std::uint64_t>(o.iterations),
                                                      o.ran_alone};
        m.put(numbers.data(), sizeof numbers), m.put(o.reason);
        put(m, o.measures), put_all(m, o.spikes), put_all(m, o.probes);
    }
    return m;
}

Message rank_message(const Error& error) {
    auto m = rank_message(RankMessageType::sweep_error);
    m.put(static_cast<std::uint64_t>(error.code)), m.put(error.text());
    return m;
}

std::optional<RankMessageType> decode_rank_message_type(Message& m) {
    std::uint64_t type = 0;
    if (!m.get(type) || type > static_cast<std::uint64_t>(RankMessageType::shutdown)) return {};
    return static_cast<RankMessageType>(type);
}

bool decode_rank_message(Message& m, RankHandshake& handshake) {
    return m.get(handshake.host) && m.get(handshake.process) && m.get(handshake.metadata_hash);
}
bool decode_rank_message(Message& m, std::vector<std::int64_t>& items) { return get_numbers(m, items); }

bool decode_rank_message(Message& m, std::vector<ItemOutcome>& outcomes) {
    std::uint64_t size = 0;
    if (!m.get(size) || size > m.bytes().size()) return false;
    outcomes.resize(size);
    for (auto& o : outcomes)
        if (!get(m, o)) return false;
    return true;
}

bool decode_rank_message(Message& m, Error& error) {
    std::uint64_t code = 0;
    if (!m.get(code) || !m.get(error.message)) return false;
    error.code = static_cast<ErrorCode>(code);
    return true;
}

}  // namespace corpuscle
