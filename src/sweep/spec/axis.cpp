#include "sweep/spec/axis.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/number/elementary.hpp"
#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "sweep/spec/probability.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr std::string_view methods[] = {"grid", "list", "uniform", "normal", "latin", "sobol"};
constexpr double max_values = 1e6;  // of one axis

/// The method given by the key `how` of a [[vary]], otherwise the method implied by the other keys.
std::string method_of(const ConfigNode& spec) {
    if (const auto* how = spec.get("how")) return how->text;
    if (spec.has("list")) return "list";
    return spec.has("mean") || spec.has("sigma") ? "normal" : "grid";
}

bool is_sobol(const SweepAxis& axis) { return axis.numbers && axis.numbers->method() == Sampling::sobol; }

/// Interprets the text of one axis.
class AxisReader {
    const ConfigNode& spec_;
    const VariedQuantity& quantity_;
    const std::string method_ = method_of(spec_);

    const std::string& name() const { return axis_name(spec_).text; }
    Error error_at(const LocatedText& at, std::string message) const { return at.error_here(fmt::format("{}: {}", name(), message)); }
    /// The error of the axis as a whole, at its `how` or its name.
    Error error_at_axis(std::string message) const {
        return error_at(spec_.has("how") ? *spec_.get("how") : axis_name(spec_), std::move(message));
    }

    Result<double> number(const LocatedText& given) const { return given.located(quantity_.parse(given), name() + ": "); }
    /// Reads a number and checks that the subject allows it.
    Result<double> allowed_number(const LocatedText& given) const {
        const auto value = TRY(number(given));
        if (!(value >= quantity_.min && value <= quantity_.max))
            return error_at(given, fmt::format("{} is outside [{}, {}]", format_quantity(value, quantity_.column.unit),
                                               format_quantity(quantity_.min, quantity_.column.unit),
                                               format_quantity(quantity_.max, quantity_.column.unit)));
        if (quantity_.check) TRY(given.located(quantity_.check(given.text)));
        return value;
    }

    /// Rejects keys that the method does not use.
    Result<void> accept_only(std::initializer_list<std::string_view> known) const {
        for (const auto& [key, value] : spec_.entries) {
            if (key.text == "what" || key.text == "how" || std::find(known.begin(), known.end(), key.text) != known.end()) continue;
            if (key.text == "list")
                return error_at(value.elements.empty() ? axis_name(spec_) : value.elements.front(),
                                fmt::format("list and how = \"{}\" exclude each other", method_));
            return error_at(value,
                            fmt::format("'{}' has no meaning for how = \"{}\" (which allows: {})", key.text, method_, joined(known)));
        }
        return {};
    }
    Result<bool> is_logarithmic() const {
        const auto* log = spec_.get("log");
        if (!log || log->text == "false") return false;
        if (log->text != "true") return error_at(*log, fmt::format("log must be true or false, not '{}'", log->text));
        return true;
    }
    /// Reads the keys from, to and log. With log = true, from and to must be above 0.
    Result<void> range(SweepAxis& axis) const {
        if (!spec_.has("from") || !spec_.has("to"))
            return error_at_axis(fmt::format("{} is missing; how = \"{}\" needs {}", spec_.has("from") ? "to" : "from", method_,
                                             method_ == "grid" ? "from, to and count, or a list" : "from and to"));
        axis.first = TRY(allowed_number(*spec_.get("from"))), axis.second = TRY(allowed_number(*spec_.get("to")));
        axis.is_logarithmic = TRY(is_logarithmic());
        if (axis.is_logarithmic && !(axis.first > 0 && axis.second > 0))
            return error_at(*spec_.get("log"), "log = true needs values above 0");
        return {};
    }
    Result<void> grid(SweepAxis& axis) const {
        TRY(accept_only({"from", "to", "count", "log"}));
        TRY(range(axis));
        const auto* given = spec_.get("count");
        if (!given)
            return error_at_axis("count is missing: the number of values between from and to (or how = \"uniform\" for random values)");
        const auto count = TRY(parse_integer(*given, name() + ": count", 1, max_values));
        if (count == 1 && axis.first != axis.second) return error_at(*given, "count must be 2 or more, because from and to differ");
        for (std::int64_t k = 0; k < count; ++k) {
            const double fraction = count == 1 ? 0 : static_cast<double>(k) / static_cast<double>(count - 1);
            axis.values.push_back(k == 0                ? axis.first
                                  : k == count - 1      ? axis.second
                                  : axis.is_logarithmic ? axis.first * num::exp(fraction * num::log(axis.second / axis.first))
                                                        : axis.first + fraction * (axis.second - axis.first));
        }
        return {};
    }

    /// Reads a list of labels: value k of the axis is the index k of its label.
    Result<void> labels(SweepAxis& axis) const {
        for (const auto& label : spec_.elements_of("list")) {
            if (quantity_.check) TRY(label.located(quantity_.check(label.text)));
            axis.values.push_back(static_cast<double>(axis.column.labels.size()));
            axis.column.labels.push_back(label.text);
        }
        return {};
    }

