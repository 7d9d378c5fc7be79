#include "page/object_reader.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/parameter.hpp"

namespace corpuscle::page {
namespace {

constexpr std::size_t max_list = 2048, max_text = 4096;  // elements of a list, such as the sizes of a chip; bytes of a text

Error missing_key(const std::string& name, const char* key) { return bad_input(fmt::format("{}: the key \"{}\" is missing", name, key)); }

Error wrong_value(const std::string& name, const char* key, const Json& value, std::string_view expected) {
    auto shown = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (shown.size() > 60) shown = shown.substr(0, 57) + "...";
    return bad_input(fmt::format("{}: \"{}\" is {}; expected {}", name, key, shown, expected));
}

}  // namespace

const Json* ObjectReader::find(const char* key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
    const auto at = object_.find(key);
    return at == object_.end() ? nullptr : &*at;
}

Result<double> ObjectReader::number(const char* key, double low, double high, std::optional<double> default_value) {
    const auto* value = find(key);
    if (!value) return default_value ? Result<double>(*default_value) : Result<double>(missing_key(name_, key));
    const double x = value->is_number() ? value->get<double>() : NAN;
    if (!(x >= low && x <= high)) return wrong_value(name_, key, *value, fmt::format("a number from {:g} to {:g}", low, high));
    return x;
}

Result<std::uint64_t> ObjectReader::integer(const char* key, std::uint64_t low, std::uint64_t high,
                                            std::optional<std::uint64_t> default_value) {
    const auto* value = find(key);
    if (!value) return default_value ? Result<std::uint64_t>(*default_value) : Result<std::uint64_t>(missing_key(name_, key));
    const double x = value->is_number() ? value->get<double>() : NAN;
    if (!(x >= static_cast<double>(low) && x <= static_cast<double>(high)) || x != std::floor(x))
        return wrong_value(name_, key, *value, fmt::format("an integer from {} to {}", low, high));
    return static_cast<std::uint64_t>(x);
}

Result<bool> ObjectReader::flag(const char* key) {
    const auto* value = find(key);
    if (value && !value->is_boolean()) return wrong_value(name_, key, *value, "true or false");
    return value && value->get<bool>();
}

Result<std::string> ObjectReader::text(const char* key, std::optional<std::string> default_value) {
    const auto* value = find(key);
    if (!value) return default_value ? Result<std::string>(*default_value) : Result<std::string>(missing_key(name_, key));
    if (!value->is_string() || value->get_ref<const std::string&>().size() > max_text) return wrong_value(name_, key, *value, "a text");
    return value->get<std::string>();
}

Result<std::vector<std::string>> ObjectReader::texts(const char* key) {
    std::vector<std::string> out;
    const auto* value = find(key);
    if (!value) return out;
    const auto expected = [&] { return wrong_value(name_, key, *value, fmt::format("a list of at most {} texts", max_list)); };
    if (!value->is_array() || value->size() > max_list) return expected();
    for (const auto& element : *value) {
        if (!element.is_string() || element.get_ref<const std::string&>().size() > max_text) return expected();
        out.push_back(element.get<std::string>());
    }
    return out;
}

Result<std::vector<const Json*>> ObjectReader::objects(const char* key) {
    std::vector<const Json*> out;
    const auto* value = find(key);
    if (!value) return out;
    const auto expected = [&] { return wrong_value(name_, key, *value, fmt::format("a list of at most {} objects", max_list)); };
    if (!value->is_array() || value->size() > max_list) return expected();
    for (const auto& element : *value) {
        if (!element.is_object()) return expected();
        out.push_back(&element);
    }
    return out;
}

Result<const Json*> ObjectReader::object(const char* key) {
    const auto* value = find(key);
    if (value && !value->is_object()) return wrong_value(name_, key, *value, "an object");
    return value;
}

const MessageArray* ObjectReader::array(const char* name) {
    known_arrays_.emplace_back(name);
    const auto at = std::ranges::find(arrays_, name, &MessageArray::name);
    return at == arrays_.end() ? nullptr : &*at;
}

Result<void> ObjectReader::check_all_read() const {
    const auto check = [&](std::string_view what, const std::string& name, const std::vector<std::string>& all) -> Result<void> {
        const std::vector<std::string_view> known(all.begin(), all.end());
        if (std::ranges::find(known, name) != known.end()) return {};
        const auto others = known.empty() ? "it has none" : fmt::format("it has {}", fmt::join(known, ", "));
        return bad_input(fmt::format("{}: unknown {} '{}'{} ({})", name_, what, name, did_you_mean(name, known), others));
    };
    for (const auto& [key, value] : object_.items()) TRY(check("key", key, known_));
    for (const auto& one : arrays_) TRY(check("array", one.name, known_arrays_));
    return {};
}

Result<std::vector<double>> signal(ObjectReader& request, const char* name, std::size_t samples, double default_value) {
    constexpr double limit = 1e9;
    const auto* array = request.array(name);
    if (!array) return std::vector<double>(samples, TRY(request.number(name, -limit, limit, default_value)));
    if (request.has(name)) return bad_input(fmt::format("{}: \"{}\" is given as a number and as an array", request.name(), name));
    if (array->count != samples)
        return bad_input(fmt::format("{}: the array '{}' has {} values for {} samples", request.name(), name, array->count, samples));
    return numbers_of(*array);
}

}  // namespace corpuscle::page
