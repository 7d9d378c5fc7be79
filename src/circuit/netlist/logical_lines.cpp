#include "circuit/netlist/statement.hpp"

#include "core/text/ascii_text.hpp"
#include "core/text/utf8.hpp"

namespace corpuscle::circuit {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// The number of bytes of a micro sign at the beginning of a text, which LTspice writes for u: in UTF-8, a Greek mu, or in Latin-1. 0:
/// none.
std::size_t length_of_micro_sign(std::string_view s) {
    if (s.starts_with("\xc2\xb5") || s.starts_with("\xce\xbc")) return 2;
    return s.starts_with("\xb5") ? 1 : 0;
}

/// The same of an ohm sign or a Greek capital omega, which end a number: 100 ohm.
std::size_t length_of_ohm_sign(std::string_view s) { return s.starts_with("\xce\xa9") ? 2 : s.starts_with("\xe2\x84\xa6") ? 3 : 0; }

/// The same of a degree sign, which is left out: 27 degrees Celsius is 27C.
std::size_t length_of_degree_sign(std::string_view s) { return s.starts_with("\xc2\xb0") ? 2 : s.starts_with("\xb0") ? 1 : 0; }

/// The same of a section sign, which LTspice writes between the letter of an element and its name: V§Req.
std::size_t length_of_section_sign(std::string_view s) { return s.starts_with("\xc2\xa7") ? 2 : s.starts_with("\xa7") ? 1 : 0; }

/// A text of ASCII for a sign at the beginning of a text; `length` is the number of bytes of the sign. Nothing for any other text.
struct ReplacedSign {
    std::size_t length;
    std::string_view text;
};
std::optional<ReplacedSign> replaced_sign(std::string_view s) {
    if (const auto length = length_of_micro_sign(s); length > 0) return ReplacedSign{length, "u"};
    if (const auto length = length_of_ohm_sign(s); length > 0) return ReplacedSign{length, "ohm"};
    if (const auto length = length_of_degree_sign(s); length > 0) return ReplacedSign{length, ""};
    if (const auto length = length_of_section_sign(s); length > 0) return ReplacedSign{length, "_"};
    return {};
}

/// True for a tab and for the printable characters of ASCII.
bool is_text(char c) { return c == '\t' || (c >= ' ' && c <= '~'); }

/// The letters without accents for the letters of Latin-1, from U+00C0.
constexpr std::string_view plain_letters = "AAAAAAACEEEEIIIIDNOOOOO*OUUUUYTsaaaaaaaceeeeiiiidnooooo/ouuuuyty";

/// The character of ASCII that a character was probably meant as; "" if there is none.
std::string plain_character(char32_t c) {
    constexpr char32_t first_letter = 0xC0;
    if (c >= first_letter && c - first_letter < plain_letters.size()) return std::string(1, plain_letters[c - first_letter]);
    constexpr std::pair<char32_t, std::string_view> signs[] = {
        {0xA0, "a blank"}, {0x2010, "-"}, {0x2011, "-"},  {0x2012, "-"},  {0x2013, "-"}, {0x2014, "-"}, {0x2212, "-"},
        {0x2018, "'"},     {0x2019, "'"}, {0x201C, "\""}, {0x201D, "\""}, {0xB7, "*"},   {0x22C5, "*"}};
    const auto* found = std::ranges::find(signs, c, &std::pair<char32_t, std::string_view>::first);
    return found == std::end(signs) ? "" : std::string(found->second);
}

Error invalid_byte(std::string_view line, std::size_t at, SourceLocation location) {
    constexpr unsigned char first_beyond_ascii = 0x80;
    const auto byte = static_cast<unsigned char>(line[at]);
    location.column = static_cast<long>(at) + 1;
    if (byte == 0) return error_at(location, "byte 0x00: a netlist is text; is this UTF-16? Save it as UTF-8");
    if (byte == '\r')
        return error_at(location, "byte 0x0D: some lines end with a carriage return alone and others do not; end all with a line feed");
    if (byte < first_beyond_ascii) return error_at(location, "byte 0x{:02X}: a control character; remove it", byte);
    auto rest = line.substr(at);
    auto code_point = take_code_point(rest);
    if (!code_point) {
        const auto converted = to_utf8(line.substr(at, 1));  // of Windows-1252
        std::string_view character = converted;
        code_point = take_code_point(character).value_or(byte);
    }
    std::string character;
    append_utf8(character, *code_point);
    const auto plain = plain_character(*code_point);
    return error_at(location, "byte 0x{:02X}, '{}': a netlist must be plain ASCII outside comments; {}", byte, character,
                    plain.empty() ? "write a name without it" : fmt::format("write {} instead", plain));
}

/// The number of bytes, with the blank before it, of a note of CDL about the drawing at character k of a line: $X=100, $T=1 0 0 1 or
/// $[mimcap]. 0: there is none.
std::size_t length_of_drawing_note(std::string_view line, std::size_t k) {
    if (!is_blank(line[k]) || k + 2 >= line.size() || line[k + 1] != '$') return 0;
    const auto end_of = [&](std::string_view characters, std::size_t from) {
        return std::min(line.find_first_of(characters, from), line.size());
    };
    if (line[k + 2] == '[') {
        const auto close = line.find(']', k);
        return close == std::string_view::npos ? 0 : close + 1 - k;
    }
    auto at = k + 2;
    while (at < line.size() && is_name_character(lower(line[at]))) ++at;
    if (at == k + 2 || at + 1 >= line.size() || line[at] != '=' || is_blank(line[at + 1])) return 0;
    const bool has_several = lower(line.substr(k + 2, at - k - 2)) == "t";  // $T=1 0 0 1
    for (at = end_of(" \t", at); has_several;) {
        const auto next = std::min(line.find_first_not_of(" \t", at), line.size());
        const auto end = end_of(" \t", next);
        if (next == end || line.substr(next, end - next).find_first_not_of("+-.0123456789eE") != std::string_view::npos) return at - k;
        at = end;
    }
    return at - k;
}

/// True if a comment begins at character k of a line, which must be outside quotes. A $ begins a comment only after a blank or comma and
/// before a blank.
bool begins_comment(std::string_view line, std::size_t k) {
    if (line[k] == ';') return true;
    if (line[k] == '/') return k + 1 < line.size() && line[k + 1] == '/';
    if (line[k] != '$') return false;
    return (k == 0 || is_blank(line[k - 1]) || line[k - 1] == ',') && (k + 1 == line.size() || is_blank(line[k + 1]));
}

/// True if the line is an .include or .lib, whose file names keep their capital letters.
bool names_a_file(std::string_view text) {
    text = text.substr(0, 9);
    const auto word = lower(text.substr(0, text.find_first_of(" \t'\"")));
    return word == ".include" || word == ".incl" || word == ".inc" || word == ".lib";
}

}  // namespace

