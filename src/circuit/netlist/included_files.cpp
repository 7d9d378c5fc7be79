#include "circuit/netlist/included_files.hpp"

#include <filesystem>

#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::size_t max_include_depth = 50;  // of files

/// The path of a file that the file `includer` calls `name`. A backslash separates folders, too.
std::string resolved_path(const std::string& includer, std::string name) {
    std::ranges::replace(name, '\\', '/');
    return (std::filesystem::path(includer).parent_path() / std::filesystem::path(name)).lexically_normal().string();
}

}  // namespace

bool IncludedFiles::is_in_library() const {
    return std::ranges::any_of(being_read_, [](const FileSection& s) { return !s.section.empty(); });
}

Result<IncludedFiles::Opened> IncludedFiles::open(std::string_view name, std::string section, const SourceLocation& location) {
    ++files_opened_;
    const std::string path = resolved_path(being_read_.back().path, std::string(name));
    if (being_read_.size() > max_include_depth)
        return error_at(location, "included files are nested deeper than the limit of {}", max_include_depth);
    if (files_opened_ > max_elements) return error_at(location, "more than {} files are included", max_elements);
    auto& text = texts_[path];
    if (!text) {
        auto opened = open_(path);
        if (!opened) {
            const std::string_view hint = name.starts_with('~') ? "; '~' is not replaced, so write the whole path" : "";
            refusals_.add(error_at(location, "'{}': {}{}", name, opened.error().message, hint));
            return Opened{{path, std::move(section)}, nullptr};
        }
        text = std::make_shared<const std::string>(std::move(*opened));
    }
    // The corner does not replace sections that are named inside a library.
    if (!is_in_library() && !section.empty()) section = corner_.select_section(section, name, *text);
    FileSection source{path, std::move(section)};
    if (std::ranges::find(being_read_, source) != being_read_.end()) return error_at(location, "'{}' includes itself", name);
    return Opened{std::move(source), text};
}

bool IncludedFiles::exists(std::string_view name) const {
    return static_cast<bool>(open_(resolved_path(being_read_.back().path, std::string(name))));
}

Result<void> IncludedFiles::enter(FileSection source, std::size_t bytes) {
    bytes_read_ += bytes;
    if (bytes_read_ > max_text_bytes)
        return error_at({source.path}, "the netlist and its included files exceed the limit of {} MB", max_text_bytes >> 20);
    being_read_.push_back(std::move(source));
    return {};
}

bool names_file(std::string_view word) {
    if (unquoted(word) != word || word.find_first_of("/\\") != std::string_view::npos) return true;
    const auto dot = word.rfind('.');
    return dot != std::string_view::npos && dot + 1 < word.size() && std::isalpha(static_cast<unsigned char>(word[dot + 1])) != 0;
}

Result<void> skip_section(LogicalLineReader& lines, SourceLocation from) {
    LogicalLine line;
    while (true) {
        const auto more = TRY(lines.next(line));
        if (!more) return error_at(from, ".lib with one word begins a section, but .endl is missing; to read a file, use .include");
        if (lower(std::string_view(line.text).substr(0, 5)) == ".endl") return {};
    }
}

Result<SourceLocation> find_section(LogicalLineReader& lines, const FileSection& source) {
    std::vector<std::string> known;
    LogicalLine line;
    while (true) {
        const auto more = TRY(lines.next(line));
        if (!more)
            return bad_input(fmt::format("library '{}' has no section '{}'; {}{}", source.path, source.section,
                                         known.empty() ? "it has no sections, so read it with .include" : "it has " + joined(known),
                                         did_you_mean(source.section, known)));
        if (lower(std::string_view(line.text).substr(0, 4)) != ".lib") continue;
        const auto head = TRY(split_directive(std::move(line)));
        if (head.words.size() != 2 || (names_file(head.text(1)) && lower(head.text(1)) != source.section)) continue;
        known.emplace_back(lower(unquoted(head.text(1))));
        if (known.back() == source.section) return head.line.location();
    }
}

}  // namespace corpuscle::circuit
