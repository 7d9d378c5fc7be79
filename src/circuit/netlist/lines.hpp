#pragma once
// The logical lines of a netlist: comments gone, continuations joined, and each byte's place still known.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle::circuit {

/// A logical line: in small letters, but for what stands in double quotes and for lines that name files.
struct Line {
    /// From `at` on, the text came from this line and column of the file.
    struct Piece {
        std::uint32_t at, line, column;
    };
    std::string text;
    std::vector<Piece> pieces;
    std::shared_ptr<const std::string> file;

    std::vector<std::uint32_t> capitals;  ///< where an F or M was a capital: people mean other scales by them than SPICE

    Place place(std::size_t at = 0) const;
    bool was_capital(std::size_t at) const;
};

/// Gives a file's logical lines one by one.
class Lines {
    std::shared_ptr<const std::string> file_;
    std::string_view rest_, last_;  // last_: rest_ before the physical line last taken
    std::uint32_t number_ = 0;      // of the physical line last taken
    Line next_;                     // begun, and perhaps continued by what follows
    char quote_ = 0;                // open at the end of what is in next_
    std::uint32_t quote_at_ = 0;
    bool begun_ = false;

public:
    Lines(std::string_view text, std::shared_ptr<const std::string> file);

    /// The first line of the main file, which is nothing but a name; as UTF-8.
    Result<std::string> title();
    /// The next line; false at the end.
    Result<bool> next(Line&);
    /// Leaves out all lines, whatever is in them, to the one that begins with the word; false if there is none.
    bool skip_past(std::string_view word);

private:
    bool take(std::string_view& physical);
    void put_back();
    Result<void> add(std::string_view physical, std::size_t from);
    Result<bool> give(Line&);
};

}  // namespace corpuscle::circuit
