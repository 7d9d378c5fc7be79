// Parses the statements of a netlist, of the files that it includes and of sections of libraries.

#include <filesystem>

#include "circuit/analyses.hpp"
#include "circuit/devices.hpp"
#include "circuit/expression/spice_number.hpp"
#include "circuit/netlist/parsed_netlist.hpp"
#include "circuit/netlist/random_values.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::size_t max_include_depth = 50, max_definition_depth = 200;  // of files; of nested .subckt

// Directives that determine the circuit; they do not appear in Circuit::directives.
constexpr std::string_view structural_directives[] = {
    ".subckt", ".ends", ".param",   ".global_param", ".func", ".include", ".incl",    ".inc", ".lib",     ".endl", ".model",
    ".global", ".temp", ".options", ".option",       ".opt",  ".ic",      ".nodeset", ".end", ".control", ".endc", ".title"};
// Directives that become Circuit::directives, as those of the analyses do.
constexpr std::string_view circuit_directives[] = {".meas", ".measure", ".print", ".plot",  ".probe",  ".save", ".step",
                                                   ".mc",   ".expect",  ".force", ".spike", ".assert", ".four"};

// Directives of other simulators about listings and scripts, which change no result.
constexpr std::string_view directives_without_effect[] = {".width", ".list", ".nolist", ".backanno", ".csparam"};

constexpr std::string_view commands_that_change_the_circuit[] = {"alter",  "altermod", "alterparam", "reset",     "foreach", "while",
                                                                 "repeat", "dowhile",  "if",         "source",    "load",    "stop",
                                                                 "step",   "resume",   "remcirc",    "mc_source", "option"};

template <class Words>
bool contains_word(const Words& words, std::string_view word) {
    return std::ranges::find(words, word) != std::end(words);
}

/// The names of all directives, with the dot.
std::vector<std::string> directive_names() {
    std::vector<std::string> out(std::begin(structural_directives), std::end(structural_directives));
    for (const auto* a : analyses) out.push_back("." + std::string(a->name));
    out.insert(out.end(), std::begin(circuit_directives), std::end(circuit_directives));
    return out;
}

bool is_directive(std::string_view word) {
    static const auto names = directive_names();
    return std::ranges::find(names, word) != names.end();
}

/// The device that other simulators have for a letter that is unknown here; "" if there is none.
std::string_view foreign_device(char letter) {
    constexpr std::pair<char, std::string_view> names[] = {{'a', "code model of XSPICE"},
                                                           {'j', "junction field-effect transistor"},
                                                           {'n', "compiled Verilog-A model"},
                                                           {'o', "lossy line"},
                                                           {'p', "coupled lines"},
                                                           {'t', "lossless line"},
                                                           {'u', "RC line or gate"},
                                                           {'y', "device of Xyce"},
                                                           {'z', "MESFET"}};
    const auto* found = std::ranges::find(names, letter, &std::pair<char, std::string_view>::first);
    return found == std::end(names) ? "" : found->second;
}

bool is_element_letter(char letter) { return letter == 'x' || find_device_kind(letter) != nullptr; }

/// True for the values that may contain blanks: the expressions of sources and of a capacitor's charge. See split_element().
bool is_long_value(char letter, std::string_view name) {
    const auto* kind = find_device_kind(letter);
    return kind != nullptr && std::find(kind->expression_names.begin(), kind->expression_names.end(), name) != kind->expression_names.end();
}

/// The path of a file that the file `includer` calls `name`.
std::string resolved_path(const std::string& includer, std::string_view name) {
    return (std::filesystem::path(includer).parent_path() / std::filesystem::path(name)).lexically_normal().string();
}