    Result<void> list(SweepAxis& axis) const {
        TRY(accept_only({"list"}));
        const auto all = spec_.elements_of("list");
        if (all.empty()) return error_at_axis("the list is empty: list = [...]");
        const auto is_label = [&](const LocatedText& s) { return !quantity_.parse(s); };
        if (quantity_.labels_only || (quantity_.allows_labels && std::any_of(all.begin(), all.end(), is_label))) return labels(axis);
        for (const auto& one : all) axis.values.push_back(TRY(allowed_number(one)));
        return {};
    }

    /// Reads sigma: "5%" means 5 % of the mean; any other text is a value in the unit of the quantity.
    Result<double> sigma(double mean) const {
        const auto& given = *spec_.get("sigma");
        const bool is_percentage = trimmed(given.text).ends_with('%');
        const auto value = is_percentage ? parse_quantity(given.text, "") : number(given);
        if (!value) return is_percentage ? error_at(given, value.error().message) : value.error();
        if (!(*value >= 0)) return error_at(given, "sigma must not be negative");
        if (is_percentage && mean == 0) return error_at(given, "a percentage of a mean of 0 is 0; give sigma as a value");
        return is_percentage ? *value * std::abs(mean) : *value;
    }

    Result<void> normal(SweepAxis& axis) const {
        TRY(accept_only({"mean", "sigma", "at_least", "at_most"}));
        const auto* given_mean = spec_.get("mean");
        if (!spec_.has("sigma")) return error_at_axis("sigma is missing: a standard deviation, or a percentage of the mean such as \"5%\"");
        if (!given_mean && !quantity_.nominal) return error_at_axis("mean is missing");
        const auto mean = TRY(given_mean ? allowed_number(*given_mean) : *quantity_.nominal);
        const auto deviation = TRY(sigma(mean));
        axis.is_normal = true, axis.first = mean, axis.second = deviation;
        double low = quantity_.min, high = quantity_.max;  // range in which the normal distribution is truncated
        if (const auto* given = spec_.get("at_least")) low = TRY(allowed_number(*given));
        if (const auto* given = spec_.get("at_most")) high = TRY(allowed_number(*given));
        if (!(mean >= low && mean <= high)) return error_at_axis("the mean is not between at_least and at_most");
        if (deviation == 0) return {};  // all samples are the mean
        if (std::isfinite(low)) axis.min_probability = normal_probability((low - mean) / deviation);
        if (std::isfinite(high)) axis.max_probability = normal_probability((high - mean) / deviation);
        return {};
    }

    /// Latin hypercubes and Sobol points are normal if mean or sigma is given, otherwise uniform.
    Result<void> sampled(SweepAxis& axis, const SweepPlan& plan) const {
        const auto sampling = method_ == "latin" ? Sampling::latin : method_ == "sobol" ? Sampling::sobol : Sampling::random;
        const bool as_normal = method_ == "normal" || (method_ != "uniform" && (spec_.has("mean") || spec_.has("sigma")));
        if (!as_normal) TRY(accept_only({"from", "to", "log"}));
        TRY(as_normal ? normal(axis) : range(axis));
        const auto dimension = sampling == Sampling::sobol ? static_cast<std::size_t>(std::ranges::count(plan.axes, true, is_sobol)) : 0;
        if (dimension == sobol_dimensions)
            return error_at(*spec_.get("how"), fmt::format("Sobol points are available for at most {} axes", sobol_dimensions));
        axis.numbers.emplace(sampling, plan.chips.seed, axis.column.name, dimension, static_cast<std::uint64_t>(plan.samples));
        return {};
    }

public:
    AxisReader(const ConfigNode& spec, const VariedQuantity& quantity) : spec_(spec), quantity_(quantity) {}

    Result<SweepAxis> read(const SweepPlan& plan) const {
        SweepAxis axis{quantity_.column};
        if (std::find(std::begin(methods), std::end(methods), method_) == std::end(methods))
            return error_at(*spec_.get("how"), fmt::format("how = \"{}\" is unknown{} (there are {})", method_,
                                                           did_you_mean(method_, methods), joined(methods)));
        if (quantity_.labels_only && method_ != "list")
            return error_at_axis(
                fmt::format("its values are labels: list = [\"{}\", ...]", quantity_.column.name == "corner" ? "ss" : "..."));
        TRY(method_ == "grid" ? grid(axis) : method_ == "list" ? list(axis) : sampled(axis, plan));
        return axis;
    }
};

}  // namespace

bool is_sampled(const ConfigNode& spec) {
    const auto method = method_of(spec);
    return method == "uniform" || method == "normal" || method == "latin" || method == "sobol";
}

Result<SweepAxis> axis_of(const ConfigNode& spec, const VariedQuantity& quantity, const SweepPlan& plan) {
    return AxisReader(spec, quantity).read(plan);
}

Result<std::int64_t> parse_integer(const LocatedText& given, std::string_view name, double min, double max) {
    const auto value = parse_quantity(given.text, "");
    if (!value || *value != std::floor(*value) || !(*value >= min && *value <= max))
        return given.error_here(fmt::format("{} = {} must be an integer from {:g} to {:g}", name, given.text, min, max));
    return static_cast<std::int64_t>(*value);
}

}  // namespace corpuscle::sweeps
