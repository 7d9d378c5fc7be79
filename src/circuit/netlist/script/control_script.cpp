#include "circuit/netlist/script/control_script.hpp"

#include "circuit/analyses.hpp"
#include "circuit/netlist/script/script_commands.hpp"
#include "circuit/netlist/script/script_vectors.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

using Effect = ScriptCommand::Effect;
constexpr std::size_t max_command_length = 10000;  // after the replacement of variables

/// A part of a command that blanks and commas outside parentheses separate.
struct ScriptWord {
    std::string text;
    std::size_t at;  // its offset in the command
};

std::vector<ScriptWord> split_words(std::string_view text, std::size_t from) {
    std::vector<ScriptWord> out;
    int depth = 0;
    bool is_open = false;
    for (std::size_t k = from; k < text.size(); ++k) {
        const char c = text[k];
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        const bool separates = c == ' ' || c == '\t' || (c == ',' && depth <= 0);
        if (separates && depth <= 0) {
            is_open = false;
        } else if (!std::exchange(is_open, true)) {
            out.push_back({std::string(1, c), k});
        } else {
            out.back().text += c;
        }
    }
    return out;
}

/// Joins the words of an expression with blanks around its operators: "v(a)", "-", "v(b)".
std::vector<ScriptWord> joined_expressions(std::vector<ScriptWord> words) {
    std::vector<ScriptWord> out;
    for (auto& word : words) {
        constexpr std::string_view operators = "+-*/^";
        const bool continues = !out.empty() && (operators.find(out.back().text.back()) != std::string_view::npos || word.text == "-" ||
                                                std::string_view("+*/^").find(word.text[0]) != std::string_view::npos);
        continues ? void(out.back().text += word.text) : out.push_back(std::move(word));
    }
    return out;
}

bool is_vector_name(std::string_view text) { return text.find_first_of("+-*/^()[]<>&|!%?:,{}'\"= ") == std::string_view::npos; }

/// True for a curve that a print names directly: v(a), vdb(a), i(v1), all, v1#branch, or a name.
bool is_plain_curve(std::string_view text) {
    const auto open = text.find('(');
    if (open == std::string_view::npos) return is_vector_name(text);
    constexpr std::string_view parts[] = {"", "m", "db", "p", "r", "i"};
    return (text[0] == 'v' || text[0] == 'i') && std::ranges::find(parts, text.substr(1, open - 1)) != std::end(parts) &&
           text.find_first_of("()", open + 1) == text.size() - 1;
}

/// A directive that replaces a command. Its words keep the locations that they have in the command.
class DirectiveText {
    LogicalLine line_;
    const LogicalLine& command_;

public:
    DirectiveText(const LogicalLine& command, std::string_view name) : line_{std::string(name), {}, command.file, {}}, command_(command) {
        locate(0, 1);
    }
    void add(std::string_view word, std::size_t at) {
        line_.text += ' ';
        locate(line_.text.size(), at);
        line_.text += word;
    }
    LogicalLine take() { return std::move(line_); }

private:
    void locate(std::size_t offset, std::size_t at) {
        const auto location = command_.location(at);
        line_.segments.push_back({static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(location.line),
                                  static_cast<std::uint32_t>(std::max(location.column, 1L))});
    }
};

class ScriptReader {
    LogicalLineReader& lines_;
    const LogicalLine& from_;
    ControlScript out_;
    ScriptVectors vectors_;
    std::map<std::string, std::string, std::less<>> variables_;  // of set
    /// The plot that prints and vectors refer to.
    std::string plot_kind_;  // "tran"; "": any
    int plot_analysis_ = ControlScript::any_analysis;
    std::string plot_problem_;  // the reason why its curves are not available; "" if they are
    /// Commands without effect, each with its first line.
    struct Ignored {
        SourceLocation location;
        std::string name, remedy;
        int count;
    };
    std::vector<Ignored> ignored_;
    int block_depth_ = 0;       // of if, while ... that are open
    std::string block_effect_;  // a command in the block that the rest of the script depends on; "" if there is none
    bool is_stopped_ = false;   // the other commands up to .endc are not run

public:
    ScriptReader(LogicalLineReader& lines, const LogicalLine& from) : lines_(lines), from_(from) {}

