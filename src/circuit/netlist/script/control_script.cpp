#include "circuit/netlist/script/control_script.hpp"

#include "circuit/analyses.hpp"
#include "circuit/netlist/script/script_commands.hpp"
#include "circuit/netlist/script/script_plots.hpp"
#include "circuit/netlist/script/script_variables.hpp"
#include "circuit/netlist/script/script_vectors.hpp"
#include "circuit/netlist/script/script_words.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

using Effect = ScriptCommand::Effect;
constexpr std::size_t max_command_length = 10000;                     // after the replacement of variables
constexpr std::size_t max_script_characters = std::size_t{10} << 20;  // of all commands, after all replacements
constexpr std::string_view needs_number = "it depends on a variable; write its number";
constexpr std::string_view is_complex = "expressions of complex curves are not available in .ac; print their parts, such as vm(a)";

class ScriptReader {
    LogicalLineReader& lines_;
    const LogicalLine& from_;
    ControlScript out_;
    ScriptVectors vectors_;
    ScriptPlots plots_;
    ScriptVariables variables_;
    IgnoredCommands ignored_;
    /// A block of if, while ... that is open.
    struct Block {
        const ScriptCommand* command;
        SourceLocation location;
        int depth = 1;       // of the blocks in it
        std::string effect;  // a command in it that the rest of the script depends on; "" if there is none
    };
    std::optional<Block> block_;
    std::size_t characters_ = 0;  // of all commands so far

public:
    ScriptReader(LogicalLineReader& lines, const LogicalLine& from, bool is_stopped) : lines_(lines), from_(from) {
        out_.is_stopped = is_stopped;
        if (is_stopped) out_.warnings.push_back(error_at(from.location(), ".control: this script is not run, since an earlier one ended"));
    }

    Result<ControlScript> read() {
        const auto is_closed = TRY(read_commands());
        if (!is_closed) return error_at(from_.location(), ".control is not closed by .endc");
        if (block_ && !std::exchange(out_.is_stopped, true))
            out_.warnings.push_back(error_at(block_->location, ".control: '{}' is not closed by 'end'; the commands after it are not run",
                                             block_->command->name));
        ignored_.add_warnings(out_.warnings);
        return std::move(out_);
    }

private:
    /// Reads all commands, each with its continuations. Returns false if neither .endc nor .end follows.
    Result<bool> read_commands() {
        std::optional<LogicalLine> pending;
        const auto run_pending = [&]() -> Result<void> {
            if (pending) run(std::move(*pending));
            pending.reset();
            if (characters_ + vectors_.expanded_characters() <= max_script_characters) return {};
            return error_at(from_.location(), ".control: with its variables and vectors replaced, this script exceeds the limit of {} MB",
                            max_script_characters >> 20);
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
            TRY(run_pending());
            if (text.starts_with(".endc")) return true;
            if (text == ".end") {
                out_.warnings.push_back(error_at(from_.location(), ".control is closed by .end; write .endc before it"));
                return out_.ends_netlist = true;
            }
            pending = std::move(line);
        }
        TRY(run_pending());
        return false;
    }

    void run(LogicalLine line) {
        if (out_.is_stopped) return;
        for (const std::string_view comment : {" ;", " $ "})
            if (const auto at = line.text.find(comment); at != std::string::npos) line.text.resize(at);
        const auto number_of = [this](std::string_view name) { return vectors_.number(name); };
        if (line.text.find('$') != std::string::npos) line.text = variables_.replace(line.text, number_of, max_command_length);
        characters_ += line.text.size();
        if (line.text.size() > max_command_length)
            return stop(line, fmt::format("a command is longer than {} characters", max_command_length));
        const std::string word(command_name(line.text));
        if (word.empty()) return;
        if (block_) return skip_in_block(word, line);
        if (find_analysis(word) != nullptr) return analysis(word, std::move(line));
        if (word == "run") return plots_.run(), vectors_.leave_plot();
        if (word == "meas" || word == "measure") return measure(std::move(line));
        if (word == "print") return print(line);
        if (word == "let") return let(line);
        if (word == "unlet") return unlet(line);
        if (word == "fourier") return fourier(line);
        if (word == "set") return set(line);
        if (word == "unset") return unset(line);
        if (word == "setplot") return setplot(line);
        other(word, line);
    }

    void other(const std::string& word, const LogicalLine& line) {
        const auto* row = find_script_command(word);
        if (row == nullptr) return ignore(word, line, fmt::format("it is unknown{}", did_you_mean(word, script_command_names())));
        switch (row->effect) {
            case Effect::changes:
                return stop_before(word, line, row->remedy);
            case Effect::ends:
                out_.is_stopped = true;
                return;
            case Effect::block:
                block_ = Block{row, line.location(1), 1, ""};
                forget_loop_variable(word, line);
                return;
            case Effect::selects_plot:
                lose_plot(word);
                break;
            case Effect::none:
                break;
        }
        ignore(word, line, row->remedy);
    }

