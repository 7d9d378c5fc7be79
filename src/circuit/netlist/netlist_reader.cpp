// Parses the statements of a netlist, of the files that it includes and of sections of libraries.

#include "circuit/analyses.hpp"
#include "circuit/netlist/definition_reader.hpp"
#include "circuit/netlist/dialects.hpp"
#include "circuit/netlist/element_line.hpp"
#include "circuit/netlist/included_files.hpp"
#include "circuit/netlist/open_conditions.hpp"
#include "circuit/netlist/scope.hpp"
#include "circuit/netlist/script/control_script.hpp"
#include "circuit/netlist/script/repeated_analyses.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::size_t max_definition_depth = 200;  // of nested .subckt

class NetlistReader {
    ParsedNetlist& out_;
    Refusals& refusals_;
    IncludedFiles files_;
    SubcktDef* body_;       // the definition being read
    SubcktDef* file_body_;  // the definition that was being read when the present file began; .ends in this file must not close it
    std::size_t subcircuit_depth_ = 0;               // number of .subckt lines that are not yet closed
    std::vector<const Statement*> script_analyses_;  // of .control
    OpenConditions conditions_;                      // those of .if around the present line
    bool are_scripts_stopped_ = false;               // one of them ended early
    bool ended_ = false;                             // true after .end, until the present file is left

public:
    NetlistReader(ParsedNetlist& out, Refusals& refusals, const Netlist::FileOpener& open, std::string corner)
        : out_(out), refusals_(refusals), files_(open, refusals, std::move(corner)), body_(&out.top), file_body_(body_) {}

    /// Reads the netlist, then checks that a library had the requested corner. An error that leaves the meaning of the following lines
    /// clear is added to the refusals; any other one is returned.
    Result<void> read_all(std::string_view text, const std::string& path) {
        TRY(read(text, {path, ""}));
        remove_repeated_analyses(out_, script_analyses_);
        define_stepped_parameters();
        warn_about_dialect(out_);
        return files_.check_corner(path);
    }

private:
    /// Reads one directive.
    using Read = Result<void> (NetlistReader::*)(LogicalLineReader& lines, LogicalLine line);
    enum class Place { anywhere, top_level, not_in_if, top_level_not_in_if };
    /// Whether the lines after an error are read, too.
    enum class AfterError { reads_on, ends };
    struct Row {
        std::string_view name;
        Read read;
        Place place = Place::anywhere;
        AfterError after_error = AfterError::reads_on;
    };
    static std::span<const Row> rows();

    static const Row* find_row(std::string_view name) {
        static const Row of_analysis{"", &NetlistReader::output, Place::top_level};
        const auto all = rows();
        const auto found = std::ranges::find(all, name, &Row::name);
        if (found != all.end()) return &*found;
        return find_analysis(name.substr(1)) != nullptr ? &of_analysis : nullptr;
    }
    /// The names of all directives, with the dot.
    static std::vector<std::string> directive_names() {
        std::vector<std::string> out;
        for (const auto& row : rows()) out.emplace_back(row.name);
        for (const auto* a : analyses) out.push_back("." + std::string(a->name));
        return out;
    }

    /// Reads a file, or one section of a library. The first call reads the main file, which begins with the title.
    Result<void> read(std::string_view text, const FileSection& source) {
        TRY(files_.enter(source, text.size()));
        LogicalLineReader lines(text, std::make_shared<const std::string>(source.path));
        if (files_.is_main()) TRY(take_title(lines));
        if (!source.section.empty()) out_.libraries.insert(source.path);
        SubcktDef* const outer_body = std::exchange(file_body_, body_);
        const auto outer_conditions = conditions_.enter_file();
        auto ok = source.section.empty() ? statements(lines) : section(lines, source);
        if (ok) ok = conditions_.check_closed();
        conditions_.leave_file(outer_conditions);
        if (ok && body_ != file_body_) ok = error_at(body_->head->location(0), ".subckt {} is not closed by .ends", body_->name);
        file_body_ = outer_body;
        files_.leave();
        ended_ = false;
        return ok;
    }