    Result<ControlScript> read() {
        if (!read_commands()) return error_at(from_.location(), ".control is not closed by .endc");
        for (const auto& command : ignored_) {
            const auto others = command.count == 1 ? std::string() : fmt::format(" (and {} more)", command.count - 1);
            out_.warnings.push_back(
                error_at(command.location, ".control: '{}' has no effect here{}: {}", command.name, others, command.remedy));
        }
        return std::move(out_);
    }

private:
    /// Reads all commands, each with its continuations. Returns false if neither .endc nor .end follows.
    bool read_commands() {
        std::optional<LogicalLine> pending;
        const auto run_pending = [&] {
            if (pending) run(std::move(*pending));
            pending.reset();
        };
        for (LogicalLine line; lines_.next_command(line);) {
            const std::string_view text = std::string_view(line.text).substr(1);
            if (text.empty() || std::string_view("*#$;").find(text[0]) != std::string_view::npos) continue;
            if (text[0] == '+' && pending) {
                pending->segments.push_back(
                    {static_cast<std::uint32_t>(pending->text.size()), line.segments[0].line, line.segments[0].column});
                pending->text += " " + std::string(text.substr(1));
                continue;
            }
            run_pending();
            if (text.starts_with(".endc")) return true;
            if (text == ".end") {
                out_.warnings.push_back(error_at(from_.location(), ".control is closed by .end; write .endc before it"));
                return out_.ends_netlist = true;
            }
            pending = std::move(line);
        }
        run_pending();
        return false;
    }

    void run(LogicalLine line) {
        if (is_stopped_) return;
        for (const std::string_view comment : {" ;", " $ "})
            if (const auto at = line.text.find(comment); at != std::string::npos) line.text.resize(at);
        if (!replace_variables(line)) return stop("$", line, "a variable is longer than the limit");
        const std::string word = line.text.substr(1, line.text.find_first_of(" \t(") - 1);
        if (word.empty()) return;
        if (block_depth_ > 0) return skip_in_block(word, line);
        if (find_analysis(word) != nullptr) return analysis(word, std::move(line));
        if (word == "run") return select_plot("", ControlScript::any_analysis);
        if (word == "meas" || word == "measure") return measure(std::move(line));
        if (word == "print") return print(line);
        if (word == "let") return let(line);
        if (word == "fourier") {
            line.text.erase(5, 3);  // ".four"
            return add(std::move(line), false);
        }
        if (word == "set") return set(line);
        if (word == "setplot") return setplot(line);
        other(word, line);
    }

    void other(const std::string& word, const LogicalLine& line) {
        const auto* row = find_script_command(word);
        if (row == nullptr) return ignore(word, line, fmt::format("it is unknown{}", did_you_mean(word, script_command_names())));
        switch (row->effect) {
            case Effect::changes:
                return stop(word, line, row->remedy);
            case Effect::ends:
                is_stopped_ = true;
                return;
            case Effect::block:
                block_depth_ = 1, block_effect_.clear();
                break;
            case Effect::selects_plot:
                lose_plot(fmt::format("it is that of '{}'", word));
                break;
            case Effect::none:
                break;
        }
        ignore(word, line, row->remedy);
    }

    // ---- commands without effect ----

    void ignore(const std::string& word, const LogicalLine& line, std::string_view remedy) {
        const auto known = std::ranges::find(ignored_, word, &Ignored::name);
        if (known != ignored_.end()) return void(++known->count);
        ignored_.push_back({line.location(1), word, std::string(remedy), 1});
    }
    void leave_out(const LogicalLine& line, std::string_view what, std::string_view why) {
        out_.warnings.push_back(error_at(line.location(1), ".control: {} is left out: {}", what, why));
    }
    void stop(std::string_view word, const LogicalLine& line, std::string_view remedy) {
        out_.warnings.push_back(
            error_at(line.location(1), ".control: '{}' is not supported; the rest of this script is not run; {}", word, remedy));
        is_stopped_ = true;
    }

    /// Skips a command of a condition or loop. The vectors that it would compute are unknown after it.
    void skip_in_block(const std::string& word, const LogicalLine& line) {
        const auto* row = find_script_command(word);
        if (row != nullptr && row->effect == Effect::block) ++block_depth_;
        const bool has_effect = find_analysis(word) != nullptr || word == "run" || (row != nullptr && row->effect == Effect::changes);
        if (has_effect && block_effect_.empty()) block_effect_ = word;
        const auto words = split_words(line.text, word.size() + 1);
        if (word == "let" && !words.empty()) vectors_.define_unknown(words[0].text.substr(0, words[0].text.find_first_of("=[(")));
        if (word.starts_with("meas") && words.size() > 1) vectors_.define_unknown(words[1].text);
        if (word != "end" || --block_depth_ > 0) return;
        if (!block_effect_.empty())
            stop(block_effect_, line, "it is inside a condition or a loop: write its commands directly, or use .step");
    }