SourceLocation LogicalLine::location(std::size_t at) const {
    const auto after = std::upper_bound(segments.begin(), segments.end(), at, [](std::size_t a, const Segment& p) { return a < p.at; });
    const Segment segment = after == segments.begin() ? Segment{0, 0, 0} : *(after - 1);
    return {file ? *file : "", static_cast<long>(segment.line), static_cast<long>(segment.column + (at - segment.at))};
}

bool LogicalLine::was_capital(std::size_t at) const { return std::binary_search(capitals.begin(), capitals.end(), at); }

LogicalLineReader::LogicalLineReader(std::string_view text, std::shared_ptr<const std::string> file) : file_(std::move(file)), rest_(text) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);     // the byte order mark of UTF-8
    if (rest_.find('\n') == std::string_view::npos) line_end_ = '\r';  // as on old Macintoshes
}

bool LogicalLineReader::take(std::string_view& physical) {
    if (rest_.empty()) return false;
    last_ = rest_;
    const auto end = std::min(rest_.find(line_end_), rest_.size());
    physical = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (physical.ends_with('\r')) physical.remove_suffix(1);
    ++number_;
    return true;
}

void LogicalLineReader::put_back() {
    rest_ = last_;
    --number_;
}

bool LogicalLineReader::next_command(LogicalLine& out) {
    std::string_view line;
    if (!take(line)) return false;
    const auto first = std::min(line.find_first_not_of(" \t"), line.size());
    out = {"." + lower(trimmed(line)), {{0, number_, static_cast<std::uint32_t>(first)}}, file_, {}};
    return true;
}

