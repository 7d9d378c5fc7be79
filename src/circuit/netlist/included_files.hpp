#pragma once
// The files of a netlist: those that .include names, and the sections of libraries that .lib names. Used inside circuit/netlist only.

#include "circuit/netlist/parsed_netlist.hpp"

namespace corpuscle::circuit {

/// The path of a file, and the section of it that is read; "" is the complete file.
struct FileSection {
    std::string path, section;
    bool operator==(const FileSection&) const = default;
};

/// Opens the files of a netlist. Their size, their number and their nesting are bounded.
class IncludedFiles {
    const Netlist::FileOpener& open_;
    Refusals& refusals_;
    CornerSelector corner_;
    // Texts of the files by path, kept because a library is often read for several sections.
    std::map<std::string, std::shared_ptr<const std::string>> texts_;
    std::vector<FileSection> being_read_;  // outermost first
    std::size_t bytes_read_ = 0, files_opened_ = 0;

    bool is_in_library() const;

public:
    struct Opened {
        FileSection source;
        std::shared_ptr<const std::string> text;  ///< null: the file cannot be read
    };

    IncludedFiles(const Netlist::FileOpener& open, Refusals& refusals, std::string corner)
        : open_(open), refusals_(refusals), corner_(std::move(corner)) {}

    /// Opens a file that the present one calls `name`, at `location`. A file that cannot be read is added to the refusals.
    Result<Opened> open(std::string_view name, std::string section, const SourceLocation& location);
    /// True if the file that the present one calls `name` can be read.
    bool exists(std::string_view name) const;
    /// Call these before and after reading a file. The first one is the main file.
    Result<void> enter(FileSection, std::size_t bytes);
    void leave() { being_read_.pop_back(); }
    bool is_main() const { return being_read_.size() == 1; }
    /// Call this after all files are read. Returns an error if a corner was requested and no library had it.
    Result<void> check_corner(const std::string& netlist) const { return corner_.check_found(netlist); }
};

/// True for a word of .lib that names a file and not a section: it is in quotes, or has a folder, or an extension that begins with a
/// letter. tt_1.8v is a section.
bool names_file(std::string_view word);

/// Skips the lines of a section up to .endl; only ".lib file section" reads them. `from` is the location of the section's first line.
Result<void> skip_section(LogicalLineReader&, SourceLocation from);

/// Skips the lines of a library up to the line that begins the section, and returns its location.
Result<SourceLocation> find_section(LogicalLineReader&, const FileSection&);

}  // namespace corpuscle::circuit
