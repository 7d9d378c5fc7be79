#pragma once
// The few Python literals that an NPY header is written in: text, whole numbers, True and False, lists, tuples, a dictionary.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace corpuscle {

struct Python {
    enum Kind { none, text, integer, truth, list, dictionary } kind = none;  // a tuple is a list
    std::string letters = {};
    std::int64_t number = 0;
    std::vector<Python> items = {};  ///< a dictionary: key, value, key, value
    std::string source = {};         ///< as it was written

    const Python* find(std::string_view key) const {
        for (std::size_t k = 0; kind == dictionary && k + 1 < items.size(); k += 2)
            if (items[k].kind == text && items[k].letters == key) return &items[k + 1];
        return nullptr;
    }
};

/// Nothing if it is none of these, or if more than blanks stands behind it.
std::optional<Python> parse_python(std::string_view);

}  // namespace corpuscle
