#pragma once
// One element line of a netlist, as the read functions of devices see it.

#include "circuit/netlist/netlist.hpp"
#include "circuit/netlist/statement.hpp"

namespace corpuscle::circuit {

class CircuitBuilder;
struct Scope;
struct WordRef;
struct DeviceKind;

/// Reads a line into `element`. Word 0 is the name of the element; the words after it are its nodes, models and values. Errors have the
/// location of the word.
class ElementReader {
    CircuitBuilder& builder_;
    Scope& scope_;
    const Statement& s_;
    const DeviceKind& kind_;
    std::string_view name_;                     // as in the line, without path
    std::vector<std::string_view> read_names_;  // names of the pairs that are read already

public:
    Element element;

    ElementReader(CircuitBuilder&, Scope&, const Statement&);
    /// Reads the complete line and adds the element to the circuit.
    Result<void> read();

    std::size_t word_count() const { return s_.words.size(); }
    std::string_view text(std::size_t word) const { return s_.text(word); }  ///< "" after the last word
    bool is_plain(std::size_t word) const { return s_.words[word].kind == Word::Kind::plain; }
    bool is_model(std::size_t word) const;      ///< true if the word names a model of the netlist
    bool is_parameter(std::size_t word) const;  ///< true if the word names a .param of the netlist
    const NameValue* find(std::string_view name) const { return s_.find(name); }

    /// Reads the first n words after the name as nodes. `expected` describes all words, for the error message.
    Result<void> nodes(std::size_t n, std::string_view expected);
    /// Reads the n words from number `first` on as further nodes.
    Result<void> nodes_from(std::size_t first, std::size_t n, std::string_view expected);
    /// Reads the word as the name of a model, which must have one of these types.
    Result<void> model(std::size_t word, std::initializer_list<std::string_view> types);
    /// Removes the parameters of the model that are not in `known`, with a warning, as ngspice does. One that resembles a known name is a
    /// typing error, and stays until the device refuses it, unless it is in `ignored`. Those of `ignored` that are 0 give no warning.
    void drop_unknown_model_values(std::span<const std::string_view> known, std::span<const std::string_view> ignored = {});
    Result<double> number(std::size_t word) const;
    Result<double> number(const NameValue&);
    Result<double> number(const Word&) const;
    /// Reads a word, or the value of a pair, as the element's value.
    template <class Where>
    Result<void> value(const Where& word) {
        element.value = TRY(number(word));
        return {};
    }
    std::string_view text(const NameValue& pair) const { return s_.text(pair.value); }
    /// True if the word is one of the at most `count` numbers after the first one of ic=.
    bool continues_initial_voltages(std::size_t word, std::size_t count) const;
    void take(const NameValue& pair) { read_names_.push_back(s_.text(pair.name)); }  ///< marks the pair as read
    void warn(std::size_t word, std::string_view message);
    void warn_about_model(std::string_view message);  ///< one warning for the element's model, however many elements have it
    /// Reads the value of a pair as the expression of the element.
    Result<void> expression(const NameValue&);
    /// Takes a text that the line gives in another form, at this word, as the expression of the element.
    Result<void> expression(std::string text, const Word& from);
    const Word& word(std::size_t k) const { return s_.words[k]; }
    std::string_view text(const Word& w) const { return s_.text(w); }
    /// The pair whose name is an expression: {v(a)}=(0,0). Null if there is none.
    const NameValue* pair_of_expression() const {
        const auto at = std::ranges::find(s_.pairs, Word::Kind::expression, [](const NameValue& pair) { return pair.name.kind; });
        return at == s_.pairs.end() ? nullptr : &*at;
    }
    /// The words of a value such as "(0,1)".
    std::vector<Word> words_of(const Word& value) const;
    /// The value of this name in the element's model; nullopt if it has none.
    std::optional<double> model_value(std::string_view name) const;
    std::string_view model_type() const;  ///< the type of the element's model, which it must have
    /// Reads the word as the name of the voltage source whose current controls the element.
    void control_source(std::size_t word);
    /// Reads the word as the name of an inductor that the element couples.
    void inductor(std::size_t word);

    /// An error at a word, given by its number or as a Word.
    template <class... Arguments>
    Error error_at(std::size_t word, fmt::format_string<Arguments...> message, Arguments&&... arguments) const {
        return error_in(s_.location(word), fmt::format(message, std::forward<Arguments>(arguments)...));
    }
    template <class... Arguments>
    Error error_at(const Word& word, fmt::format_string<Arguments...> message, Arguments&&... arguments) const {
        return error_in(s_.location(word), fmt::format(message, std::forward<Arguments>(arguments)...));
    }
    Error too_many(std::size_t word) const;  ///< the error for a word after the last one that the element can have
    /// The number that a decimal comma before this word splits into two, "0,5", with a point; "" if there is none.
    std::string number_with_decimal_comma(std::size_t word) const;
    /// True if a comma, and nothing else, is between this word and the text before it.
    bool is_after_comma(std::size_t word) const;

private:
    Error error_in(SourceLocation location, std::string_view message) const {
        return circuit::error_at(std::move(location), "{}: {}", name_, message);
    }
    /// Adds a refusal and returns true if no device has the level of the line's model.
    bool refuse_level();
    void add_forward_reference(const ExpressionInput&, const SourceLocation&);
    Result<void> parse_expression(const WordRef&);
    Result<void> named_parameters();
    void apply_size_options();
    void override_values();
    Result<void> apply_step();
    Result<void> apply_tolerances();
    Result<std::optional<double>> tolerance(std::string_view name);
    Result<void> apply_multiplicity();
};

}  // namespace corpuscle::circuit
