#include "io/table/npz.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstring>

#include "core/parameter.hpp"
#include "core/text/utf8.hpp"

namespace corpuscle {
namespace {

constexpr std::string_view ending = ".npy";  // of the name of a member: array `t` is the member t.npy

/// The bytes of a list as in memory.
template <class T>
std::string raw(std::span<const T> list) {
    return {reinterpret_cast<const char*>(list.data()), list.size_bytes()};
}

/// Decodes UTF-8. Invalid bytes become U+FFFD.
std::u32string code_points(std::string_view text) {
    std::u32string out;
    while (!text.empty()) out.push_back(take_code_point(text).value_or(U'\ufffd'));
    return out;
}

/// An array with all its elements.
struct NpyArray {
    NpyHeader header;
    std::vector<std::byte> elements;

    /// The bytes of element k.
    const std::byte* at(std::size_t k) const { return elements.data() + k * header.element_size; }
};

/// Reads an array whose elements are of one of `kinds` (letters as in NpyField::kind). `expected` names these kinds in messages. Reads in
/// chunks, so that a wrong length in the archive causes no large allocation.
Result<NpyArray> read_array(const NpzReader& npz, const std::string& name, std::string_view kinds, std::string_view expected) {
    const auto bytes = TRY(npz.bytes(name));
    auto header = TRY(read_member_header(*bytes));
    const auto& field = header.fields[0];
    const bool fits = field.kind == 'U' || field.kind == 'S' || field.is_numeric();
    if (!field.name.empty() || !fits || kinds.find(field.kind) == std::string_view::npos)
        return bad_input(fmt::format("the type is {}, expected {}", header.type, expected), {bytes->name()});
    NpyArray out{std::move(header), {}};
    const std::uint64_t all = out.header.element_count() * out.header.element_size;
    while (out.elements.size() < all) {
        const auto old_size = out.elements.size();
        out.elements.resize(old_size + static_cast<std::size_t>(std::min<std::uint64_t>(all - old_size, 1 << 24)));
        TRY(bytes->read(std::span(out.elements).subspan(old_size)));
    }
    return out;
}

/// Reads an integer of up to 64 bits exactly. A double would hold only 53 bits.
std::int64_t integer_at(const NpyField& field, const std::byte* at) {
    if (field.size < 8) return static_cast<std::int64_t>(field.decoder()(at));
    std::int64_t value;
    std::memcpy(&value, at, sizeof value);
    return field.big_endian ? static_cast<std::int64_t>(__builtin_bswap64(static_cast<std::uint64_t>(value))) : value;
}

/// The string in an element of kind S (bytes) or U (code points), without the zeros at its end.
std::string string_at(const NpyField& field, const std::byte* at) {
    std::string out;
    if (field.kind == 'S') {
        out.assign(reinterpret_cast<const char*>(at), field.size);
        return out.substr(0, out.find_last_not_of('\0') + 1);
    }
    std::u32string letters(field.size / 4, U'\0');
    std::memcpy(letters.data(), at, field.size);
    while (!letters.empty() && letters.back() == 0) letters.pop_back();
    for (const auto c : letters) append_utf8(out, field.big_endian ? __builtin_bswap32(c) : c);
    return out;
}

}  // namespace

void NpzWriter::add(const std::string& name, std::span<const std::int64_t> list) {
    arrays_.push_back({name + std::string(ending), npy_header("<i8", list.size()) + raw(list)});
}

void NpzWriter::add(const std::string& name, std::span<const double> list) {
    arrays_.push_back({name + std::string(ending), npy_header("<f8", list.size()) + raw(list)});
}

void NpzWriter::add(const std::string& name, std::span<const std::string> list) {
    std::vector<std::u32string> words;
    std::size_t max_length = 1;
    for (const auto& s : list) words.push_back(code_points(s)), max_length = std::max(max_length, words.back().size());
    std::string bytes = npy_header(fmt::format("<U{}", max_length), list.size());
    for (auto& w : words) {
        w.resize(max_length);
        bytes += raw(std::span<const char32_t>(w));
    }
    arrays_.push_back({name + std::string(ending), std::move(bytes)});
}

Result<NpyHeader> read_member_header(SeekableBytes& bytes) {
    auto header = read_npy_header(bytes);
    if (!header) return header;
    const bool pickled = std::any_of(header->fields.begin(), header->fields.end(), [](const auto& f) { return f.kind == 'O'; });
    const auto total = header->data_offset + header->element_count() * header->element_size;
    if (pickled || total == bytes.size()) return header;
    return bad_input(fmt::format("the archive states {} bytes, but the array has {}; it may be damaged", bytes.size(), total),
                     {bytes.name()});
}

Result<NpzReader> NpzReader::open(const std::string& path) { return NpzReader(TRY(Archive::open(path))); }

std::vector<std::string> NpzReader::names() const {
    std::vector<std::string> all;
    for (const auto& m : archive_.members())
        if (m.name.ends_with(ending)) all.push_back(m.name.substr(0, m.name.size() - ending.size()));
    return all;
}

bool NpzReader::has(const std::string& name) const {
    const auto all = names();
    return std::find(all.begin(), all.end(), name) != all.end();
}

Result<std::unique_ptr<SeekableBytes>> NpzReader::bytes(const std::string& name) const {
    const auto& members = archive_.members();
    const auto file = name + std::string(ending);
    const auto found = std::find_if(members.begin(), members.end(), [&](const auto& m) { return m.name == file; });
    if (found != members.end()) return archive_.bytes(static_cast<std::size_t>(found - members.begin()), path() + "/" + name);
    const auto all = names();
    const std::vector<std::string_view> views(all.begin(), all.end());
    return bad_input(fmt::format("no array '{}'{}", name, did_you_mean(name, views)), {path()});
}

Result<std::vector<std::int64_t>> NpzReader::integers(const std::string& name) const {
    const auto array = TRY(read_array(*this, name, "biu", "integers"));
    std::vector<std::int64_t> out(array.header.element_count());
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = integer_at(array.header.fields[0], array.at(k));
    return out;
}

Result<std::vector<double>> NpzReader::numbers(const std::string& name) const {
    const auto array = TRY(read_array(*this, name, "biuf", "numbers"));
    const auto decode = array.header.fields[0].decoder();
    std::vector<double> out(array.header.element_count());
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = decode(array.at(k));
    return out;
}

Result<std::vector<std::string>> NpzReader::strings(const std::string& name) const {
    const auto array = TRY(read_array(*this, name, "US", "strings"));
    std::vector<std::string> out(array.header.element_count());
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = string_at(array.header.fields[0], array.at(k));
    return out;
}

}  // namespace corpuscle
