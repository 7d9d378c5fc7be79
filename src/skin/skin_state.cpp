// Saves and restores the state of a skin as bytes.

#include <fmt/format.h>
#include <array>
#include <cstring>

#include "core/checksum.hpp"
#include "skin/skin_impl.hpp"

namespace corpuscle {
namespace {

/// The first bytes of a saved state: "corpsk", the version and a line break. A state of version 2 ends with a checksum of all bytes before
/// it. A state of version 1 has no checksum; it can still be read.
constexpr std::array<char, 8> skin_magic = {'c', 'o', 'r', 'p', 's', 'k', '2', '\n'},
                              skin_magic_1 = {'c', 'o', 'r', 'p', 's', 'k', '1', '\n'};

/// Computes a hash (FNV-1a) of values.
class Fingerprint {
    std::uint64_t value_ = 0xcbf29ce484222325U;

public:
    template <class T>
        requires std::is_arithmetic_v<T>
    void add(T x) {
        std::array<unsigned char, sizeof(T)> bytes;
        std::memcpy(bytes.data(), &x, sizeof x);
        for (const auto b : bytes) value_ = (value_ ^ b) * 0x100000001b3U;
    }
    void add(std::string_view text) {
        for (const char c : text) add(c);
    }
    std::uint64_t value() const { return value_; }
};

/// A hash of the skin that a state belongs to: its afferents, their receptive fields and the simulation options.
std::uint64_t fingerprint(const Skin::Impl& impl) {
    Fingerprint all;
    const auto& skin = *impl.skin;
    all.add(impl.run.dt), all.add(static_cast<int>(impl.run.method)), all.add(impl.run.spikes_on_samples);
    all.add(impl.part.index), all.add(impl.part.count), all.add(skin.plan.seed), all.add(skin.plan.sites.size());
    for (const auto& c : skin.plan.classes) {
        all.add(c.afferent.composition());
        for (const double v : c.afferent.values) all.add(v);
        for (const auto& s : c.distributions) all.add(s.parameter), all.add(s.deviation);
    }
    for (const auto& u : skin.afferents) all.add(u.class_index), all.add(u.delay);
    for (const auto& f : skin.fields) {
        for (const auto b : f.begin) all.add(b);
        for (const auto w : f.weight) all.add(w);
    }
    return all.value();
}

/// Appends values to a list of bytes.
class BytesOut {
    std::vector<std::byte>& out_;

public:
    explicit BytesOut(std::vector<std::byte>& out) : out_(out) {}
    template <class T>
    void put(const T* data, std::size_t count) {
        const auto* bytes = reinterpret_cast<const std::byte*>(data);
        out_.insert(out_.end(), bytes, bytes + count * sizeof(T));
    }
    template <class T>
    void put(const T& x) {
        put(&x, 1);
    }
};

/// Takes values from the beginning of a list of bytes. Each function returns false if too few bytes are left.
class BytesIn {
    std::span<const std::byte> in_;

public:
    explicit BytesIn(std::span<const std::byte> in) : in_(in) {}
    template <class T>
    bool take(T* data, std::size_t count) {
        if (in_.size() / sizeof(T) < count) return false;
        if (count > 0) std::memcpy(data, in_.data(), count * sizeof(T));
        in_ = in_.subspan(count * sizeof(T));
        return true;
    }
    template <class T>
    bool take(T& x) {
        return take(&x, 1);
    }
    /// Takes a list that is preceded by its length.
    template <class T>
    bool take_list(std::vector<T>& list) {
        std::uint64_t count = 0;
        if (!take(count) || count > in_.size() / sizeof(T)) return false;
        list.resize(count);
        return take(list.data(), count);
    }
    bool ended() const { return in_.empty(); }
};

/// A spike in transit, as it is saved: without padding between its members.
struct PackedSpike {
    std::int64_t step;
    double offset;
    std::uint64_t afferent;
};

/// The bytes between the magic number of a saved state and its checksum. An error if the magic number or the checksum is wrong.
Result<std::span<const std::byte>> checked_body(std::span<const std::byte> saved) {
    // True if the state begins with the first `length` characters of `magic`.
    const auto begins = [&](const std::array<char, 8>& magic, std::size_t length) {
        return saved.size() >= magic.size() && std::memcmp(saved.data(), magic.data(), length) == 0;
    };
    if (!begins(skin_magic, 6)) return bad_input("not a saved state of a skin: it does not begin with 'corpsk'");
    const auto body = saved.subspan(skin_magic.size());
    if (begins(skin_magic_1, skin_magic_1.size())) return body;
    if (!begins(skin_magic, skin_magic.size()))
        return bad_input(
            "a saved state of a skin has a later version than 2, the latest that this program can read; start from the beginning, "
            "or use the program that saved it");
    std::uint64_t sum = 0;
    if (body.size() < sizeof sum) return bad_input("a saved state of a skin is truncated; start from the beginning");
    std::memcpy(&sum, saved.data() + saved.size() - sizeof sum, sizeof sum);
    if (sum != checksum_of(saved.first(saved.size() - sizeof sum)))
        return bad_input("a saved state of a skin is damaged: its checksum is wrong; start from the beginning");
    return body.first(body.size() - sizeof sum);
}

}  // namespace

std::vector<std::byte> Skin::save() const {
    std::vector<std::byte> out;
    BytesOut to(out);
    const auto& h = *impl_;
    to.put(skin_magic.data(), skin_magic.size());
    to.put(fingerprint(h)), to.put(h.step);
    for (const auto w : {h.stats.afferent_steps, h.stats.skipped_steps, h.stats.spikes, h.stats.truncated_steps}) to.put(w);
    for (const auto& c : h.classes) {
        const auto state = c.population->save();
        to.put(std::uint64_t{state.size()}), to.put(state.data(), state.size());
    }
    const auto in_transit = h.conduction.in_transit();
    to.put(std::uint64_t{in_transit.size()});
    for (const auto& s : in_transit) to.put(PackedSpike{s.step, s.offset, s.afferent_index});
    to.put(checksum_of(out));
    return out;
}

Result<void> Skin::resume(std::span<const std::byte> saved) {
    auto& h = *impl_;
    auto body = TRY(checked_body(saved));
    BytesIn from(body);
    std::uint64_t saved_fingerprint = 0;
    std::int64_t step = 0;
    SkinStats stats;
    const auto damaged = bad_input("a saved state of a skin is damaged or truncated; start from the beginning");
    if (!from.take(saved_fingerprint) || !from.take(step)) return damaged;
    if (saved_fingerprint != fingerprint(h))
        return bad_input(
            fmt::format("a saved state belongs to another skin than {}: population, parameters, seed, rate and method must be those "
                        "it was saved with",
                        h.skin->plan.name));
    if (!from.take(stats.afferent_steps) || !from.take(stats.skipped_steps) || !from.take(stats.spikes) ||
        !from.take(stats.truncated_steps) || step < 0)
        return damaged;
    stats.steps = step;
    std::vector<std::vector<double>> states(h.classes.size());
    for (auto& s : states)
        if (!from.take_list(s)) return damaged;
    std::vector<PackedSpike> packed;
    if (!from.take_list(packed) || !from.ended()) return damaged;
    std::vector<Spike> in_transit;
    for (const auto& s : packed) {
        in_transit.push_back({s.step, s.offset, static_cast<std::uint32_t>(s.afferent)});
        if (s.afferent >= h.skin->afferents.size() || !h.conduction.can_be_in_transit(in_transit.back(), step - 1)) return damaged;
    }
    for (std::size_t c = 0; c < states.size(); ++c)
        if (auto ok = h.classes[c].population->resume(states[c]); !ok || h.classes[c].population->step() != step) return damaged;
    h.conduction.restore(in_transit, step - 1);
    h.step = step, h.stats = stats;
    return {};
}

}  // namespace corpuscle
