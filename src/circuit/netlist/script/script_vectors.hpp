#pragma once
// The vectors that a script of ngspice computes, as expressions of curves. Used inside circuit/netlist only.

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace corpuscle::circuit {

/// The vectors of a script. Each is kept as an expression of curves, in which the vectors that it uses are already replaced.
class ScriptVectors {
    enum class Kind { expression, number_of_measures, unknown };
    struct Vector {
        Kind kind;
        std::string text;
        bool has_whole_curves = false;
    };
    std::map<std::string, Vector, std::less<>> vectors_;
    std::size_t expanded_characters_ = 0;

public:
    /// An expression with its vectors replaced, or the reason why it cannot be computed here.
    struct Expanded {
        std::string text, problem;
        bool depends_on_curves = false, depends_on_measures = false;
        /// It has curves such as v(a), which are complex in an .ac, and not only parts such as vm(a). Of a meas line: one of its vectors
        /// has.
        bool has_whole_curves = false;
    };

    /// Replaces the names of vectors in an expression. Other names are those of nodes: `out` is v(out). Functions of complex vectors become
    /// parts of them: mag(v(a)) is vm(a).
    Expanded expand(std::string_view expression);
    /// Replaces the names of vectors in the words of a meas line after its name.
    Expanded expand_measure(std::string_view words);
    /// Defines a vector.
    void define(std::string name, const Expanded&);
    void define_unknown(std::string name) { vectors_.insert_or_assign(std::move(name), Vector{Kind::unknown, ""}); }
    /// Removes a vector; its name is that of a node again.
    void remove(std::string_view name) {
        if (const auto at = vectors_.find(name); at != vectors_.end()) vectors_.erase(at);
    }
    /// The total length of all expressions so far, with their vectors replaced.
    std::size_t expanded_characters() const { return expanded_characters_; }
    /// Defines the result of a meas.
    void define_measure(std::string name) { vectors_.insert_or_assign(std::move(name), Vector{Kind::number_of_measures, ""}); }
    bool is_measure(std::string_view name) const;
    bool contains(std::string_view name) const { return vectors_.contains(name); }
    /// Call this when another plot becomes the current one: the vectors of the one before are not available there.
    void leave_plot();
    /// The text of a vector that is a number; nothing if it is none.
    std::optional<std::string> number(std::string_view name) const;
};

}  // namespace corpuscle::circuit
