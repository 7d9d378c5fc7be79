#include "sweep/parallel/outcome_message.hpp"

#include <type_traits>

#include "io/sandbox/message.hpp"

namespace corpuscle {
namespace {

/// Passes each field of an outcome to `f` until it returns false. Returns whether all returned true.
template <class Outcome, class Function>
bool for_each_field(Outcome& o, const Function& f) {
    return f(o.item) && f(o.end) && f(o.reason) && f(o.measures) && f(o.spikes) && f(o.probes) && f(o.steps) && f(o.iterations) &&
           f(o.ran_alone);
}

/// Writes a number, or the length and the elements of a vector or text.
struct FieldWriter {
    Message& m;

    template <class T>
    bool operator()(const T& x) const {
        if constexpr (std::is_trivially_copyable_v<T>) {
            m.put(&x, sizeof x);
        } else {
            m.put(std::uint64_t{x.size()});
            for (const auto& element : x) (*this)(element);
        }
        return true;
    }
};

/// Reads what FieldWriter wrote. Returns false if the message is incomplete.
struct FieldReader {
    Message& m;

    template <class T>
    bool operator()(T& x) const {
        if constexpr (std::is_trivially_copyable_v<T>) {
            return m.get(&x, sizeof x);
        } else {
            std::uint64_t size = 0;
            if (!m.get(size) || size > m.bytes().size()) return false;
            x.resize(size);
            for (auto& element : x)
                if (!(*this)(element)) return false;
            return true;
        }
    }
};

}  // namespace

std::string pack_outcomes(const std::vector<ItemOutcome>& outcomes) {
    Message m;
    for (const auto& o : outcomes) for_each_field(o, FieldWriter{m});
    return m.bytes();
}

bool unpack_outcomes(std::string message, std::vector<ItemOutcome>& outcomes) {
    for (Message m(std::move(message)); !m.ended();)
        if (!for_each_field(outcomes.emplace_back(), FieldReader{m}) || outcomes.back().end > ItemEnd::diverged)
            return outcomes.pop_back(), false;
    return true;
}

}  // namespace corpuscle
