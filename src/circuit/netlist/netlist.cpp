#include "circuit/netlist/netlist.hpp"

#include <filesystem>

#include "circuit/netlist/included_files.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/embedded_files.hpp"
#include "core/text/input_files.hpp"

namespace corpuscle::circuit {
namespace {

/// The text of a file; that of an embedded process card if there is no such file.
Result<std::string> read_file_text(const std::string& path) {
    std::error_code status;
    if (const auto card = embedded_card_of(path); !card.empty() && !std::filesystem::exists(path, status)) return embedded_text(card);
    return read_entire_input(path, max_text_bytes, "netlist");
}

int index_of_name(const std::unordered_map<std::string, int>& numbers, std::string_view name) {
    const auto at = numbers.find(std::string(name));
    return at == numbers.end() ? -1 : at->second;
}

/// The names of the sections that the text of a library defines. A name that could be that of a file is one only if it is `wanted`.
std::vector<std::string> sections_in(std::string_view text, std::string_view wanted) {
    std::vector<std::string> out;
    LogicalLineReader lines(text, std::make_shared<const std::string>());
    LogicalLine line;
    for (auto more = lines.next(line); more && *more; more = lines.next(line)) {
        if (lower(std::string_view(line.text).substr(0, 4)) != ".lib") continue;
        // ".lib section" begins a section; ".lib file section" reads another file.
        const auto head = split_directive(std::move(line));
        if (!head || head->words.size() != 2) continue;
        auto name = lower(unquoted(head->text(1)));
        if (!names_file(head->text(1)) || (name == wanted && name.size() == head->text(1).size())) out.push_back(std::move(name));
    }
    return out;
}

/// The sections of a library that no other section of it reads.
std::vector<std::string> corners_in(std::string_view text) {
    auto out = sections_in(text, "");
    LogicalLineReader lines(text, std::make_shared<const std::string>());
    LogicalLine line;
    for (auto more = lines.next(line); more && *more; more = lines.next(line)) {
        if (lower(std::string_view(line.text).substr(0, 4)) != ".lib") continue;
        const auto head = split_directive(std::move(line));
        if (head && head->words.size() == 3) std::erase(out, lower(unquoted(head->text(2))));
    }
    return out;
}

}  // namespace

bool is_modifier_of_tran(std::string_view word) {
    return word == "startup" || word == "steady" || word == "nodiscard" || word == "step" || word == "noop";
}

SourceLocation Directive::location_of(std::size_t word) const {
    auto out = location;
    if (word < columns.size()) out.column = columns[word];
    return out;
}

bool starts_from_initial_conditions(const Directive& tran) { return std::ranges::find(tran.words, "uic") != tran.words.end(); }

int Circuit::find_node(std::string_view name) const {
    if (is_ground(name)) return 0;
    // The map is complete in an elaborated circuit; a circuit that was made in another way may have none.
    if (node_numbers.size() == nodes.size()) return index_of_name(node_numbers, name);
    const auto at = std::find(nodes.begin(), nodes.end(), name);
    return at == nodes.end() ? -1 : static_cast<int>(at - nodes.begin());
}

int Circuit::find_element(std::string_view name) const {
    if (element_numbers.size() == elements.size()) return index_of_name(element_numbers, name);
    const auto at = std::find_if(elements.begin(), elements.end(), [&](const Element& e) { return e.name == name; });
    return at == elements.end() ? -1 : static_cast<int>(at - elements.begin());
}

Result<Netlist> Netlist::parse(std::string text, std::string file, const FileOpener& open, const std::string& corner) {
    auto parsed = std::make_shared<Impl>();
    Refusals refusals;
    if (const auto ok = read_netlist(text, file, open, corner, *parsed, refusals); !ok)
        refusals.add(ok.error());
    else if (!refusals.empty())
        refusals.add_elements_of(find_refused_elements(*parsed));
    if (!refusals.empty()) return refusals.combined();
    Netlist out;
    out.impl_ = std::move(parsed);
    return out;
}

Result<Netlist> Netlist::read(const std::string& path, const std::string& corner) {
    auto text = TRY(read_file_text(path));
    return parse_text(std::move(text), path, corner);
}

Result<Netlist> Netlist::parse_text(std::string text, std::string file, const std::string& corner) {
    if (text.size() > max_text_bytes) return error_at({file}, "{} bytes; the maximum is {}", text.size(), max_text_bytes);
    return parse(std::move(text), std::move(file), read_file_text, corner);
}

Netlist Netlist::with_overrides(ResolvedOverrides changes) const {
    Netlist out = *this;
    out.overrides_ = std::make_shared<const ResolvedOverrides>(std::move(changes));
    return out;
}

const ResolvedOverrides& Netlist::overrides() const {
    static const ResolvedOverrides none;
    return overrides_ ? *overrides_ : none;
}

std::map<std::string, Netlist::Parameter, std::less<>> Netlist::parameters() const {
    std::map<std::string, Parameter, std::less<>> out;
    if (impl_)
        for (const auto& [name, text] : impl_->top.parameters)
            out.emplace(name, Parameter{std::string(text.view()), !impl_->libraries.contains(text.location().file)});
    return out;
}

std::vector<Netlist::Subcircuit> Netlist::subcircuits() const {
    std::vector<Subcircuit> out;
    if (!impl_) return out;
    for (const auto& [name, definition] : impl_->top.subcircuits) out.push_back({name, definition->ports});
    return out;
}

std::vector<std::string> Netlist::corners() const {
    std::vector<std::string> out;
    if (!impl_) return out;
    for (const auto& library : impl_->libraries)
        if (const auto text = read_file_text(library))
            for (auto& corner : corners_in(*text))
                if (std::find(out.begin(), out.end(), corner) == out.end()) out.push_back(std::move(corner));
    return out;
}

std::string CornerSelector::select_section(const std::string& section, std::string_view library, std::string_view text) {
    if (corner_.empty()) return section;
    const auto known = sections_in(text, corner_);
    if (std::find(known.begin(), known.end(), corner_) != known.end()) return is_found_ = true, corner_;
    libraries_.push_back(fmt::format("'{}' has {}{}", library, joined(known), did_you_mean(corner_, known)));
    return section;
}

Result<void> CornerSelector::check_found(const std::string& netlist) const {
    if (corner_.empty() || is_found_) return {};
    if (libraries_.empty()) return error_at({netlist}, "there is no corner '{}': the netlist has no line .lib 'file' section", corner_);
    return error_at({netlist}, "no corner '{}': library {}", corner_, joined(libraries_, "; "));
}

}  // namespace corpuscle::circuit