class NetlistReader {
    using Opener = Netlist::FileOpener;
    struct Source {
        std::string path, section;  // section "": the complete file
        bool operator==(const Source&) const = default;
    };
    ParsedNetlist& out_;
    Refusals& refusals_;
    const Opener& open_;
    // Texts of the files by path, kept because a library is often read for several sections.
    std::map<std::string, std::shared_ptr<const std::string>> texts_;
    std::vector<Source> open_files_;  // files being read, outermost first
    SubcktDef* body_;                 // the definition being read
    SubcktDef* file_body_;  // the definition that was being read when the present file began; .ends in this file must not close it
    std::size_t bytes_read_ = 0, files_opened_ = 0;
    std::size_t subcircuit_depth_ = 0;               // number of .subckt lines that are not yet closed
    std::vector<const Statement*> script_analyses_;  // of .control
    bool ended_ = false;                             // true after .end, until the present file is left
    CornerSelector corner_;

public:
    NetlistReader(ParsedNetlist& out, Refusals& refusals, const Opener& open, std::string corner)
        : out_(out), refusals_(refusals), open_(open), body_(&out.top), file_body_(body_), corner_(std::move(corner)) {}

    /// Reads the netlist, then checks that a library had the requested corner. An error that leaves the meaning of the following lines
    /// clear is added to the refusals; any other one is returned.
    Result<void> read_all(std::string_view text, const std::string& path) {
        TRY(read(text, path, ""));
        remove_repeated_analyses();
        return corner_.check_found(path);
    }

    /// Reads a file, or one section of a library. The first call reads the main file, which begins with the title.
    Result<void> read(std::string_view text, const std::string& path, const std::string& section) {
        bytes_read_ += text.size();
        if (bytes_read_ > max_text_bytes)
            return error_at({path}, "the netlist and its included files exceed the limit of {} MB", max_text_bytes >> 20);
        LogicalLineReader lines(text, std::make_shared<const std::string>(path));
        if (open_files_.empty()) TRY(take_title(lines));
        open_files_.push_back({path, section});
        if (!section.empty()) out_.libraries.insert(path);
        SubcktDef* const outer_body = std::exchange(file_body_, body_);
        auto ok = section.empty() ? statements(lines) : read_section(lines, section);
        if (ok && body_ != file_body_) ok = error_at(body_->head->location(0), ".subckt {} is not closed by .ends", body_->name);
        file_body_ = outer_body;
        open_files_.pop_back();
        ended_ = false;
        return ok;
    }

private:
    /// Keeps the error of a statement for later, so that the following statements are also read.
    Result<void> keep(Result<void> ok, Refusals::Kind kind = Refusals::Kind::other) {
        if (!ok) refusals_.add(ok.error(), kind);
        return {};
    }

    Result<void> take_title(LogicalLineReader& lines) {
        auto title = TRY(lines.title());
        out_.title = std::string(trimmed(title));
        if (looks_like_statement(out_.title))
            out_.warnings.push_back(error_at({out_.file, 1, 1}, "the first line is the title, so '{}' is not read as a statement",
                                             std::string_view(out_.title).substr(0, 40)));
        return {};
    }

    /// True if a title looks like an element line, such as "R1 a b 1k", or like a directive.
    static bool looks_like_statement(std::string_view title) {
        std::vector<std::string> words;
        for (std::size_t at = title.find_first_not_of(" \t"); at != std::string_view::npos && words.size() < 5;) {
            const auto end = std::min(title.find_first_of(" \t", at), title.size());
            words.push_back(lower(title.substr(at, end - at)));
            at = title.find_first_not_of(" \t", end);
        }
        if (words.empty()) return false;
        if (words[0][0] == '.') return true;
        if (words.size() < 4 || words[0].size() < 2 || !is_element_letter(words[0][0])) return false;
        if (!std::any_of(words[0].begin(), words[0].end(), [](char c) { return c >= '0' && c <= '9'; })) return false;
        return words.size() == 5 || parse_number(words[3]) || words[3].find_first_of("{'=") != std::string::npos;
    }

    Result<void> statements(LogicalLineReader& lines) {
        LogicalLine line;
        while (!ended_) {
            const auto more = TRY(lines.next(line));
            if (!more) return {};
            TRY(statement(lines, std::move(line)));
        }
        return {};
    }

