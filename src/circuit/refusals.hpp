#pragma once
// Collects the errors of a netlist, so that the user learns of all of them at once, the worst first.

#include <set>
#include <vector>

#include "circuit/error_at.hpp"

namespace corpuscle::circuit {

class Refusals {
public:
    /// In order of importance: a device that does not exist here, then a directive, then all other errors.
    enum class Kind { device, directive, other };

    bool empty() const { return refusals_.empty(); }
    /// True if the limit is reached, so that further errors need not be looked for.
    bool is_full() const { return refusals_.size() >= max_refusals; }
    /// Adds an error, unless one with the same text is there already.
    void add(Error, Kind = Kind::other);
    /// Adds the error of an element whose device does not exist here. For several elements with the same subject, such as their letter, the
    /// message is that of the first, with the names of the others.
    void add_device(Error, const std::string& subject, std::string name);
    /// Takes over all errors of another list, except those that are there already.
    void add_all_of(const Refusals&);
    /// Takes over the errors of elements, except for unknown names: a statement that is refused may have defined them.
    void add_elements_of(const Refusals&);
    /// The worst error, which holds the others in its `further`, in order of importance.
    Error combined() const;

private:
    struct Refusal {
        Kind kind;
        Error error;
        std::string subject;              // "" except for a device
        std::vector<std::string> others;  // names of further elements with this subject
        std::size_t other_count;          // their number; not all names are kept
    };
    std::vector<Refusal> refusals_;
    std::set<std::string> texts_;  // of the errors

    static constexpr std::size_t max_refusals = 1000, max_names = 5, max_reported = 20;

    static std::string message_of(const Refusal&);
};

}  // namespace corpuscle::circuit
