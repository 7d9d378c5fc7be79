#include "cli/shell/completion.hpp"

#include <algorithm>

#include "cli/verb_options.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

bool is_positional(const OptionRow& row) { return !row.names.starts_with('-'); }

/// True if a value follows the option as a word of its own.
bool takes_value(const OptionRow& row) {
    const bool is_flag = std::holds_alternative<bool*>(row.target) || std::holds_alternative<std::optional<bool>*>(row.target) ||
                         (std::holds_alternative<OptionReader>(row.target) && row.value.empty());
    return !is_positional(row) && !is_flag && !(row.count && row.count->first == 0);
}

/// True if the value is the name of a file or directory, as the placeholder says: "FILE", "NAME|FILE", "[FILE.html]".
bool is_file(const OptionRow& row) {
    for (auto part : split(is_positional(row) ? row.names : row.value, '|')) {
        part.remove_prefix(std::min(part.find_first_not_of('['), part.size()));
        const auto word = part.substr(0, part.find_first_of(".]"));
        for (const std::string_view of_files : {"FILE", "FILES", "DIR", "RESULTS", "FORCE", "NETLIST", "WHERE", "IN", "OUT"})
            if (word == of_files) return true;
    }
    return false;
}

/// Collects the words that begin with the word that is being typed.
class Completion {
    std::string word_;
    std::vector<std::string> found_ = {};
    bool files_ = false;

public:
    explicit Completion(std::string word) : word_(std::move(word)) {}

    void add(const std::string& candidate) {
        if (candidate.starts_with(word_) && std::find(found_.begin(), found_.end(), candidate) == found_.end()) found_.push_back(candidate);
    }
    /// Adds the values of a row. `before` is the part of the word before the value: "--population=", or "sa1," of a list.
    void add_values(const OptionRow& row, std::string before) {
        if (row.splits_at_commas)
            if (const auto comma = word_.rfind(','); comma != word_.npos) before = word_.substr(0, comma + 1);
        if (const auto* choices = std::get_if<std::vector<std::string>>(&row.check))
            for (const auto& choice : *choices) add(before + choice);
        if (row.suggestions)
            for (const auto& name : row.suggestions()) add(before + name);
        files_ = files_ || is_file(row);
    }
    /// The lines, in which settings of one target that has not been typed yet, "sa1.f_B=" and "sa1.f_C=", are the target alone: "sa1.".
    std::string lines() const {
        std::vector<std::string> out;
        for (const auto& candidate : found_) {
            const auto dot = candidate.ends_with('=') ? candidate.rfind('.') : candidate.npos;
            const auto line = dot != candidate.npos && dot >= word_.size() ? candidate.substr(0, dot + 1) : candidate;
            if (std::find(out.begin(), out.end(), line) == out.end()) out.push_back(line);
        }
        std::string text;
        for (const auto& line : out) text += line + "\n";
        return files_ ? text + ":files\n" : text;
    }
};

/// The verb and the option that the words before the last one lead to.
struct CommandState {
    const std::vector<Verb>* verbs;     // that may follow
    const Verb* verb = nullptr;         // null: none has been typed
    std::vector<OptionRow> rows = {};   // of the verb
    const OptionRow* option = nullptr;  // whose value is the next word
    std::size_t positionals = 0;        // that have been typed
    bool only_positionals = false;      // after "--"
};

const OptionRow* find_option(const std::vector<OptionRow>& rows, std::string_view name) {
    for (const auto& row : rows)
        for (const auto part : split(row.names, ','))
            if (!is_positional(row) && part == name) return &row;
    return nullptr;
}

void enter_verb(CommandState& state, const Verb& verb, CommonArguments& common) {
    state.verb = &verb, state.verbs = &verb.sub_verbs;
    state.rows.clear();
    for (auto& group : all_options(verb, common))
        for (auto& row : group.rows) state.rows.push_back(std::move(row));
}

void follow_word(CommandState& state, const std::string& word, CommonArguments& common) {
    if (state.option) return static_cast<void>(state.option = nullptr);
    if (word == "--" || state.only_positionals)
        return state.positionals += state.only_positionals, static_cast<void>(state.only_positionals = true);
    if (word.starts_with('-')) {
        const auto* const option = find_option(state.rows, word);
        return static_cast<void>(state.option = option && takes_value(*option) ? option : nullptr);
    }
    const auto verb = std::find_if(state.verbs->begin(), state.verbs->end(), [&](const Verb& v) { return v.name == word; });
    verb != state.verbs->end() && state.positionals == 0 ? enter_verb(state, *verb, common) : static_cast<void>(++state.positionals);
}

/// The positional argument that the next word is; null if there is none.
const OptionRow* next_positional(const CommandState& state) {
    std::size_t left = state.positionals;
    const OptionRow* last = nullptr;
    for (const auto& row : state.rows) {
        if (!is_positional(row)) continue;
        if (left-- == 0) return &row;
        last = &row;
    }
    const bool repeats = last && (last->is_repeatable || last->count || std::holds_alternative<std::vector<std::string>*>(last->target));
    return repeats ? last : nullptr;
}

void add_options(Completion& to, const CommandState& state, const std::string& word, const std::vector<std::string>& extra) {
    const auto equals = word.find('=');
    if (equals != word.npos) {
        const auto* const option = find_option(state.rows, word.substr(0, equals));
        if (option) to.add_values(*option, word.substr(0, equals + 1));
        return;
    }
    for (const auto& row : state.rows)
        if (!is_positional(row)) to.add(std::string(row.names.substr(0, row.names.find(','))));
    for (const auto& option : extra) to.add(option);
}

}  // namespace

std::string completions(const std::vector<Verb>& verbs, const std::vector<std::string>& words,
                        const std::vector<std::string>& extra_options) {
    if (words.empty()) return "";
    CommonArguments common;
    CommandState state{&verbs};
    const bool is_help = words.size() > 1 && words[0] == "help";
    for (std::size_t k = is_help ? 1 : 0; k + 1 < words.size(); ++k) follow_word(state, words[k], common);
    Completion out(words.back());
    if (state.option) {
        out.add_values(*state.option, "");
    } else if (words.back().starts_with('-') && !state.only_positionals) {
        add_options(out, state, words.back(), extra_options);
    } else {
        if (state.positionals == 0)
            for (const auto& verb : *state.verbs) out.add(verb.name);
        if (!state.verb && !is_help) out.add("help");
        if (const auto* const row = next_positional(state); row && !is_help) out.add_values(*row, "");
    }
    return out.lines();
}

}  // namespace corpuscle