    // ---- commands without effect ----

    void ignore(const std::string& word, const LogicalLine& line, std::string_view remedy) { ignored_.add(word, line.location(1), remedy); }
    void leave_out(const LogicalLine& line, std::string_view what, std::string_view why) {
        out_.warnings.push_back(error_at(line.location(1), ".control: {} is left out: {}", what, why));
    }
    void stop(const LogicalLine& line, std::string_view why) {
        out_.warnings.push_back(error_at(line.location(1), ".control: {}; the rest of this script is not run", why));
        out_.is_stopped = true;
    }
    void stop_before(std::string_view word, const LogicalLine& line, std::string_view remedy) {
        out_.warnings.push_back(
            error_at(line.location(1), ".control: '{}' is not supported; the rest of this script is not run; {}", word, remedy));
        out_.is_stopped = true;
    }

    // ---- blocks ----

    /// Skips a command of a condition or loop. The vectors and variables that it would change are unknown after it.
    void skip_in_block(const std::string& word, const LogicalLine& line) {
        const auto* row = find_script_command(word);
        if (row != nullptr && row->effect == Effect::block) ++block_->depth;
        const auto effect = effect_in_block(word, row, line);
        if (block_->effect.empty()) block_->effect = effect;
        const auto words = split_script_words(line.text, word.size() + 1);
        if (word == "let" && !words.empty()) vectors_.define_unknown(words[0].text.substr(0, words[0].text.find_first_of("=[(")));
        if (word.starts_with("meas") && words.size() > 1) vectors_.define_unknown(words[1].text);
        for (std::size_t k = 0; word == "unlet" && k < words.size(); ++k) vectors_.define_unknown(words[k].text);
        if (word == "set" || word == "unset") unset(line);
        if (word == "setplot" || (row != nullptr && row->effect == Effect::selects_plot)) lose_plot(word);
        forget_loop_variable(word, line);
        if (word != "end" || --block_->depth > 0) return;
        const auto block = *std::exchange(block_, std::nullopt);
        if (block.effect.empty()) return ignored_.add(std::string(block.command->name), block.location, block.command->remedy);
        stop_before(block.effect, line, "it is inside a condition or a loop: write its commands directly, or use .step");
    }
    /// The command of a block if the rest of the script depends on it; else "". A quit with a code reports an error of the script's own
    /// checks.
    std::string effect_in_block(const std::string& word, const ScriptCommand* row, const LogicalLine& line) const {
        for (const auto& variable : word == "set" ? read_variables(arguments(line)) : std::vector<ScriptVariable>())
            if (is_circuit_variable(variable.name)) return "set " + variable.name;
        const bool is_plain_quit = row != nullptr && row->effect == Effect::ends && (arguments(line).empty() || arguments(line) == "0");
        const bool changes = row != nullptr && row->effect == Effect::changes;
        return find_analysis(word) != nullptr || word == "run" || changes || is_plain_quit ? word : "";
    }
    void forget_loop_variable(const std::string& word, const LogicalLine& line) {
        const auto words = word == "foreach" ? split_script_words(line.text, word.size() + 1) : std::vector<ScriptWord>();
        if (!words.empty()) variables_.remove(words[0].text);
    }

    // ---- variables ----

    /// The text of a command after its name.
    static std::string_view arguments(const LogicalLine& line) {
        return trimmed(std::string_view(line.text).substr(command_name(line.text).size() + 1));
    }

    void set(const LogicalLine& line) {
        for (const auto& variable : read_variables(arguments(line))) {
            if (is_circuit_variable(variable.name))
                return stop_before("set " + variable.name, line, "write it as .options outside of the script");
            variables_.set(variable);
        }
        ignore("set", line, find_script_command("set")->remedy);
    }
    /// Removes the variables of an unset, or of a set that is skipped.
    void unset(const LogicalLine& line) {
        for (const auto& variable : read_variables(arguments(line))) variables_.remove(variable.name);
    }

    // ---- plots ----

    void lose_plot(const std::string& command) {
        plots_.lose(fmt::format("it is that of '{}'", command));
        vectors_.leave_plot();
    }
    void setplot(const LogicalLine& line) {
        const auto words = split_script_words(line.text, command_name(line.text).size() + 1);
        if (words.empty()) return ignore("setplot", line, "it only shows text");
        plots_.select(words[0].text);
        vectors_.leave_plot();
    }

    // ---- analyses, measures, prints, vectors ----

    void add(LogicalLine line, bool is_analysis, int analysis = ControlScript::any_analysis) {
        characters_ += line.text.size();
        out_.commands.push_back({std::move(line), is_analysis, analysis});
    }

    void analysis(const std::string& kind, LogicalLine line) {
        vectors_.leave_plot();
        if (line.text.find('$') != std::string::npos) {
            leave_out(line, line.text.substr(1), needs_number);
            return plots_.leave_out(kind);
        }
        add(std::move(line), true);
        plots_.add(kind, static_cast<int>(out_.commands.size()) - 1);
    }

