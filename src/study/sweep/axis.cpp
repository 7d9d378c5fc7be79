#include "study/sweep/axis.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "signal/elementary.hpp"
#include "signal/field.hpp"
#include "signal/quantity.hpp"
#include "signal/text.hpp"
#include "study/sweep/sobol.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr std::string_view ways[] = {"grid", "list", "uniform", "normal", "latin", "sobol"};
constexpr double most_values = 1e6;

/// How it is to vary: as it says, else as what it gives shows.
std::string way_of(const SaidAxis& said) {
    if (said.how) return said.how->text;
    if (said.list) return "list";
    if (said.mean || said.sigma) return "normal";
    return "grid";
}

/// Reads one axis.
class AxisReader {
    const SaidAxis& said_;
    const Target& target_;
    const std::string way_ = way_of(said_);

    std::string named() const { return said_.what.text; }
    Error wrong(const Said& at, std::string sentence) const { return at.wrong(fmt::format("{}: {}", named(), sentence)); }
    Error missing(std::string sentence) const { return wrong(said_.how ? *said_.how : said_.what, std::move(sentence)); }

    Result<double> number(const Said& said) const {
        auto value = target_.read(said);
        if (!value) return wrong(said, value.error().sentence);
        return value;
    }
    /// One that the subject may be given.
    Result<double> allowed(const Said& said) const {
        const auto value = number(said);
        if (!value) return value;
        if (!(*value >= target_.low && *value <= target_.high))
            return wrong(
                said, fmt::format("{} is outside [{}, {}]", format_quantity(*value, target_.column.unit),
                                  format_quantity(target_.low, target_.column.unit), format_quantity(target_.high, target_.column.unit)));
        if (target_.check)
            if (auto ok = target_.check(said.text); !ok) return said.wrong(ok.error().sentence);
        return value;
    }

    /// Keys that mean nothing here.
    Result<void> only(std::initializer_list<std::string_view> known) const {
        const std::pair<std::string_view, const MaybeSaid*> all[] = {
            {"from", &said_.from}, {"to", &said_.to},       {"count", &said_.count},       {"log", &said_.log},
            {"mean", &said_.mean}, {"sigma", &said_.sigma}, {"at_least", &said_.at_least}, {"at_most", &said_.at_most}};
        for (const auto& [name, value] : all)
            if (*value && std::find(known.begin(), known.end(), name) == known.end())
                return wrong(**value,
                             fmt::format("'{}' has no meaning for how = \"{}\" (it takes {})", name, way_, fmt::join(known, ", ")));
        if (said_.list && way_ != "list")
            return wrong(said_.list->empty() ? said_.what : said_.list->front(), fmt::format("a list, and how = \"{}\"", way_));
        return {};
    }

    Result<bool> by_powers() const {
        if (!said_.log || said_.log->text == "false") return false;
        if (said_.log->text != "true") return wrong(*said_.log, fmt::format("log is true or false, not '{}'", said_.log->text));
        return true;
    }

    /// from and to, both above 0 where they are parted by powers.
    Result<void> ends(SweepAxis& axis) const {
        if (!said_.from || !said_.to)
            return missing(fmt::format("{} is missing; how = \"{}\" wants {}", said_.from ? "to" : "from", way_,
                                       way_ == "grid" ? "from, to and count, or a list" : "from and to"));
        const auto from = allowed(*said_.from), to = allowed(*said_.to);
        if (!from) return from.error();
        if (!to) return to.error();
        const auto powers = by_powers();
        if (!powers) return powers.error();
        if (*powers && !(*from > 0 && *to > 0)) return wrong(*said_.log, "by powers go only values above 0");
        axis.first = *from, axis.second = *to, axis.by_powers = *powers;
        return {};
    }

    Result<void> grid(SweepAxis& axis) const {
        if (auto ok = only({"from", "to", "count", "log"}); !ok) return ok;
        if (auto ok = ends(axis); !ok) return ok;
        if (!said_.count) return missing("count is missing: how many values from .. to are wanted (or how = \"uniform\", to draw them)");
        const auto count = whole_of(*said_.count, named() + ": count", 1, most_values);
        if (!count) return count.error();
        if (*count == 1 && axis.first != axis.second) return wrong(*said_.count, "one value cannot go from .. to; count is 2 or more");
        for (std::int64_t k = 0; k < *count; ++k) {
            const double share = *count == 1 ? 0 : static_cast<double>(k) / static_cast<double>(*count - 1);
            axis.values.push_back(k == 0            ? axis.first
                                  : k == *count - 1 ? axis.second
                                  : axis.by_powers  ? axis.first * num::exp(share * num::log(axis.second / axis.first))
                                                    : axis.first + share * (axis.second - axis.first));
        }
        return {};
    }

    Result<void> words(SweepAxis& axis) const {
        for (const auto& word : *said_.list) {
            if (target_.check)
                if (auto ok = target_.check(word.text); !ok) return word.wrong(ok.error().sentence);
            axis.values.push_back(static_cast<double>(axis.column.words.size()));
            axis.column.words.push_back(word.text);
        }
        return {};
    }