    Result<void> statement(LogicalLineReader& lines, LogicalLine line) {
        if (out_.statements.size() >= max_elements)
            return error_at(line.location(), "the netlist exceeds the limit of {} statements", max_elements);
        if (line.text[0] != '.') return keep(element(std::move(line)));
        const std::string word = lower(std::string_view(line.text).substr(0, line.text.find_first_of(" \t('\"{")));
        if (word == ".end") return ended_ = true, Result<void>();
        if (word == ".control") return control(lines, line);
        if (word == ".param" || word == ".global_param") return keep(parameters(std::move(line)));
        if (word == ".func") return keep(function(std::move(line)));
        if (word == ".model") return keep(model(std::move(line)));
        if (word == ".subckt") return subcircuit(std::move(line));
        if (word == ".ends") return end_of_subcircuit(std::move(line));
        if (word == ".include" || word == ".incl" || word == ".inc") return include(std::move(line));
        if (word == ".lib") return library(lines, std::move(line));
        if (word == ".endl" || word == ".endc")
            return error_at(line.location(), "{} without {}", word, word == ".endl" ? ".lib" : ".control");
        if (word == ".ic" || word == ".nodeset") return keep(store_directive(std::move(line), body_->ics));
        if (contains_word(directives_without_effect, word)) return {};
        if (!is_directive(word)) return keep(unknown(word, line.location()), Refusals::Kind::directive);
        if (body_->head) return error_at(line.location(), "{} is not allowed inside .subckt {}; move it outside", word, body_->name);
        return keep(top_level_directive(word, std::move(line)));
    }

    Result<void> top_level_directive(std::string_view word, LogicalLine line) {
        if (word == ".title") return out_.title = trimmed(std::string_view(line.text).substr(word.size())), Result<void>();
        if (word == ".global") return global(std::move(line));
        if (word == ".temp") return store_directive(std::move(line), out_.temperatures);
        if (word.starts_with(".opt")) {
            out_.options.push_back(&store(TRY(split_element(std::move(line), nullptr))));
            return {};
        }
        return store_directive(std::move(line), out_.directives);
    }

    static Error unknown(std::string_view word, SourceLocation location) {
        if (word == ".if" || word == ".elseif" || word == ".else" || word == ".endif")
            return error_at(location, "{}: conditional parts of a netlist are not supported", word);
        for (const auto& [old_name, new_name] : renamed_directives)
            if (word == old_name) return error_at(location, "{} is now {}", old_name, new_name);
        return error_at(location, "unknown statement '{}'{}", word, did_you_mean(word, directive_names()));
    }

    Statement& store(Statement s) { return out_.statements.emplace_back(std::move(s)); }

    Result<void> store_directive(LogicalLine line, std::vector<const Statement*>& list) {
        list.push_back(&store(TRY(split_directive(std::move(line)))));
        return {};
    }

    Result<void> element(LogicalLine line) {
        if (!is_element_letter(line.text[0])) return refuse_letter(line);
        auto read = TRY(split_element(std::move(line), is_long_value));
        TRY(check_duplicates(read));
        body_->elements.push_back(&store(std::move(read)));
        warn_about_units(*body_->elements.back(), out_.warnings);
        return {};
    }

    Result<void> refuse_letter(const LogicalLine& line) {
        const std::string name = line.text.substr(0, std::min<std::size_t>(line.text.find_first_of(" \t"), 20));
        const auto device = foreign_device(name[0]);
        refusals_.add_device(error_at(line.location(), "'{}': unknown element letter {}{}; known are {}", name, name[0],
                                      device.empty() ? "" : fmt::format(" ({})", device), element_letters()),
                             fmt::format("letter {}", name[0]), name);
        return {};
    }

    static Result<void> check_duplicates(const Statement& s) {
        if (s.words.empty()) return error_at(s.line.location(), "the name before '=' is missing");
        std::vector<std::string_view> names;
        for (const auto& pair : s.pairs) names.push_back(s.text(pair.name));
        std::sort(names.begin(), names.end());
        const auto twice = std::adjacent_find(names.begin(), names.end());
        if (twice == names.end()) return {};
        SourceLocation location;
        for (const auto& pair : s.pairs)
            if (s.text(pair.name) == *twice) location = s.location(pair.name);
        return error_at(location, "{}: {} is given twice", s.text(0), *twice);
    }

