#pragma once
// How a file of text separates its fields and writes its numbers.

#include <string>
#include <string_view>
#include <vector>

namespace corpuscle {

using Fields = std::vector<std::string_view>;

struct Dialect {
    char separator = ',';  ///< ' ' stands for any run of blanks
    bool decimal_comma = false;

    /// A tab, else a semicolon, else a comma, else blanks; a comma is a decimal one where it does not separate.
    static Dialect of(std::string_view line);

    /// The fields of a line, without blanks and quotes about them.
    void split(std::string_view line, Fields& out) const;

    /// A finite number; `any` takes infinities and NaN, too.
    bool number(std::string_view field, double& value, bool any = false) const;

    /// The number that begins at `p`, as most are written: a sign, digits, a point. Moves p behind it. False, and p anywhere, where
    /// number() must have a closer look.
    bool plain_number(const char*& p, const char* end, double& value) const;
};

}  // namespace corpuscle
