#pragma once
// The Python literals that occur in an NPY header: strings, integers, True and False, lists, tuples, dictionaries.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace corpuscle {

struct PythonLiteral {
    enum Kind { none, text, integer, boolean, list, dictionary } kind = none;  // a tuple is a list
    std::string characters = {};                                               ///< of a text
    std::int64_t number = 0;                                                   ///< of an integer; of a boolean, 1 for True and 0 for False
    std::vector<PythonLiteral> items = {};                                     ///< of a list; of a dictionary: key, value, key, value ...
    std::string source = {};                                                   ///< the literal as written

    /// The value of a key of a dictionary; null if it does not exist.
    const PythonLiteral* find(std::string_view key) const {
        for (std::size_t k = 0; kind == dictionary && k + 1 < items.size(); k += 2)
            if (items[k].kind == text && items[k].characters == key) return &items[k + 1];
        return nullptr;
    }
};

/// Returns nullopt if the text is not one of these literals, or if anything but blanks follows it.
std::optional<PythonLiteral> parse_python_literal(std::string_view);

}  // namespace corpuscle