    Result<void> take_title(LogicalLineReader& lines) {
        auto title = TRY(lines.title());
        out_.title = std::string(trimmed(title));
        TRY(refuse_title_of_other_language(out_));
        if (looks_like_statement(out_.title))
            out_.warnings.push_back(error_at({out_.file, 1, 1}, "the first line is the title, so '{}' is not read as a statement",
                                             std::string_view(out_.title).substr(0, 40)));
        return {};
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

    /// Reads the statements between ".lib section" and ".endl" of a library.
    Result<void> section(LogicalLineReader& lines, const FileSection& source) {
        const auto from = TRY(find_section(lines, source));
        LogicalLine line;
        while (!ended_) {
            const auto more = TRY(lines.next(line));
            if (!more) break;
            if (line.text.starts_with(".endl")) return {};
            TRY(statement(lines, std::move(line)));
        }
        return error_at(from, ".lib is not closed by .endl");
    }

    static Error too_many_statements(SourceLocation location) {
        return error_at(std::move(location), "the netlist exceeds the limit of {} statements", max_elements);
    }

    Result<void> statement(LogicalLineReader& lines, LogicalLine line) {
        if (out_.statements.size() >= max_elements) return too_many_statements(line.location());
        if (line.text[0] != '.') {
            TRY(refuse_other_language(line, out_.title));
            if (is_simulator_line(line.text)) return without_effect_here(lines, std::move(line));
            warn_about_drawing_notes(line);
            return keep(element(std::move(line)));
        }
        const std::string word = lower(std::string_view(line.text).substr(0, line.text.find_first_of(" \t('\"{")));
        const auto* row = find_row(word);
        if (row == nullptr) return keep(unknown(word, line.location()), Refusals::Kind::directive);
        if (conditions_.is_open() && (row->place == Place::not_in_if || row->place == Place::top_level_not_in_if))
            return error_at(line.location(), "{} is not allowed inside .if; move it outside{}", word,
                            row->read == &NetlistReader::parameters ? ", and write .param x={condition ? a : b}" : "");
        if ((row->place == Place::top_level || row->place == Place::top_level_not_in_if) && body_->head)
            return error_at(line.location(), "{} is not allowed inside .subckt {}; move it outside", word, body_->name);
        const bool is_missing = row->read == &NetlistReader::missing || row->read == &NetlistReader::missing_block;
        auto ok = (this->*row->read)(lines, std::move(line));
        if (row->after_error == AfterError::ends) return ok;
        return keep(std::move(ok), is_missing ? Refusals::Kind::directive : Refusals::Kind::other);
    }

    /// Warns once that notes such as $X=100 have no effect.
    void warn_about_drawing_notes(const LogicalLine& line) {
        if (line.drawing_note.empty() || !out_.marks.insert("$").second) return;
        out_.warnings.push_back(error_at(line.location(),
                                         "'{}': notes of CDL that begin with $ have no effect, nor have those of other lines",
                                         trimmed(line.drawing_note)));
    }

    /// Keeps the error of a statement for later, so that the following statements are also read.
    Result<void> keep(Result<void> ok, Refusals::Kind kind = Refusals::Kind::other) {
        if (!ok) present_refusals().add(ok.error(), kind);
        return {};
    }
    Refusals& present_refusals() { return conditions_.is_open() ? body_->branch_refusals[conditions_.branch()] : refusals_; }

    static Error unknown(std::string_view word, SourceLocation location) {
        for (const auto& [old_name, new_name] : renamed_directives)
            if (word == old_name) return error_at(location, "{} is now {}", old_name, new_name);
        return error_at(location, "unknown statement '{}'{}", word, did_you_mean(word, directive_names()));
    }

    Statement& store(Statement s) {
        s.condition = conditions_.branch();
        return out_.statements.emplace_back(std::move(s));
    }

    Result<void> store_directive(LogicalLine line, std::vector<const Statement*>& list) {
        list.push_back(&store(TRY(split_directive(std::move(line)))));
        return {};
    }

    Result<void> element(LogicalLine line) {
        auto read = TRY(split_element_line(std::move(line), present_refusals()));
        if (!read) return {};
        body_->elements.push_back(&store(std::move(*read)));
        warn_about_units(*body_->elements.back(), out_.warnings);
        return {};
    }

    // ---- directives ----

    Result<void> output(LogicalLineReader&, LogicalLine line) { return store_directive(std::move(line), out_.directives); }
    Result<void> without_effect(LogicalLineReader&, LogicalLine line) {
        out_.marks.insert(line.text.substr(0, line.text.find_first_of(" \t")));
        return {};
    }
    Result<void> without_effect_here(LogicalLineReader&, LogicalLine line) {
        const auto word = line.text.substr(0, line.text.find_first_of(" \t('\"{"));
        out_.warnings.push_back(error_at(line.location(), "{} has no effect here", word));
        return {};
    }
    Result<void> missing(LogicalLineReader&, LogicalLine line) {
        const auto word = line.text.substr(0, line.text.find_first_of(" \t('\"{"));
        return error_at(line.location(), "{} is not supported{}", word, remedy_for_missing(word));
    }
    /// Refuses a block of lines that are data or a program, and skips it.
    Result<void> missing_block(LogicalLineReader& lines, LogicalLine line) {
        const auto from = line.location();
        const auto word = line.text.substr(0, line.text.find_first_of(" \t('\"{"));
        const auto end = ".end" + word.substr(1);
        while (true) {
            const auto more = TRY(lines.next(line));
            if (!more) return error_at(from, "{} is not closed by {}", word, end);
            if (lower(std::string_view(line.text).substr(0, end.size())) == end) break;
        }
        return error_at(from, "{} is not supported{}", word, remedy_for_missing(word));
    }
    /// .alter of HSPICE begins the changes for another run.
    Result<void> alter(LogicalLineReader&, LogicalLine line) {
        out_.warnings.push_back(error_at(line.location(),
                                         ".alter is not supported: only the circuit before it is simulated, and the lines "
                                         "after it are not read; use .step or --set"));
        return ended_ = true, Result<void>();
    }
    Result<void> end(LogicalLineReader&, LogicalLine) { return ended_ = true, Result<void>(); }
    Result<void> initial_voltages(LogicalLineReader&, LogicalLine line) { return store_directive(std::move(line), body_->ics); }
    Result<void> temperature(LogicalLineReader&, LogicalLine line) { return store_directive(std::move(line), out_.temperatures); }
    Result<void> options(LogicalLineReader&, LogicalLine line) {
        out_.options.push_back(&store(TRY(split_element(std::move(line), nullptr))));
        return {};
    }
    Result<void> set_values(LogicalLineReader&, LogicalLine line) {
        out_.set_lines.push_back(&store(TRY(split_element(std::move(line), nullptr))));
        return {};
    }
    Result<void> title(LogicalLineReader&, LogicalLine line) {
        out_.title = trimmed(std::string_view(line.text).substr(std::string_view(".title").size()));
        return {};
    }
    Result<void> global(LogicalLineReader&, LogicalLine line) {
        auto read = TRY(split_directive(std::move(line)));
        for (std::size_t k = 1; k < read.words.size(); ++k) out_.globals.emplace(read.text(k));
        return {};
    }
    Result<void> end_without_begin(LogicalLineReader&, LogicalLine line) {
        const auto word = line.text.substr(0, line.text.find_first_of(" \t('\"{"));
        return error_at(line.location(), "{} without {}", word, word == ".endl" ? ".lib" : ".control");
    }

    Result<void> parameters(LogicalLineReader&, LogicalLine line) {
        if (line.text.starts_with(".global_param")) out_.marks.insert(".global_param");
        return read_parameters(store(TRY(split_assignments(std::move(line)))), *body_, out_.warnings);
    }
    Result<void> function(LogicalLineReader&, LogicalLine line) {
        return read_function(store(Statement{std::move(line), {}, {}}).line, *body_, out_.warnings);
    }
    Result<void> model(LogicalLineReader&, LogicalLine line) {
        auto read = TRY(split_element(std::move(line), nullptr));
        read.condition = conditions_.branch();
        return read_model(std::move(read), *body_, out_);
    }

    Result<void> branch_line(LogicalLineReader&, LogicalLine line) {
        return conditions_.begin_branch(std::move(line), *body_, out_.statements);
    }
    Result<void> endif_line(LogicalLineReader&, LogicalLine line) { return conditions_.close(line.location()); }

    /// Reads a .subckt line. The following lines belong to its body until .ends.
    Result<void> subcircuit(LogicalLineReader&, LogicalLine line) {
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
        return read_subcircuit_head(*body);
    }
    Result<void> end_of_subcircuit(LogicalLineReader&, LogicalLine line) {
        auto read = TRY(split_directive(std::move(line)));
        if (body_ == file_body_) return error_at(read.line.location(), ".ends without .subckt");
        if (read.words.size() > 1 && read.text(1) != body_->name)
            return error_at(read.location(1), ".ends {} does not match .subckt {}", read.text(1), body_->name);
        body_ = body_->outer;
        --subcircuit_depth_;
        return {};
    }

    Result<void> include(LogicalLineReader&, LogicalLine line) {
        auto read = TRY(split_directive(std::move(line)));
        if (read.words.size() != 2)
            return error_at(read.location(read.words.size() < 2 ? 1 : 2), ".include: expected one file; put a name with blanks in quotes");
        return open(unquoted(read.text(1)), "", read.location(1));
    }

    /// Reads ".lib file section" or ".lib file", or skips the section that ".lib section" begins.
    Result<void> library(LogicalLineReader& lines, LogicalLine line) {
        auto read = TRY(split_directive(std::move(line)));
        if (read.words.size() == 3) return open(unquoted(read.text(1)), lower(unquoted(read.text(2))), read.location(1));
        if (read.words.size() == 2 && names_file(read.text(1))) return open(unquoted(read.text(1)), "", read.location(1));
        if (read.words.size() != 2)
            return error_at(read.location(1), ".lib: expected a file and a section; to read a complete file, use .include");
        return skip_section(lines, read.line.location());
    }

    /// True for LTspice's own libraries, such as lib/cmp/standard.bjt, if there is no file of this name.
    bool is_missing_standard_library(std::string_view name) const {
        const auto file = lower(name.substr(name.find_last_of("/\\") + 1));
        return file.starts_with("standard.") && !files_.exists(name);
    }

    /// Reads an included file, or a section of a library. `location` is that of the line that names it.
    Result<void> open(std::string_view name, std::string section, SourceLocation location) {
        if (is_missing_standard_library(name)) {
            out_.warnings.push_back(
                error_at(location, "'{}' is not read: the models of LTspice's own library must be in the netlist", name));
            return {};
        }
        const auto file = TRY(files_.open(name, std::move(section), location));
        if (!file.text) return {};
        auto ok = read(*file.text, file.source);
        if (!ok && ok.error().location.file.empty()) return bad_input(ok.error().message, std::move(location));
        return ok;
    }

    Result<void> control(LogicalLineReader& lines, LogicalLine line) {
        auto script = TRY(read_control_script(lines, line, are_scripts_stopped_));
        are_scripts_stopped_ = script.is_stopped;
        for (auto& warning : script.warnings) out_.warnings.push_back(std::move(warning));
        ended_ = script.ends_netlist;
        std::vector<const Statement*> stored;
        for (auto& command : script.commands) {
            if (out_.statements.size() >= max_elements) return too_many_statements(command.line.location());
            auto& s = store(TRY(split_directive(std::move(command.line))));
            if (command.analysis != ControlScript::any_analysis) s.analysis = stored[static_cast<std::size_t>(command.analysis)];
            stored.push_back(&s);
            out_.directives.push_back(&s);
            if (command.is_analysis) script_analyses_.push_back(&s);
        }
        return {};
    }

    /// True if a directive uses the name in its values.
    bool is_used_by_directive(std::string_view name) const {
        return std::ranges::any_of(out_.directives, [&](const Statement* s) { return s->text(0) != ".step" && uses_name(*s, name); });
    }
    /// Defines the parameters that a .step steps and the netlist uses, but that no .param defines, as LTspice does.
    void define_stepped_parameters() {
        for (const auto* s : out_.directives) {
            if (s->text(0) != ".step") continue;
            std::size_t k = 1;
            while (s->text(k) == "dec" || s->text(k) == "oct" || s->text(k) == "lin") ++k;
            if (s->text(k) != "param" || k + 2 >= s->words.size()) continue;
            const std::string name(s->text(k + 1));
            const auto first = s->text(k + 2) == "list" ? k + 3 : k + 2;
            if (first >= s->words.size() || out_.top.parameters.contains(name)) continue;
            if (uses_name(out_.top, name) || is_used_by_directive(name)) out_.top.parameters.emplace(name, WordRef{s, s->words[first]});
        }
    }
};

/// All directives but those of the analyses.
std::span<const NetlistReader::Row> NetlistReader::rows() {
    using R = NetlistReader;
    constexpr auto top = Place::top_level, not_in_if = Place::not_in_if, top_not_in_if = Place::top_level_not_in_if;
    static const Row all[] = {
        {".param", &R::parameters, not_in_if},
        {".global_param", &R::parameters, not_in_if},
        {".func", &R::function, not_in_if},
        {".model", &R::model},
        {".ic", &R::initial_voltages},
        {".nodeset", &R::initial_voltages},
        {".subckt", &R::subcircuit, not_in_if, AfterError::ends},
        {".ends", &R::end_of_subcircuit, not_in_if, AfterError::ends},
        {".include", &R::include, not_in_if, AfterError::ends},
        {".incl", &R::include, not_in_if, AfterError::ends},
        {".inc", &R::include, not_in_if, AfterError::ends},
        {".lib", &R::library, not_in_if, AfterError::ends},
        {".endl", &R::end_without_begin, not_in_if, AfterError::ends},
        {".control", &R::control, not_in_if, AfterError::ends},
        {".endc", &R::end_without_begin, Place::anywhere, AfterError::ends},
        {".end", &R::end},
        {".global", &R::global, top_not_in_if},
        {".temp", &R::temperature, top_not_in_if},
        {".options", &R::options, top_not_in_if},
        {".option", &R::options, top_not_in_if},
        {".opt", &R::options, top_not_in_if},
        {".set", &R::set_values, top_not_in_if},
        {".title", &R::title, top_not_in_if},
        {".if", &R::branch_line, Place::anywhere, AfterError::ends},
        {".elseif", &R::branch_line, Place::anywhere, AfterError::ends},
        {".else", &R::branch_line, Place::anywhere, AfterError::ends},
        {".endif", &R::endif_line, Place::anywhere, AfterError::ends},
        // These become Circuit::directives, as those of the analyses do.
        {".meas", &R::output, top},
        {".measure", &R::output, top},
        {".print", &R::output, top},
        {".plot", &R::output, top},
        {".probe", &R::output, top},
        {".save", &R::output, top},
        {".step", &R::output, top},
        {".mc", &R::output, top},
        {".expect", &R::output, top},
        {".force", &R::output, top},
        {".spike", &R::output, top},
        {".assert", &R::output, top},
        {".four", &R::output, top},
        // Directives of other simulators about listings and scripts, which change no result.
        {".width", &R::without_effect},
        {".list", &R::without_effect},
        {".nolist", &R::without_effect},
        {".backanno", &R::without_effect},
        {".csparam", &R::without_effect},
        // Others, whose absence a user may notice.
        {".wave", &R::without_effect_here},
        {".net", &R::without_effect_here},
        {".preprocess", &R::without_effect_here},
        {".watch", &R::without_effect_here},
        {".autoconverge", &R::without_effect_here},
        {".savebias", &R::without_effect_here},
        {".loadbias", &R::without_effect_here},
        {".ferret", &R::without_effect_here},
        {".text", &R::without_effect_here},
        {".vector", &R::without_effect_here},
        {".protect", &R::without_effect_here},
        {".unprotect", &R::without_effect_here},
        {".prot", &R::without_effect_here},
        {".unprot", &R::without_effect_here},
        {".biaschk", &R::without_effect_here},
        {".alter", &R::alter, not_in_if},
        {".data", &R::missing_block},
        {".machine", &R::missing_block},
        {".hb", &R::missing},
        {".fft", &R::missing},
        {".disto", &R::missing},
        {".sp", &R::missing},
        {".pss", &R::missing},
        {".stimulus", &R::missing},
        {".connect", &R::missing},
        {".sampling", &R::missing},
    };
    return all;
}

}  // namespace

Result<void> read_netlist(const std::string& text, const std::string& file, const Netlist::FileOpener& open, const std::string& corner,
                          ParsedNetlist& out, Refusals& refusals) {
    out.file = file;
    return NetlistReader(out, refusals, open, corner).read_all(text, file);
}

}  // namespace corpuscle::circuit
