#pragma once
// Reads a text table with a header row by row: the layout of a recording, the sites of a skin, the channels of frames.

#include "io/table/table.hpp"
#include "io/text/dialect.hpp"
#include "io/text/line_reader.hpp"

namespace corpuscle {

class NamedColumns {
    LineReader lines_;
    Dialect dialect_ = {};
    std::vector<Column> headings_ = {};
    Fields fields_ = {};          // of the current line
    std::string_view line_ = {};  // the current line

public:
    explicit NamedColumns(LineReader lines) : lines_(std::move(lines)) {}
    /// Reads the header, which is then the current line. Returns false if the file has no line.
    Result<bool> read_header();
    /// Reads the next line that is neither empty nor a comment (# or %). Returns false at the end of the file.
    Result<bool> next();

    const std::string& path() const { return lines_.path(); }
    const std::vector<Column>& headings() const { return headings_; }
    /// The index of the last column with one of these names, without regard to case; nullopt if there is none.
    std::optional<std::size_t> find(std::initializer_list<std::string_view> names) const;
    const Fields& fields() const { return fields_; }  ///< of the current line; there may be more or fewer than headings
    /// Parses a field as a number. Returns false if it is not one.
    bool number(std::size_t field, double& value) const { return dialect_.parse_number(fields_[field], value); }
    /// An error in the current line, at the field with this index if the line has it.
    Error error_at(std::string message, std::size_t field = std::string::npos) const;
};

}  // namespace corpuscle