    // ---- variables ----

    /// Replaces $name of set and $&name of let. Returns false if the command becomes too long.
    bool replace_variables(LogicalLine& line) const {
        for (auto at = line.text.find('$'); at != std::string::npos; at = line.text.find('$', at)) {
            const bool is_vector = at + 1 < line.text.size() && line.text[at + 1] == '&';
            const auto first = at + 1 + is_vector;
            auto end = first;
            while (end < line.text.size() && (std::isalnum(static_cast<unsigned char>(line.text[end])) || line.text[end] == '_')) ++end;
            const auto name = line.text.substr(first, end - first);
            const auto variable = variables_.find(name);
            const auto value = is_vector                      ? vectors_.number(name)
                               : variable != variables_.end() ? std::optional(variable->second)
                                                              : std::nullopt;
            if (value) line.text.replace(at, end - at, *value);
            at = value ? at + value->size() : end;
            if (line.text.size() > max_command_length) return false;
        }
        return true;
    }

    void set(const LogicalLine& line) {
        const auto text = std::string_view(line.text).substr(4);
        const auto equals = text.find('=');
        const std::string name(trimmed(text.substr(0, equals)));
        if (is_circuit_variable(name)) return stop("set " + name, line, "write it as .options outside of the script");
        if (equals != std::string_view::npos) {
            const auto value = unquoted(trimmed(text.substr(equals + 1)));
            if (value.find('(') == std::string_view::npos && value.find('$') == std::string_view::npos)
                variables_.insert_or_assign(name, value);
        }
        ignore("set", line, find_script_command("set")->remedy);
    }

    // ---- plots ----

    void select_plot(std::string kind, int analysis) {
        plot_kind_ = std::move(kind), plot_analysis_ = analysis, plot_problem_.clear();
        vectors_.leave_plot();
    }
    void lose_plot(std::string problem) {
        plot_problem_ = "the curves of the current plot are not available, since " + std::move(problem);
        vectors_.leave_plot();
    }

    /// "setplot tran1" selects the only analysis of this kind.
    void setplot(const LogicalLine& line) {
        const auto words = split_words(line.text, 8);
        if (words.empty()) return ignore("setplot", line, "it only shows text");
        const auto kind = words[0].text.substr(0, words[0].text.find_first_of("0123456789"));
        int count = 0, last = ControlScript::any_analysis;
        for (std::size_t k = 0; k < out_.commands.size(); ++k)
            if (out_.commands[k].is_analysis && out_.commands[k].line.text.starts_with("." + kind + " "))
                ++count, last = static_cast<int>(k);
        if (find_analysis(kind) == nullptr || count > 1) return lose_plot(fmt::format("setplot {} is not supported", words[0].text));
        select_plot(kind, last);
    }

    // ---- analyses, measures, prints, vectors ----

    void add(LogicalLine line, bool is_analysis, int analysis = ControlScript::any_analysis) {
        out_.commands.push_back({std::move(line), is_analysis, analysis});
    }

    void analysis(const std::string& name, LogicalLine line) {
        if (line.text.find('$') != std::string::npos) {
            leave_out(line, line.text.substr(1), "it depends on a variable; write its number");
            return lose_plot(fmt::format("'{}' is left out", name));
        }
        add(std::move(line), true);
        select_plot(name, static_cast<int>(out_.commands.size()) - 1);
    }

    /// The last analysis of this kind in the script.
    int last_analysis(std::string_view kind) const {
        for (auto k = out_.commands.size(); k-- > 0;)
            if (const auto& c = out_.commands[k]; c.is_analysis && find_word(c.line.text) == kind) return static_cast<int>(k);
        return ControlScript::any_analysis;
    }
    static std::string_view find_word(std::string_view text) { return text.substr(1, text.find_first_of(" \t(") - 1); }

