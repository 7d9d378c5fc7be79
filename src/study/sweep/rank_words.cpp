#include "study/sweep/rank_words.hpp"

#include <signal.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <limits>
#include <type_traits>

#include "study/sweep/results_layout.hpp"

namespace corpuscle {
namespace {

std::string host_name() {
    std::array<char, 256> host = {};
    ::gethostname(host.data(), host.size() - 1);
    return host.data();
}

/// FNV-1a hash of everything that two equal sweeps have in common.
std::uint64_t hash_of(const Sweep& sweep) {
    std::uint64_t hash = 0xcbf29ce484222325;
    const auto add = [&](const std::string& text) {
        for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
        hash *= 0x100000001b3;
    };
    for (const auto& fact : sweep.facts()) add(fact.name), add(fact.text);
    for (const auto& name : ResultsLayout::of(sweep).stored) add(name);
    add(std::to_string(sweep.units()));
    return hash;
}

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

bool get(Message& m, UnitOutcome& o) {
    std::array<std::uint64_t, 5> numbers = {};
    if (!m.get(numbers.data(), sizeof numbers)) return false;
    o.unit = static_cast<std::int64_t>(numbers[0]), o.end = static_cast<UnitEnd>(numbers[1]);
    o.steps = static_cast<std::int64_t>(numbers[2]), o.iterations = static_cast<std::int64_t>(numbers[3]), o.alone = numbers[4] != 0;
    return numbers[1] <= static_cast<std::uint64_t>(UnitEnd::lost) && m.get(o.why) && get_numbers(m, o.measures) && get_all(m, o.spikes) &&
           get_all(m, o.traces);
}

}  // namespace

RankHello RankHello::mine(const Sweep* sweep) { return {host_name(), static_cast<std::uint64_t>(::getpid()), sweep ? hash_of(*sweep) : 0}; }
bool RankHello::is_dead() const {
    const bool is_id = process > 0 && process <= std::numeric_limits<pid_t>::max();  // of one process, not of a process group
    return is_id && ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
}
bool RankHello::can_be_seen() const { return host == host_name() && !is_dead(); }

Message message(RankWord word) {
    Message m;
    m.put(static_cast<std::uint64_t>(word));
    return m;
}

Message message(const RankHello& hello) {
    auto m = message(RankWord::hello);
    m.put(hello.host), m.put(hello.process), m.put(hello.facts);
    return m;
}

Message message(RankWord word, std::uint64_t number) {
    auto m = message(word);
    m.put(number);
    return m;
}

Message message(const std::vector<std::int64_t>& units) {
    auto m = message(RankWord::units);
    put(m, units);
    return m;
}

Message message(const std::vector<UnitOutcome>& outcomes) {
    auto m = message(RankWord::outcomes);
    m.put(std::uint64_t{outcomes.size()});
    for (const auto& o : outcomes) {
        const std::array<std::uint64_t, 5> numbers = {static_cast<std::uint64_t>(o.unit), static_cast<std::uint64_t>(o.end),
                                                      static_cast<std::uint64_t>(o.steps), static_cast<std::uint64_t>(o.iterations),
                                                      o.alone};
        m.put(numbers.data(), sizeof numbers), m.put(o.why);
        put(m, o.measures), put_all(m, o.spikes), put_all(m, o.traces);
    }
    return m;
}

Message message(const Error& error) {
    auto m = message(RankWord::fault);
    m.put(static_cast<std::uint64_t>(error.code)), m.put(error.text());
    return m;
}

std::optional<RankWord> word_of(Message& m) {
    std::uint64_t word = 0;
    if (!m.get(word) || word > static_cast<std::uint64_t>(RankWord::over)) return {};
    return static_cast<RankWord>(word);
}

bool get(Message& m, RankHello& hello) { return m.get(hello.host) && m.get(hello.process) && m.get(hello.facts); }
bool get(Message& m, std::vector<std::int64_t>& units) { return get_numbers(m, units); }

bool get(Message& m, std::vector<UnitOutcome>& outcomes) {
    std::uint64_t size = 0;
    if (!m.get(size) || size > m.bytes().size()) return false;
    outcomes.resize(size);
    for (auto& o : outcomes)
        if (!get(m, o)) return false;
    return true;
}

bool get(Message& m, Error& error) {
    std::uint64_t code = 0;
    if (!m.get(code) || !m.get(error.message)) return false;
    error.code = static_cast<ErrorCode>(code);
    return true;
}

}  // namespace corpuscle
