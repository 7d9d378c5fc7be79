#include "circuit/netlist/control_script.hpp"

#include "circuit/analyses.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::string_view commands_that_change_the_circuit[] = {"alter",  "altermod", "alterparam", "reset",     "foreach", "while",
                                                                 "repeat", "dowhile",  "if",         "source",    "load",    "stop",
                                                                 "step",   "resume",   "remcirc",    "mc_source", "option"};

/// ".meas NAME" of ".meas tran NAME ..."
std::string measure_name(std::string_view command) {
    std::vector<std::string> words;
    for (auto at = command.find_first_not_of(" \t"); at != std::string_view::npos && words.size() < 3;) {
        const auto end = std::min(command.find_first_of(" \t", at), command.size());
        words.emplace_back(command.substr(at, end - at));
        at = command.find_first_not_of(" \t", end);
    }
    return words[0] + " " + words.back();
}

/// The first of these vectors that is a word of a command; "" if there is none.
std::string_view vector_in(std::string_view command, const std::vector<std::string>& vectors) {
    const auto is_end = [&](std::size_t k) {
        return k >= command.size() || std::string_view(" \t=()").find(command[k]) != std::string_view::npos;
    };
    for (const std::string_view vector : vectors)
        for (auto at = command.find(vector); at != std::string_view::npos; at = command.find(vector, at + 1))
            if (is_end(at - 1) && is_end(at + vector.size())) return vector;
    return "";
}

class ScriptReader {
    LogicalLineReader& lines_;
    const LogicalLine& from_;
    ControlScript out_;
    std::vector<std::string> ignored_, vectors_;  // vectors_: those that the script computes
    std::string analysis_;                        // the last one
    bool is_ended_ = false;

public:
    ScriptReader(LogicalLineReader& lines, const LogicalLine& from) : lines_(lines), from_(from) {}

    Result<ControlScript> read() {
        for (LogicalLine line; !is_ended_ && lines_.next_command(line);) command(std::move(line));
        if (!is_ended_) return error_at(from_.location(), ".control is not closed by .endc");
        if (!ignored_.empty())
            out_.warnings.push_back(
                error_at(from_.location(), ".control: these commands have no effect here: {}", joined(ignored_)));
        return std::move(out_);
    }

private:
    void command(LogicalLine line) {
        for (const std::string_view comment : {" ;", " $ "})
            if (const auto at = line.text.find(comment); at != std::string::npos) line.text.resize(at);
        const std::string word = line.text.substr(1, line.text.find_first_of(" \t(") - 1);
        if (word.empty() || word == "." || std::string_view("*#$;").find(word[0]) != std::string_view::npos) return;
        if (word.starts_with(".endc")) return void(is_ended_ = true);
        if (std::ranges::find(commands_that_change_the_circuit, word) != std::end(commands_that_change_the_circuit)) return stop(word, line);
        if (find_analysis(word) != nullptr) return analysis(word, std::move(line));
        if (word == "meas" || word == "measure") return measure(std::move(line));
        if (word == "print") {
            line.text.insert(6, " " + analysis_);
            return add(std::move(line));
        }
        if (word == "fourier") {
            line.text.erase(5, 3);  // ".four"
            return add(std::move(line));
        }
        if (word == "run") return;
        if (word == "let") vectors_.emplace_back(trimmed(std::string_view(line.text).substr(4, line.text.find('=') - 4)));
        if (std::ranges::find(ignored_, word) == ignored_.end()) ignored_.push_back(word);
    }

    void add(LogicalLine line, bool is_analysis = false) { out_.commands.push_back({std::move(line), is_analysis}); }

    void analysis(const std::string& name, LogicalLine line) {
        analysis_ = name;
        add(std::move(line), true);
    }

    void measure(LogicalLine line) {
        if (const auto redirection = line.text.find(" >"); redirection != std::string::npos) line.text.resize(redirection);
        if (const auto vector = vector_in(line.text, vectors_); !vector.empty())
            return out_.warnings.push_back(
                error_at(line.location(1), "{} is left out: the script computes '{}'", measure_name(line.text), vector));
        add(std::move(line));
    }

    void stop(std::string_view word, const LogicalLine& line) {
        out_.warnings.push_back(error_at(line.location(1), ".control: '{}' is not supported; the rest of this script is not run", word));
        is_ended_ = lines_.skip_past(".endc");
    }
};

}  // namespace

Result<ControlScript> read_control_script(LogicalLineReader& lines, const LogicalLine& from) { return ScriptReader(lines, from).read(); }

}  // namespace corpuscle::circuit