    // ---- .param, .func, .model, .global ----

    Result<void> parameters(LogicalLine line) {
        const Statement& s = store(TRY(split_assignments(std::move(line))));
        if (s.pairs.empty()) return error_at(s.line.location(), "{}: expected name=value", s.text(0));
        for (const auto& pair : s.pairs) {
            const std::string name(s.text(pair.name));
            if (const auto open = name.find('('); open != std::string::npos) {
                TRY(define(name, std::string(s.text(pair.value)), s.location(pair.name)));
                continue;
            }
            const auto [at, is_new] = body_->parameters.insert_or_assign(name, WordRef{&s, pair.value});
            if (!is_new)
                out_.warnings.push_back(error_at(s.location(pair.name), "{} {} is given twice; this value is used", s.text(0), name));
        }
        return {};
    }

    /// Reads .func f(x, y) {text}. An '=' before the text is optional, and the text may be in quotes instead of braces.
    Result<void> function(LogicalLine line) {
        const std::string_view text = line.text;
        constexpr std::size_t after_keyword = 5;  // length of ".func"
        const auto from = std::min(text.find_first_not_of(" \t", after_keyword), text.size()), close = text.find(')', from);
        if (close == std::string_view::npos) return bad_input(".func: expected a function such as f(x) {2*x}", line.location(from));
        auto body = trimmed(text.substr(close + 1));
        if (body.starts_with('=')) body = trimmed(body.substr(1));
        const bool is_enclosed = body.size() >= 2 && ((body[0] == '{' && body.back() == '}') || (body[0] == '\'' && body.back() == '\''));
        if (is_enclosed && body[0] == '\'') body = body.substr(1, body.size() - 2);
        if (body.empty()) return bad_input(".func: the expression is missing; write one such as f(x) {2*x}", line.location(close));
        return define(std::string(text.substr(from, close + 1 - from)), std::string(body), line.location(from));
    }

    /// Defines a function; `head` is its name with its arguments: "f(x, y)".
    Result<void> define(std::string_view head, std::string text, SourceLocation location) {
        const auto open = head.find('(');
        const std::string name(trimmed(head.substr(0, open)));
        if (open == std::string_view::npos || name.empty() || head.back() != ')')
            return error_at(location, "'{}' is not a function with arguments; write f(x,y)", head);
        ExpressionScope::Function f{{}, std::move(text)};
        for (auto rest = trimmed(head.substr(open + 1, head.size() - open - 2)); !rest.empty();) {
            const auto comma = std::min(rest.find(','), rest.size());
            f.arguments.emplace_back(trimmed(rest.substr(0, comma)));
            rest.remove_prefix(std::min(comma + 1, rest.size()));
        }
        if (f.arguments.size() > 100) return error_at(location, "{}() has more than 100 arguments", name);
        body_->functions.insert_or_assign(name, std::move(f));
        return {};
    }

    Result<void> model(LogicalLine line) {
        auto read = TRY(split_element(std::move(line), nullptr));
        if (read.words.size() < 3)
            return error_at(read.location(read.words.size()), ".model: expected a name and a type, such as .model nm nmos (vto=0.5)");
        join_values(read);
        const std::string name(read.text(1));
        if (const auto known = body_->models.find(name); known != body_->models.end()) {
            const auto place = location_text(*known->second);
            if (known->second->line.text != read.line.text)
                return error_at(read.location(1), "model '{}' is already defined at {}", name, place);
            out_.warnings.push_back(error_at(read.location(1), "model '{}' is also defined at {}, in the same words", name, place));
            return {};
        }
        body_->models.emplace(name, &store(std::move(read)));
        return {};
    }
    /// Takes the words "name value" after the type as name=value, as SPICE does, except for dev and lot, which are words.
    static void join_values(Statement& s) {
        const auto is_name = [&](std::size_t k) { return s.words[k].kind == Word::Kind::plain && std::isalpha(s.text(k)[0]) != 0; };
        const auto is_value = [&](std::size_t k) {
            return k < s.words.size() && (s.words[k].kind == Word::Kind::expression || std::isalpha(s.text(k)[0]) == 0);
        };
        std::vector<Word> rest(s.words.begin(), s.words.begin() + 3);
        for (std::size_t k = 3; k < s.words.size(); ++k) {
            if (find_tolerance(s.text(k)) != nullptr && k + 1 < s.words.size())
                rest.push_back(s.words[k]), rest.push_back(s.words[++k]);
            else if (is_name(k) && is_value(k + 1))
                s.pairs.push_back({s.words[k], s.words[k + 1]}), ++k;
            else
                rest.push_back(s.words[k]);
        }
        s.words = std::move(rest);
    }
    static std::string location_text(const Statement& s) {
        const SourceLocation p = s.line.location();
        return fmt::format("{}:{}", p.file, p.line);
    }

