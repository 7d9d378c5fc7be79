#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

template <class Text>
std::string join_texts(std::span<const Text> texts, std::string_view separator) {
    std::string out;
    for (std::size_t k = 0; k < texts.size(); ++k) out.append(k > 0 ? separator : "").append(texts[k]);
    return out;
}

}  // namespace

std::string joined(std::span<const std::string_view> texts, std::string_view separator) { return join_texts(texts, separator); }
std::string joined(std::span<const std::string> texts, std::string_view separator) { return join_texts(texts, separator); }

}  // namespace corpuscle