Result<std::string> LogicalLineReader::title() {
    std::string_view line;
    if (!take(line)) return std::string();
    for (std::size_t k = 0; k < line.size(); ++k)
        if (!is_text(line[k]) && static_cast<unsigned char>(line[k]) < 0x80) return invalid_byte(line, k, {*file_, 1, 0});
    return to_utf8(line);
}

Result<bool> LogicalLineReader::next(LogicalLine& out) {
    std::string_view line;
    while (take(line)) {
        const auto first = std::min(line.find_first_not_of(" \t"), line.size());
        if (first == line.size() || line[first] == '*' || (quote_ == 0 && begins_comment(line, first))) continue;
        const bool is_continuation = line[first] == '+';
        if (is_continuation && !has_next_)
            return error_at({*file_, static_cast<long>(number_), static_cast<long>(first) + 1},
                            "'+' continues the previous line, but there is none");
        if (!is_continuation && has_next_) {  // the previous line is complete; this one begins the next
            put_back();
            break;
        }
        TRY(append(line, is_continuation ? first + 1 : first));
    }
    if (!has_next_) return false;
    TRY(finish_line(out));
    return true;
}

/// Appends the text of a physical line, from offset `from` to its comment, to the logical line.
Result<void> LogicalLineReader::append(std::string_view physical, std::size_t from) {
    if (has_next_) next_.text += ' ';
    next_.segments.push_back({static_cast<std::uint32_t>(next_.text.size()), number_, static_cast<std::uint32_t>(from) + 1});
    const bool keeps_case = names_a_file(has_next_ ? next_.text : physical.substr(from));
    has_next_ = true;
    for (std::size_t k = from; k < physical.size(); ++k) {
        char c = physical[k];
        if (quote_ == 0 && begins_comment(physical, k)) break;
        if (const auto sign = quote_ == '"' || keeps_case || is_text(c) ? std::nullopt : replaced_sign(physical.substr(k))) {
            next_.text += sign->text, k += sign->length - 1;
            next_.segments.push_back({static_cast<std::uint32_t>(next_.text.size()), number_, static_cast<std::uint32_t>(k) + 2});
            continue;
        }
        if (const auto length = quote_ == 0 ? length_of_drawing_note(physical, k) : 0; length > 0) {
            if (next_.drawing_note.empty()) next_.drawing_note = physical.substr(k, length);
            k += length - 1;
            next_.segments.push_back({static_cast<std::uint32_t>(next_.text.size()), number_, static_cast<std::uint32_t>(k) + 2});
            continue;
        }
        if (!is_text(c)) return invalid_byte(physical, k, {*file_, static_cast<long>(number_), 0});
        const auto at = static_cast<std::uint32_t>(next_.text.size());
        if (c == quote_)
            quote_ = 0;
        else if (quote_ == 0 && (c == '\'' || c == '"'))
            quote_ = c, quote_at_ = at;
        if (c == 'M' || c == 'F') next_.capitals.push_back(at);
        next_.text += keeps_case || quote_ == '"' ? c : lower(c);
    }
    return {};
}

/// Moves the completed logical line to `out`.
Result<void> LogicalLineReader::finish_line(LogicalLine& out) {
    has_next_ = false;
    out = std::exchange(next_, {});
    out.file = file_;
    if (std::exchange(quote_, '\0') != 0)
        return error_at(out.location(quote_at_), "this {} is not closed", out.text[quote_at_] == '"' ? "\"" : "'");
    while (!out.text.empty() && is_blank(out.text.back())) out.text.pop_back();
    return {};
}

}  // namespace corpuscle::circuit