    Result<void> global(LogicalLine line) {
        auto read = TRY(split_directive(std::move(line)));
        for (std::size_t k = 1; k < read.words.size(); ++k) out_.globals.emplace(read.text(k));
        return {};
    }

    // ---- .subckt ----

    /// Reads a .subckt line. The following lines belong to its body until .ends.
    Result<void> subcircuit(LogicalLine line) {
        auto read = TRY(split_element(std::move(line), nullptr));
        if (read.words.size() < 2) return error_at(read.location(1), ".subckt: expected a name and nodes");
        TRY(check_duplicates(read));
        if (++subcircuit_depth_ > max_definition_depth)
            return error_at(read.line.location(), "definitions of subcircuits are nested deeper than the limit of {}",
                            max_definition_depth);
        const std::string name(read.text(1));
        auto& body = body_->subcircuits[name];
        if (body) return error_at(read.location(1), "subcircuit '{}' is already defined at {}", name, location_text(*body->head));
        body = std::make_unique<SubcktDef>();
        body->name = name, body->outer = body_, body->head = &store(std::move(read));
        body_ = body.get();
        return read_head(*body);
    }

    /// Reads the ports and parameters of the .subckt line.
    Result<void> read_head(SubcktDef& body) {
        const Statement& s = *body.head;
        std::set<std::string_view> seen;
        for (std::size_t k = 2; k < s.words.size(); ++k) {
            const auto port = s.text(k);
            if (port == "params:") continue;
            if (!seen.insert(port).second) return error_at(s.location(k), ".subckt {}: node '{}' is given twice", body.name, port);
            body.ports.emplace_back(port);
        }
        for (const auto& pair : s.pairs) {
            auto name = s.text(pair.name);
            if (name.starts_with("params:")) name.remove_prefix(7);
            body.defaults.insert_or_assign(std::string(name), WordRef{&s, pair.value});
        }
        return {};
    }

    Result<void> end_of_subcircuit(LogicalLine line) {
        auto read = TRY(split_directive(std::move(line)));
        if (body_ == file_body_) return error_at(read.line.location(), ".ends without .subckt");
        if (read.words.size() > 1 && read.text(1) != body_->name)
            return error_at(read.location(1), ".ends {} does not match .subckt {}", read.text(1), body_->name);
        body_ = body_->outer;
        --subcircuit_depth_;
        return {};
    }

    // ---- .control, .include, .lib ----

