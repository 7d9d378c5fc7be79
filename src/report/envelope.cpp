#include "report/envelope.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace corpuscle {

void Envelope::add(double value) {
    const auto x = static_cast<float>(value);
    if (bucket_ == 1) {
        if (values_.size() < max_points_) return values_.push_back(x);
        double_bucket();
    }
    if (last_count_ == bucket_) {
        if (values_.size() / 2 >= max_points_) double_bucket();
        if (last_count_ == bucket_) last_count_ = 0;  // otherwise doubling has left the last bucket half full
    }
    if (last_count_ == 0) {
        values_.insert(values_.end(), {x, x});
    } else {
        auto* last = &values_[values_.size() - 2];
        last[0] = std::min(last[0], x), last[1] = std::max(last[1], x);
    }
    ++last_count_;
}

void Envelope::double_bucket() {
    std::vector<float> merged;
    const std::size_t width = bucket_ == 1 ? 1 : 2,
                      step = 2 * width;  // floats of one old bucket, and of the two old buckets that become one
    for (std::size_t k = 0; k < values_.size(); k += step) {
        const auto end = std::min(k + step, values_.size());
        const auto [min, max] =
            std::minmax_element(values_.begin() + static_cast<std::ptrdiff_t>(k), values_.begin() + static_cast<std::ptrdiff_t>(end));
        merged.insert(merged.end(), {*min, *max});
    }
    const auto buckets = static_cast<std::int64_t>(values_.size() / width);
    // The new last bucket contains one old bucket if their number was odd, else a full one and the old last one.
    last_count_ = (buckets % 2 == 1 ? 0 : bucket_) + (bucket_ == 1 ? 1 : last_count_);
    values_ = std::move(merged);
    bucket_ *= 2;
}

std::string base64(std::span<const std::byte> bytes) {
    static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        const auto at = [&](std::size_t n) { return k + n < bytes.size() ? std::to_integer<unsigned>(bytes[k + n]) : 0U; };
        const unsigned word = at(0) << 16 | at(1) << 8 | at(2);
        for (std::size_t n = 0; n < 4; ++n) out.push_back(letters[word >> (18 - 6 * n) & 63]);
    }
    const std::size_t padding = (3 - bytes.size() % 3) % 3;
    out.replace(out.size() - padding, padding, padding, '=');
    return out;
}

nlohmann::ordered_json array_document(std::span<const float> values) { return {{"f32", base64(std::as_bytes(values))}}; }
nlohmann::ordered_json array_document(std::span<const double> values) { return {{"f64", base64(std::as_bytes(values))}}; }
nlohmann::ordered_json array_document(std::span<const std::uint32_t> values) { return {{"u32", base64(std::as_bytes(values))}}; }
nlohmann::ordered_json array_document(std::span<const std::uint16_t> values) { return {{"u16", base64(std::as_bytes(values))}}; }
nlohmann::ordered_json array_document(std::span<const std::byte> values) { return {{"u8", base64(values)}}; }

bool is_array_type(std::string_view key) {
    constexpr std::string_view types[] = {"f32", "f64", "u32", "u16", "u8"};
    return std::find(std::begin(types), std::end(types), key) != std::end(types);
}

std::size_t encoded_size(const nlohmann::ordered_json& array) { return array.begin()->get_ref<const std::string&>().size(); }

nlohmann::ordered_json curve_document(std::uint32_t channel, const nlohmann::ordered_json& afferent, std::string_view quantity,
                                      std::string_view unit, const Envelope& values) {
    return {{"channel", channel},
            {"afferent", afferent},
            {"quantity", quantity},
            {"unit", unit},
            {"bucket", values.bucket()},
            {"count", values.count()},
            {"data", array_document(values.values())}};
}

}  // namespace corpuscle