    Result<void> list(SweepAxis& axis) const {
        if (auto ok = only({}); !ok) return ok;
        if (!said_.list || said_.list->empty()) return missing("the list is empty: list = [...]");
        const auto is_word = [&](const Said& s) { return !target_.read(s); };
        if (target_.words_alone || (target_.words_too && std::any_of(said_.list->begin(), said_.list->end(), is_word))) return words(axis);
        for (const auto& one : *said_.list) {
            const auto value = allowed(one);
            if (!value) return value.error();
            axis.values.push_back(*value);
        }
        return {};
    }

    /// "5%" of the mean, or in the unit itself.
    Result<double> sigma(double mean) const {
        const auto& said = *said_.sigma;
        const bool share = trimmed(said.text).ends_with('%');
        const auto value = share ? parse_quantity(said.text, "") : number(said);
        if (!value) return share ? wrong(said, value.error().sentence) : value.error();
        if (!(*value >= 0)) return wrong(said, "sigma is a deviation, and not below 0");
        if (share && mean == 0) return wrong(said, "a share of a mean of 0 is nothing; write sigma itself");
        return share ? *value * std::abs(mean) : *value;
    }

    Result<void> normal(SweepAxis& axis) const {
        if (auto ok = only({"mean", "sigma", "at_least", "at_most"}); !ok) return ok;
        if (!said_.sigma) return missing("sigma is missing: a deviation, or a share of the mean such as \"5%\"");
        if (!said_.mean && !target_.nominal) return missing("mean is missing");
        const auto mean = said_.mean ? allowed(*said_.mean) : *target_.nominal;
        if (!mean) return mean.error();
        const auto deviation = sigma(*mean);
        if (!deviation) return deviation.error();
        axis.normal = true, axis.first = *mean, axis.second = *deviation;
        double low = target_.low, high = target_.high;
        for (const auto& [said, end] : {std::pair{&said_.at_least, &low}, {&said_.at_most, &high}}) {
            if (!*said) continue;
            const auto value = allowed(**said);
            if (!value) return value.error();
            *end = *value;
        }
        if (!(*mean >= low && *mean <= high)) return missing("the mean is not between at_least and at_most");
        if (*deviation == 0) return {};
        if (std::isfinite(low)) axis.least_share = normal_share((low - *mean) / *deviation);
        if (std::isfinite(high)) axis.most_share = normal_share((high - *mean) / *deviation);
        return {};
    }

    Result<void> drawn(SweepAxis& axis, Drawing& drawing) const {
        const auto sampling = way_ == "latin" ? Sampling::latin : way_ == "sobol" ? Sampling::sobol : Sampling::random;
        const bool as_normal = way_ == "normal" || (way_ != "uniform" && (said_.mean || said_.sigma));
        if (!as_normal)
            if (auto ok = only({"from", "to", "log"}); !ok) return ok;
        if (auto ok = as_normal ? normal(axis) : ends(axis); !ok) return ok;
        if (sampling == Sampling::sobol && drawing.dimension == sobol_dimensions)
            return wrong(*said_.how, fmt::format("Sobol's points are known here for {} axes", sobol_dimensions));
        axis.numbers.emplace(sampling, drawing.seed, axis.column.name, sampling == Sampling::sobol ? drawing.dimension++ : 0,
                             drawing.draws);
        return {};
    }

public:
    AxisReader(const SaidAxis& said, const Target& target) : said_(said), target_(target) {}

    Result<SweepAxis> read(Drawing& drawing) const {
        SweepAxis axis{target_.column};
        if (std::find(std::begin(ways), std::end(ways), way_) == std::end(ways))
            return wrong(*said_.how,
                         fmt::format("how = \"{}\" is unknown{} (there are {})", way_, did_you_mean(way_, ways), fmt::join(ways, ", ")));
        if (target_.words_alone && way_ != "list")
            return missing(fmt::format("it goes by words: list = [\"{}\", ...]", target_.column.name == "corner" ? "ss" : "..."));
        if (auto ok = way_ == "grid" ? grid(axis) : way_ == "list" ? list(axis) : drawn(axis, drawing); !ok) return ok.error();
        return axis;
    }
};

}  // namespace

bool is_drawn(const SaidAxis& said) {
    const auto way = way_of(said);
    return way == "uniform" || way == "normal" || way == "latin" || way == "sobol";
}

Result<SweepAxis> axis_of(const SaidAxis& said, const Target& target, Drawing& drawing) { return AxisReader(said, target).read(drawing); }

Result<std::int64_t> whole_of(const Said& said, std::string_view what, double least, double most) {
    const auto value = parse_quantity(said.text, "");
    if (!value || *value != std::floor(*value) || !(*value >= least && *value <= most))
        return said.wrong(fmt::format("{} = {} is no whole number from {:g} to {:g}", what, said.text, least, most));
    return static_cast<std::int64_t>(*value);
}

}  // namespace corpuscle::sweeps