    void measure(LogicalLine line) {
        if (const auto redirection = line.text.find(" >"); redirection != std::string::npos) line.text.resize(redirection);
        const auto words = split_script_words(line.text, command_name(line.text).size() + 1);
        if (words.size() < 3) return add(std::move(line), false);  // reported as a directive
        const auto& kind = words[0].text;
        const auto rest = std::string_view(line.text).substr(words[2].at);
        const auto expanded = vectors_.expand_measure(rest);
        auto problem = expanded.problem;
        if (problem.empty()) problem = plots_.measure_problem(kind);
        if (problem.empty() && line.text.find('$') != std::string::npos) problem = needs_number;
        if (problem.empty() && kind == "ac" && expanded.has_whole_curves) problem = is_complex;
        if (!problem.empty()) {
            vectors_.define_unknown(words[1].text);
            return leave_out(line, ".meas " + words[1].text, problem);
        }
        DirectiveText out(line, ".meas");
        out.add(kind, words[0].at), out.add(words[1].text, words[1].at);
        if (expanded.text == rest)
            for (std::size_t k = 2; k < words.size(); ++k) out.add(words[k].text, words[k].at);
        else
            out.add(expanded.text, words[2].at);
        vectors_.define_measure(words[1].text);
        add(out.take(), false, plots_.last(kind));
    }

    void fourier(const LogicalLine& line) {
        if (const auto problem = plots_.measure_problem("tran"); !problem.empty()) return leave_out(line, "fourier", problem);
        DirectiveText out(line, ".four");
        for (const auto& word : split_script_words(line.text, command_name(line.text).size() + 1)) out.add(word.text, word.at);
        add(out.take(), false, plots_.last("tran"));
    }

    void print(const LogicalLine& line) {
        DirectiveText out(line, ".print");
        if (!plots_.kind().empty()) out.add(plots_.kind(), 1);
        bool has_columns = false;
        for (const auto& word : joined_expressions(split_script_words(line.text, 6))) {
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
        if (has_columns) add(out.take(), false, plots_.analysis());
    }
    static bool is_number_of_analysis(std::string_view name) {
        return std::ranges::any_of(analyses, [&](const Analysis* a) { return std::ranges::find(a->numbers, name) != a->numbers.end(); });
    }

    /// The column of .print for an expression; "" if it has none. A number is printed as a measure.
    std::string printed(const ScriptWord& word, const LogicalLine& line) {
        const auto left_out = [&](std::string_view why) { return leave_out(line, fmt::format("print {}", word.text), why), std::string(); };
        if (is_plain_curve(word.text) && !vectors_.contains(word.text))
            return plots_.problem().empty() ? word.text : left_out(plots_.problem());
        const auto expanded = vectors_.expand(word.text);
        if (expanded.depends_on_curves && !plots_.problem().empty()) return left_out(plots_.problem());
        if (!expanded.problem.empty()) return left_out(expanded.problem);
        if (expanded.depends_on_curves && expanded.depends_on_measures) return left_out("it has both curves and measures");
        if (expanded.has_whole_curves && plots_.kind() == "ac") return left_out(is_complex);
        if (expanded.depends_on_curves) return fmt::format("par('{}')", expanded.text);
        return add_number(word.text, expanded.text, line), "";
    }

    /// A number that depends on measures only, or on nothing: a measure of its own.
    void add_number(std::string_view name, std::string_view value, const LogicalLine& line) {
        DirectiveText out(line, ".meas");
        constexpr std::string_view without_measures[] = {"", "pz", "tf", "sens"};
        const bool has_measures = std::ranges::find(without_measures, plots_.kind()) == std::end(without_measures);
        out.add(has_measures ? std::string_view(plots_.kind()) : "op", 1), out.add(name, 1), out.add(fmt::format("param='{}'", value), 1);
        add(out.take(), false);
    }

    void let(const LogicalLine& line) {
        const auto text = arguments(line);
        const auto equals = text.find('=');
        const std::string name(trimmed(text.substr(0, std::min(equals, text.find_first_of("[(")))));
        if (equals == std::string_view::npos || name.empty()) return leave_out(line, line.text.substr(1), "expected let NAME = EXPRESSION");
        auto value = vectors_.expand(trimmed(text.substr(equals + 1)));
        if (name.size() < trimmed(text.substr(0, equals)).size()) value.problem = "elements of a vector are not available";
        if (value.depends_on_curves && value.problem.empty()) value.problem = plots_.problem();
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
    void unlet(const LogicalLine& line) {
        for (const auto& word : split_script_words(line.text, command_name(line.text).size() + 1)) vectors_.remove(word.text);
    }
};

}  // namespace

Result<ControlScript> read_control_script(LogicalLineReader& lines, const LogicalLine& from, bool is_stopped) {
    return ScriptReader(lines, from, is_stopped).read();
}

}  // namespace corpuscle::circuit
