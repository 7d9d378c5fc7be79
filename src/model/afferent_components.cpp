// Parses the text that specifies an afferent into components.

#include <fmt/format.h>
#include <algorithm>

#include "core/text/ascii_text.hpp"
#include "model/catalog.hpp"

namespace corpuscle {
namespace {

std::vector<std::string_view> names_of(const std::vector<CatalogEntry>& entries) {
    std::vector<std::string_view> names;
    for (const auto& entry : entries) names.push_back(entry.name);
    return names;
}

/// The one of `names` that equals `typed` except for upper and lower case; "" if none does.
std::string_view catalog_name(const std::vector<std::string_view>& names, std::string_view typed) {
    const auto at = std::find_if(names.begin(), names.end(), [&](auto name) { return equal_ignoring_case(name, typed); });
    return at == names.end() ? std::string_view() : *at;
}

/// A kind of component that can come before a receptor.
struct Kind {
    std::string_view article_and_name;          ///< "a sensor"
    std::vector<std::string_view> names;        ///< of all components of this kind
    std::string_view AfferentComponents::* at;  ///< the member that holds the component of this kind
};
/// All kinds, in the order in which the signal passes them.
const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all = {{"a sensor", names_of(sensor_entries()), &AfferentComponents::sensor},
                                          {"a transducer", names_of(transducer_entries()), &AfferentComponents::transducer},
                                          {"a converter", names_of(converter_entries()), &AfferentComponents::converter}};
    return all;
}

/// "the signal goes through a sensor (fsr), a transducer (f2v, f2i), a converter (adc), then the afferent"
std::string order() {
    std::string text = "the signal goes through ";
    for (const auto& kind : kinds()) text += fmt::format("{} ({}), ", kind.article_and_name, joined(kind.names));
    return text + "then the afferent";
}

Error unknown_afferent(std::string_view text) {
    std::vector<std::string_view> names;
    for (const auto& a : named_afferents()) names.push_back(a.name);
    return bad_input(
        fmt::format("unknown afferent '{}'{} ('corpuscle list' shows them all; a receptor and a neuron are combined as 'sa1b+lif-b')", text,
                    did_you_mean(text, names)));
}

Result<std::string_view> find_component(std::string_view text, std::string_view typed, const std::vector<std::string_view>& names,
                                        std::string_view kind) {
    if (std::find(names.begin(), names.end(), typed) != names.end()) return *std::find(names.begin(), names.end(), typed);
    return bad_input(fmt::format("{}: unknown {} '{}'{} (there are {})", text, kind, typed, did_you_mean(typed, names), joined(names)));
}

/// The error for a word of `text` that is a component in the wrong position, or not a component. `parts` are the components read before it.
Error misplaced(std::string_view text, std::string_view word, const AfferentComponents& parts) {
    std::vector<std::string_view> known;
    for (const auto& kind : kinds()) {
        known.insert(known.end(), kind.names.begin(), kind.names.end());
        const auto name = catalog_name(kind.names, word);
        if (name.empty()) continue;
        if (const auto first = parts.*kind.at; !first.empty())
            return bad_input(fmt::format("{}: '{}' after '{}': use only one of them", text, name, first));
        return bad_input(fmt::format("{}: '{}' is in the wrong place; {}", text, name, order()));
    }
    return bad_input(fmt::format("{}: '{}' is not a component that fits there{} ({})", text, word, did_you_mean(word, known), order()));
}

/// Reads the components of the front end from the first words into `parts`; returns the number of words read.
std::size_t read_front_end(std::span<const std::string_view> words, AfferentComponents& parts) {
    std::size_t taken = 0;
    for (const auto& kind : kinds())
        if (taken < words.size())
            if (const auto name = catalog_name(kind.names, words[taken]); !name.empty()) parts.*kind.at = name, ++taken;
    return taken;
}

/// The named afferent with this name or alias, in upper or lower case; null if there is none.
const NamedAfferent* find_named_afferent(std::string_view text) {
    for (const auto& a : named_afferents())
        if (equal_ignoring_case(a.name, text) || !catalog_name(a.aliases, text).empty()) return &a;
    return nullptr;
}

/// Reads the words after the front end: a named afferent, or a receptor and a neuron.
Result<void> read_afferent(std::string_view text, std::span<const std::string_view> words, AfferentComponents& parts) {
    static const auto receptors = names_of(receptor_entries()), neurons = names_of(neuron_entries());
    if (words.empty())
        return bad_input(fmt::format("{}: '{}' must be followed by an afferent, such as '{}+sa1'", text, parts.front_end(), text));
    parts.named = find_named_afferent(words.back());
    const std::size_t needed = parts.named ? 1 : 2;  // number of words: a name, or a receptor and a neuron
    for (const auto& kind : kinds())
        for (const auto word : words)
            if (!catalog_name(kind.names, word).empty()) return misplaced(text, word, parts);
    if (words.size() > needed) return misplaced(text, words[0], parts);
    if (words.size() < needed) return unknown_afferent(words[0]);
    if (parts.named) return {};
    const auto receptor = TRY(find_component(text, words[0], receptors, "receptor"));
    const auto neuron = TRY(find_component(text, words[1], neurons, "neuron"));
    parts.receptor = receptor, parts.neuron = neuron;
    return {};
}

}  // namespace

std::string join_components(std::initializer_list<std::string_view> names) {
    std::string text;
    for (const auto name : names)
        if (!name.empty()) text += (text.empty() ? "" : "+") + std::string(name);
    return text;
}

Result<AfferentComponents> parse_components(std::string_view text) {
    AfferentComponents parts;
    const auto words = split(text, '+');
    const auto taken = read_front_end(words, parts);
    TRY(read_afferent(text, std::span(words).subspan(taken), parts));
    if (parts.named) {
        parts.receptor = parts.named->receptor, parts.neuron = parts.named->neuron;
        if (taken > 0 && !parts.named->front_end.empty())
            return bad_input(fmt::format("{}: {} has its own front end ({}); put '{}' before {}+{} instead", text, parts.named->name,
                                         parts.named->front_end, parts.front_end(), parts.receptor, parts.neuron));
        if (taken == 0 && !parts.named->front_end.empty()) read_front_end(split(parts.named->front_end, '+'), parts);
    }
    if (parts.sensor.empty() && !parts.transducer.empty())
        return bad_input(fmt::format("{}: {} needs the conductance of a sensor before it, such as 'fsr+{}'", text, parts.transducer, text));
    return parts;
}

}  // namespace corpuscle
