#include "io/table/npz.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/text/utf8.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little, "elements are decoded as on a little-endian machine");

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t max_header = std::size_t{1} << 20;  // bytes; also the largest size of an element

/// The T whose bytes are at `at`, in reversed order if `swap`.
template <class T, bool swap>
T stored(const std::byte* at) {
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), at, sizeof(T));
    if constexpr (swap) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
}

template <class T, bool swap>
double number(const std::byte* at) {
    return static_cast<double>(stored<T, swap>(at));
}

/// A number in IEEE half precision: 5 exponent bits, 10 mantissa bits.
template <bool swap>
double half(const std::byte* at) {
    const unsigned bits = stored<std::uint16_t, swap>(at), mantissa = bits & 0x3ff;
    const int exponent = static_cast<int>(bits >> 10 & 31);
    const double magnitude = exponent == 31  ? (mantissa ? std::nan("") : INFINITY)
                             : exponent == 0 ? std::ldexp(mantissa, -24)
                                             : std::ldexp(mantissa + 1024, exponent - 25);
    return bits >> 15 ? -magnitude : magnitude;
}

double boolean(const std::byte* at) { return *at == std::byte{0} ? 0 : 1; }

/// The function that decodes an element of this kind and size (in bytes); see NpyField::kind.
template <bool swap>
double (*decoder_of(char kind, std::size_t size))(const std::byte*) {
    switch (kind) {
        case 'b':
            return boolean;
        case 'f':
            return size == 8 ? number<double, swap> : size == 4 ? number<float, swap> : half<swap>;
        case 'i':
            return size == 8   ? number<std::int64_t, swap>
                   : size == 4 ? number<std::int32_t, swap>
                   : size == 2 ? number<std::int16_t, swap>
                               : number<std::int8_t, swap>;
        default:
            return size == 8   ? number<std::uint64_t, swap>
                   : size == 4 ? number<std::uint32_t, swap>
                   : size == 2 ? number<std::uint16_t, swap>
                               : number<std::uint8_t, swap>;
    }
}

/// Parses a NumPy type: byte order, kind and size in bytes, as in "<f8", "|b1", ">u2". For U the text states the number of characters of
/// four bytes, as in "<U12". nullopt if the type is unknown.
std::optional<NpyField> parse_type(std::string_view text) {
    constexpr std::string_view kinds = "biufcUSOVMm";
    NpyField field;
    if (text.empty()) return {};
    if (std::string_view("<>|=").find(text[0]) != std::string_view::npos) field.big_endian = text[0] == '>', text.remove_prefix(1);
    if (text.empty() || kinds.find(text[0]) == std::string_view::npos) return {};
    field.kind = text[0];
    text = text.substr(1, text.find('[') - 1);  // remove the unit of dates: M8[ns]
    for (const char digit : text) {
        if (digit < '0' || digit > '9' || field.size > max_header) return {};
        field.size = field.size * 10 + static_cast<std::size_t>(digit - '0');
    }
    if (field.kind == 'O') field.size = 8;
    if (field.kind == 'U') field.size *= 4;
    return field;
}

/// Parses a Python literal of strings, integers, True, False, lists, tuples and dictionaries, after conversion to JSON: its strings in
/// double quotes, its tuples as lists, without a comma after the last element. Discarded if the text is not such a literal.
Json parse_python_literal(std::string_view text) {
    std::string json;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (c == '\'' || c == '"') {
            const auto end = std::min(text.find(c, k + 1), text.size());
            json += Json(std::string(text.substr(k + 1, end - k - 1))).dump();
            k = end;
        } else if (c == ')' || c == ']' || c == '}') {
            json.erase(json.find_last_not_of(" \t\r\n") + 1);
            if (json.ends_with(',')) json.pop_back();
            json += c == ')' ? ']' : c;
        } else if (text.substr(k).starts_with("True")) {
            json += "true", k += 3;
        } else if (text.substr(k).starts_with("False")) {
            json += "false", k += 4;
        } else if (c != 'L') {  // Python 2 writes long integers as 12L
            json += c == '(' ? '[' : c;
        }
    }
    const auto is_shallow = [](int depth, auto, const auto&) { return depth <= 8; };  // drops deeper values, which no header has
    return Json::parse(json, is_shallow, false);
}

/// The number of elements of an array of this shape. Returns max_header, which the caller rejects, if it is too large for std::size_t.
std::size_t elements_of(const Json& shape) {
    std::size_t product = 1;
    for (const auto& n : shape)
        if (!n.is_number_unsigned() || __builtin_mul_overflow(product, n.get<std::size_t>(), &product)) return max_header;
    return product;
}