    void measure(LogicalLine line) {
        if (const auto redirection = line.text.find(" >"); redirection != std::string::npos) line.text.resize(redirection);
        const auto words = split_words(line.text, find_word(line.text).size() + 1);
        if (words.size() < 3) return add(std::move(line), false);  // reported as a directive
        const auto rest = std::string_view(line.text).substr(words[2].at);
        const auto expanded = vectors_.expand_measure(rest);
        auto problem = expanded.problem;
        if (problem.empty() && !plot_problem_.empty() && plot_problem_.find("left out") == std::string::npos) problem = plot_problem_;
        if (problem.empty() && line.text.find('$') != std::string::npos) problem = "it depends on a variable; write its number";
        if (!problem.empty()) {
            vectors_.define_unknown(words[1].text);
            return leave_out(line, ".meas " + words[1].text, problem);
        }
        DirectiveText out(line, ".meas");
        out.add(words[0].text, words[0].at), out.add(words[1].text, words[1].at);
        if (expanded.text == rest)
            for (std::size_t k = 2; k < words.size(); ++k) out.add(words[k].text, words[k].at);
        else
            out.add(expanded.text, words[2].at);
        vectors_.define_measure(words[1].text);
        add(out.take(), false, last_analysis(words[0].text));
    }

    void print(const LogicalLine& line) {
        DirectiveText out(line, ".print");
        if (!plot_kind_.empty()) out.add(plot_kind_, 1);
        bool has_columns = false;
        for (const auto& word : joined_expressions(split_words(line.text, 6))) {
            if (word.text[0] == '>') {
                ignore("print >", line, "a script writes no file; redirect the output of the program");
                break;
            }
            if (word.text == "line" || word.text == "col" || vectors_.is_measure(word.text) || is_number_of_analysis(word.text)) continue;
            const auto column = printed(word, line);
            if (column.empty()) continue;
            out.add(column, word.at);
            has_columns = true;
        }
        if (has_columns) add(out.take(), false, plot_analysis_);
    }
    static bool is_number_of_analysis(std::string_view name) {
        return std::ranges::any_of(analyses, [&](const Analysis* a) { return std::ranges::find(a->numbers, name) != a->numbers.end(); });
    }

    /// The column of .print for an expression; "" if it has none. A number is printed as a measure.
    std::string printed(const ScriptWord& word, const LogicalLine& line) {
        if (!plot_problem_.empty() && !vectors_.number(word.text))
            return leave_out(line, fmt::format("print {}", word.text), plot_problem_), "";
        if (is_plain_curve(word.text) && !vectors_.contains(word.text)) return word.text;
        const auto expanded = vectors_.expand(word.text);
        if (!expanded.problem.empty()) return leave_out(line, fmt::format("print {}", word.text), expanded.problem), "";
        if (expanded.depends_on_curves && !expanded.depends_on_measures) return fmt::format("par('{}')", expanded.text);
        if (expanded.depends_on_curves) return leave_out(line, fmt::format("print {}", word.text), "it has both curves and measures"), "";
        add_number(word.text, expanded.text, line);
        return "";
    }

    /// A number that depends on measures only, or on nothing: a measure of its own.
    void add_number(std::string_view name, std::string_view value, const LogicalLine& line) {
        DirectiveText out(line, ".meas");
        const auto kind = plot_kind_.empty() || plot_kind_ == "pz" || plot_kind_ == "tf" || plot_kind_ == "sens" ? "op" : plot_kind_;
        out.add(kind, 1), out.add(name, 1), out.add(fmt::format("param='{}'", value), 1);
        add(out.take(), false);
    }

    void let(const LogicalLine& line) {
        const auto text = std::string_view(line.text).substr(4);
        const auto equals = text.find('=');
        const std::string name(trimmed(text.substr(0, std::min(equals, text.find_first_of("[(")))));
        if (equals == std::string_view::npos || name.empty()) return leave_out(line, line.text.substr(1), "expected let NAME = EXPRESSION");
        auto value = vectors_.expand(trimmed(text.substr(equals + 1)));
        if (name.size() < trimmed(text.substr(0, equals)).size()) value.problem = "elements of a vector are not available";
        if (value.depends_on_curves && value.problem.empty()) value.problem = plot_problem_;
        if (value.depends_on_curves && value.depends_on_measures && value.problem.empty())
            value.problem = "it has both curves and measures";
        if (!value.problem.empty()) {
            vectors_.define_unknown(name);
            return leave_out(line, fmt::format("let {}", name), value.problem);
        }
        if (!value.depends_on_measures) return vectors_.define(name, value);
        add_number(name, value.text, line);
        vectors_.define_measure(name);
    }
};

}  // namespace

Result<ControlScript> read_control_script(LogicalLineReader& lines, const LogicalLine& from) { return ScriptReader(lines, from).read(); }

}  // namespace corpuscle::circuit