    /// Reads a script of ngspice. Its analyses, measurements and prints are taken as directives; commands that only show results have no
    /// effect. A command that changes the circuit or repeats others ends the reading, since what follows would mean something else.
    Result<void> control(LogicalLineReader& lines, const LogicalLine& from) {
        std::vector<std::string> ignored, vectors;  // vectors: those that the script computes
        std::string analysis;
        for (LogicalLine line; lines.next_command(line);) {
            for (const std::string_view comment : {" ;", " $ "})
                if (const auto at = line.text.find(comment); at != std::string::npos) line.text.resize(at);
            const std::string word = line.text.substr(0, line.text.find_first_of(" \t("));
            if (word == ".." || word == "." || word[1] == '*' || word[1] == '#' || word[1] == '$' || word[1] == ';') continue;
            if (line.text.starts_with("..endc")) return warn_of_ignored_commands(ignored, from);
            if (contains_word(commands_that_change_the_circuit, word.substr(1))) {
                out_.warnings.push_back(
                    error_at(line.location(1), ".control: '{}' is not supported; the rest of this script is not run", word.substr(1)));
                TRY(warn_of_ignored_commands(ignored, from));
                return lines.skip_past(".endc") ? Result<void>() : unclosed_control(from);
            }
            const bool is_analysis = find_analysis(word.substr(1)) != nullptr;
            if (is_analysis) analysis = word.substr(1);
            if (word == ".print") line.text.insert(6, " " + analysis);
            if (word == ".fourier") {
                line.text.erase(5, 3);  // ".four"
                TRY(store_directive(std::move(line), out_.directives));
                continue;
            }
            if (word == ".let") vectors.emplace_back(trimmed(std::string_view(line.text).substr(4, line.text.find('=') - 4)));
            if (word == ".meas" || word == ".measure") {
                if (const auto redirection = line.text.find(" >"); redirection != std::string::npos) line.text.resize(redirection);
                if (const auto vector = vector_in(line.text, vectors); !vector.empty()) {
                    out_.warnings.push_back(
                        error_at(line.location(1), "{} is left out: the script computes '{}'", measure_name(line.text), vector));
                    continue;
                }
            }
            if (is_analysis || word == ".meas" || word == ".measure" || word == ".print") {
                TRY(store_directive(std::move(line), out_.directives));
                if (is_analysis) script_analyses_.push_back(out_.directives.back());
            } else if (word != ".run" && std::find(ignored.begin(), ignored.end(), word.substr(1)) == ignored.end()) {
                ignored.push_back(word.substr(1));
            }
        }
        return unclosed_control(from);
    }
    /// The first of these vectors that is a word of a command; "" if there is none.
    static std::string_view vector_in(std::string_view command, const std::vector<std::string>& vectors) {
        for (const std::string_view vector : vectors)
            for (auto at = command.find(vector); at != std::string_view::npos; at = command.find(vector, at + 1)) {
                const auto is_end = [&](std::size_t k) {
                    return k >= command.size() || std::string_view(" \t=()").find(command[k]) != std::string_view::npos;
                };
                if (is_end(at - 1) && is_end(at + vector.size())) return vector;
            }
        return "";
    }
    /// ".meas NAME" of ".meas tran NAME ..."
    static std::string measure_name(std::string_view command) {
        std::vector<std::string> words;
        for (auto at = command.find_first_not_of(" \t"); at != std::string_view::npos && words.size() < 3;) {
            const auto end = std::min(command.find_first_of(" \t", at), command.size());
            words.emplace_back(command.substr(at, end - at));
            at = command.find_first_not_of(" \t", end);
        }
        return words[0] + " " + words.back();
    }
    static Error unclosed_control(const LogicalLine& from) { return error_at(from.location(), ".control is not closed by .endc"); }
    Result<void> warn_of_ignored_commands(const std::vector<std::string>& commands, const LogicalLine& from) {
        if (!commands.empty())
            out_.warnings.push_back(error_at(from.location(), ".control: these commands have no effect here: {}", joined(commands)));
        return {};
    }

    /// Removes each analysis of a script that the netlist also has as a directive.
    void remove_repeated_analyses() {
        for (const auto* script : script_analyses_) {
            const bool is_repeated = std::ranges::any_of(out_.directives, [&](const Statement* s) {
                return s != script && std::ranges::find(script_analyses_, s) == script_analyses_.end() && s->line.text == script->line.text;
            });
            if (is_repeated) std::erase(out_.directives, script);
        }
    }

    Result<void> include(LogicalLine line) {
        auto read = TRY(split_directive(std::move(line)));
        if (read.words.size() != 2)
            return error_at(read.location(read.words.size() < 2 ? 1 : 2), ".include: expected one file; put a name with blanks in quotes");
        return open(unquoted(read.text(1)), "", read.location(1));
    }