/// Parses the type in the header: a type such as "<f8", or the list of the fields of a structured type, each of which is (name, type) or
/// (name, type, shape). Adds the size of an element in bytes to `element_size`, which must be 0.
std::optional<std::vector<NpyField>> parse_fields(const Json& type, std::size_t& element_size) {
    std::vector<NpyField> fields;
    if (type.is_string()) {
        const auto scalar = parse_type(type.get_ref<const std::string&>());
        if (!scalar) return {};
        element_size = scalar->size;
        return std::vector{*scalar};
    }
    if (!type.is_array() || type.empty()) return {};
    for (const auto& item : type) {
        if (!item.is_array() || item.size() < 2 || !item[1].is_string()) return {};
        auto field = parse_type(item[1].get_ref<const std::string&>());
        if (!field || field->size > max_header) return {};
        if (item.size() > 2) field->kind = 'V', field->size *= elements_of(item[2]);  // each element holds an array, which is not read
        if (field->size > max_header) return {};
        field->name = item[0].is_string() ? item[0].get<std::string>() : "";
        field->offset = element_size;
        element_size += field->size;
        if (field->name.empty()) field->kind = 'V';  // padding
        fields.push_back(*std::move(field));
    }
    return fields;
}

/// Parses the dictionary of the header. `name` is the file's name for messages.
Result<NpyHeader> parse_header(const std::string& text, const std::string& name) {
    const auto dictionary = parse_python_literal(to_utf8(text));
    const auto value = [&](const char* key) { return dictionary.is_object() ? dictionary.value(key, Json()) : Json(); };
    const auto type = value("descr"), order = value("fortran_order"), shape = value("shape");
    if (type.is_null() || !order.is_boolean() || !shape.is_array())
        return bad_input("the header does not contain descr, fortran_order and shape", {name});
    NpyHeader header;
    header.is_column_major = order.get<bool>();
    header.type = (type.is_string() ? "'" + type.get<std::string>() + "'" : type.dump()).substr(0, 60);
    for (const auto& n : shape) {
        if (!n.is_number_unsigned()) return bad_input("the shape in the header is not a list of non-negative integers", {name});
        header.shape.push_back(n.get<std::uint64_t>());
    }
    auto fields = parse_fields(type, header.element_size);
    if (!fields || header.element_size == 0 || header.element_size > max_header)
        return bad_input(fmt::format("unknown NumPy type {} in the header", header.type), {name});
    header.fields = *std::move(fields);
    return header;
}

}  // namespace

bool NpyField::is_numeric() const {
    return (kind == 'b' && size == 1) || (kind == 'f' && (size == 2 || size == 4 || size == 8)) ||
           ((kind == 'i' || kind == 'u') && (size == 1 || size == 2 || size == 4 || size == 8));
}

double (*NpyField::decoder() const)(const std::byte*) { return big_endian ? decoder_of<true>(kind, size) : decoder_of<false>(kind, size); }

std::uint64_t NpyHeader::element_count() const {
    std::uint64_t product = 1;
    for (const auto n : shape) product *= n;
    return product;
}

Result<NpyHeader> read_npy_header(SeekableBytes& bytes) {
    std::array<std::byte, 8> start{};
    const bool is_complete = bytes.size() >= start.size();
    TRY(is_complete ? bytes.read(start) : Result<void>());
    if (!is_complete || std::memcmp(start.data(), magic.data(), magic.size()) != 0) return bad_input("not an NPY file", {bytes.name()});
    const int version = static_cast<int>(start[6]);
    if (version < 1 || version > 3)
        return bad_input(fmt::format("NPY version {} is not supported (only 1, 2, 3)", version), {bytes.name()});
    std::array<std::byte, 4> stored_length{};  // of the dictionary, bytes
    TRY(bytes.read(std::span(stored_length).first(version == 1 ? 2 : 4)));
    const std::size_t length = stored<std::uint32_t, false>(stored_length.data());
    if (length > max_header) return bad_input(fmt::format("the header is too long: {} bytes", length), {bytes.name()});
    std::string text(length, ' ');
    TRY(bytes.read(std::as_writable_bytes(std::span(text))));
    auto header = TRY(parse_header(text, bytes.name()));
    header.data_offset = start.size() + (version == 1 ? 2 : 4) + length;
    std::uint64_t needed = header.element_size;
    bool is_too_large = false;
    for (const auto n : header.shape) is_too_large = __builtin_mul_overflow(needed, n, &needed) || is_too_large;
    const bool pickled = std::any_of(header.fields.begin(), header.fields.end(), [](const auto& f) { return f.kind == 'O'; });
    if (!pickled && (is_too_large || needed > bytes.size() - header.data_offset))
        return bad_input(fmt::format("the array needs {} bytes, but the file has {}; it may be incomplete",
                                     is_too_large ? "more than 2^64" : fmt::format("{}", needed), bytes.size() - header.data_offset),
                         {bytes.name()});
    return header;
}

std::string npy_header(std::string_view type, std::size_t count) {
    auto text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({},), }}", type, count);
    const std::size_t before = magic.size() + 4, total = (before + text.size() + 1 + 63) / 64 * 64;  // the data start at a multiple of 64
    text.resize(total - before - 1, ' ');
    const auto length = text.size() + 1;
    return std::string(magic) + '\x01' + '\0' + static_cast<char>(length & 255) + static_cast<char>(length >> 8) + text + '\n';
}

}  // namespace corpuscle