    /// Reads ".lib file section", or skips the section that ".lib section" begins.
    Result<void> library(LogicalLineReader& lines, LogicalLine line) {
        auto read = TRY(split_directive(std::move(line)));
        if (read.words.size() == 3) return open(unquoted(read.text(1)), lower(unquoted(read.text(2))), read.location(1));
        const bool is_file = read.words.size() == 2 && unquoted(read.text(1)) != read.text(1);
        if (read.words.size() != 2 || is_file)
            return error_at(read.location(1), ".lib: expected a file and a section; to read a complete file, use .include");
        return skip_section(lines, read.line.location());
    }

    /// Skips the lines of a section up to .endl; only ".lib file section" reads them. `from` is the location of the section's first line.
    Result<void> skip_section(LogicalLineReader& lines, SourceLocation from) {
        LogicalLine line;
        while (true) {
            const auto more = TRY(lines.next(line));
            if (!more) return error_at(from, ".lib with one word begins a section, but .endl is missing; to read a file, use .include");
            if (lower(std::string_view(line.text).substr(0, 5)) == ".endl") return {};
        }
    }

    /// Reads an included file, or a section of a library. `location` is that of the line that names it.
    Result<void> open(std::string_view name, std::string section, SourceLocation location) {
        ++files_opened_;
        const std::string path = resolved_path(open_files_.back().path, name);
        if (open_files_.size() > max_include_depth)
            return error_at(location, "included files are nested deeper than the limit of {}", max_include_depth);
        if (files_opened_ > max_elements) return error_at(location, "more than {} files are included", max_elements);
        auto& text = texts_[path];
        if (!text) {
            auto opened = open_(path);
            if (!opened) return keep(error_at(location, "'{}': {}", name, opened.error().message));
            text = std::make_shared<const std::string>(std::move(*opened));
        }
        const auto shared_text = text;
        const bool is_outside_library =
            std::all_of(open_files_.begin(), open_files_.end(), [](const Source& s) { return s.section.empty(); });
        // The corner does not replace sections that are named inside a library.
        if (is_outside_library && !section.empty()) section = corner_.select_section(section, name, *shared_text);
        if (std::find(open_files_.begin(), open_files_.end(), Source{path, section}) != open_files_.end())
            return error_at(location, "'{}' includes itself", name);
        auto ok = read(*shared_text, path, section);
        if (!ok && ok.error().location.file.empty()) return bad_input(ok.error().message, std::move(location));
        return ok;
    }

    /// Reads the lines between ".lib section" and ".endl" of a library.
    Result<void> read_section(LogicalLineReader& lines, const std::string& section) {
        std::vector<std::string> known;
        LogicalLine line;
        while (true) {
            const auto more = TRY(lines.next(line));
            if (!more)
                return bad_input(
                    fmt::format("library '{}' has no section '{}'{}", open_files_.back().path, section, did_you_mean(section, known)));
            if (lower(std::string_view(line.text).substr(0, 4)) != ".lib") continue;
            const auto head = TRY(split_directive(std::move(line)));
            if (head.words.size() != 2) continue;
            known.emplace_back(lower(unquoted(head.text(1))));
            if (known.back() == section) return until_endl(lines, head.line.location());
        }
    }

    /// Reads statements up to .endl.
    Result<void> until_endl(LogicalLineReader& lines, const SourceLocation& from) {
        LogicalLine line;
        while (!ended_) {
            const auto more = TRY(lines.next(line));
            if (!more) break;
            if (line.text.starts_with(".endl")) return {};
            TRY(statement(lines, std::move(line)));
        }
        return error_at(from, ".lib is not closed by .endl");
    }
};

}  // namespace

Result<void> read_netlist(const std::string& text, const std::string& file, const Netlist::FileOpener& open, const std::string& corner,
                          ParsedNetlist& out, Refusals& refusals) {
    out.file = file;
    return NetlistReader(out, refusals, open, corner).read_all(text, file);
}

}  // namespace corpuscle::circuit
