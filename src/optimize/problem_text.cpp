#include "optimize/problem_text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>

#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::optimize {
namespace {

using KeyKind = ConfigKey::Kind;

constexpr auto sweep_keys = std::to_array<std::string_view>(
    {"title", "afferent", "netlist", "force", "channel", "rate", "unit", "scale", "iterations", "orders", "set", "limits"});
constexpr auto top_keys = std::to_array<ConfigKey>({"title",
                                                    "afferent",
                                                    "netlist",
                                                    "force",
                                                    "channel",
                                                    "rate",
                                                    "unit",
                                                    "scale",
                                                    "seed",
                                                    "iterations",
                                                    "orders",
                                                    ConfigKey("set", KeyKind::settings),
                                                    ConfigKey("variable", KeyKind::tables, "each variable"),
                                                    ConfigKey("at", KeyKind::tables, "each condition"),
                                                    ConfigKey("chips", KeyKind::settings),
                                                    ConfigKey("pattern", KeyKind::settings),
                                                    ConfigKey("limits", KeyKind::table),
                                                    ConfigKey("nominal_limits", KeyKind::table),
                                                    ConfigKey("goal", KeyKind::settings),
                                                    ConfigKey("search", KeyKind::settings)});
constexpr auto variable_keys =
    std::to_array<ConfigKey>({ConfigKey("what", KeyKind::any), "from", "to", "start", ConfigKey("log", KeyKind::flag_or_text),
                              ConfigKey("integer", KeyKind::flag_or_text)});
constexpr auto at_keys =
    std::to_array<ConfigKey>({"what", "from", "to", "count", ConfigKey("log", KeyKind::flag_or_text), ConfigKey("list", KeyKind::list)});
constexpr auto goal_keys = std::to_array<ConfigKey>({"minimize", "maximize", "over"});

ConfigNode text_node(std::string text, SourceLocation location) {
    ConfigNode out;
    out.kind = ConfigNode::Kind::text, out.text = std::move(text), out.location = std::move(location);
    return out;
}

ConfigNode list_node(std::vector<ConfigNode> elements, SourceLocation location) {
    ConfigNode out;
    out.kind = ConfigNode::Kind::list, out.elements = std::move(elements), out.location = std::move(location);
    return out;
}

void add_entry(ConfigNode& table, const char* key, ConfigNode value) {
    auto location = value.location;
    table.entries.emplace_back(LocatedText{key, std::move(location)}, std::move(value));
}

/// A [[vary]] of a sweep with these values.
ConfigNode axis_of(const LocatedText& name, std::vector<ConfigNode> values) {
    ConfigNode out;
    out.location = name.location;
    add_entry(out, "what", text_node(name.text, name.location));
    add_entry(out, "list", list_node(std::move(values), name.location));
    return out;
}

class TextReader {
    ProblemText out_;

    static Error missing(const LocatedText& at, std::string message) { return at.error_here(std::move(message)); }

    /// The names of a variable: one, or a list of names that get the same value.
    Result<std::vector<LocatedText>> names_of(const ConfigNode& variable) const {
        const auto* what = variable.get("what");
        if (!what) return missing(variable, "[[variable]]: 'what' is missing; name a .param or a device's parameter, such as \"i_biasf\"");
        if (what->is_scalar()) return std::vector<LocatedText>{*what};
        TRY(check_kind(*what, ConfigKey("what", KeyKind::list)));
        if (what->elements.empty()) return missing(*what, "[[variable]]: the list of names is empty; name at least one quantity");
        return std::vector<LocatedText>(what->elements.begin(), what->elements.end());
    }

    /// Adds the axes of a variable, with its bounds as values, so that the sweep checks names, units and bounds.
    Result<void> add_variable(const ConfigNode& variable, std::vector<ConfigNode>& axes) {
        TRY(check_keys(variable, variable_keys, "[[variable]]: "));
        auto names = TRY(names_of(variable));
        const auto *from = variable.get("from"), *to = variable.get("to");
        if (!from || !to)
            return missing(names[0],
                           fmt::format("{}: '{}' is missing; a variable has the bounds from and to", names[0].text, from ? "to" : "from"));
        axes.push_back(axis_of(names[0], {*from, *to}));
        for (std::size_t k = 1; k < names.size(); ++k) axes.push_back(axis_of(names[k], {*from}));  // one value: fewer combinations
        out_.names.push_back(std::move(names));
        return {};
    }

    /// Adds the axis of a condition. A value that only the chips have is appended to its list.
    Result<void> add_condition(const ConfigNode& at, std::vector<ConfigNode>& axes) {
        TRY(check_keys(at, at_keys, "[[at]]: "));
        if (!at.has("what"))
            return missing(at, "[[at]]: 'what' is missing; give the condition that changes, such as \"temp\" or \"corner\"");
        auto axis = at;
        ConfigNode chip_value;
        if (const auto* chips = out_.top.get("chips"))
            for (const auto& [key, value] : chips->entries)
                if (equal_ignoring_case(key.text, at.get("what")->text)) chip_value = value;
        if (chip_value.is_scalar()) {
            if (!at.has("list"))
                return missing(chip_value, fmt::format("[chips]: {} needs [[at]] with a list, not with from and to", at.get("what")->text));
            for (auto& [key, value] : axis.entries)
                if (key.text == "list") value.elements.push_back(chip_value);
        }
        out_.chip_settings.push_back(chip_value);
        axes.push_back(std::move(axis));
        return {};
    }

    /// [chips] has its own keys, and the conditions' names.
    Result<void> check_chip_keys(const ConfigNode& chips) const {
        for (const auto& [key, value] : chips.entries) {
            const bool is_condition = std::ranges::any_of(out_.conditions(), [&](const ConfigNode& at) {
                return at.has("what") && equal_ignoring_case(at.get("what")->text, key.text);
            });
            constexpr std::string_view own[] = {"samples", "yield", "process", "mismatch"};
            if (!is_condition && std::find(std::begin(own), std::end(own), key.text) == std::end(own))
                return key.error_here(fmt::format("[chips]: '{}' is neither samples, yield, process, mismatch, nor a condition of [[at]]{}",
                                                  key.text, did_you_mean(key.text, own)));
        }
        return {};
    }

    Result<void> read_yield(const ConfigNode& yield) {
        out_.required_yield = TRY(yield.located(parse_quantity(yield.text, ""), "yield: "));
        if (out_.required_yield > 0 && out_.required_yield <= 1) return {};
        return missing(yield,
                       fmt::format("yield = {} is outside (0, 100 %]; write the fraction of the chips that must be within the limits, "
                                   "such as \"95%\"",
                                   yield.text));
    }

    /// Reads [chips], and adds the axes that make the sweep sample them.
    Result<void> read_chips(std::vector<ConfigNode>& axes) {
        const auto* chips = out_.top.get("chips");
        if (!chips) return {};
        TRY(check_chip_keys(*chips));
        const auto* samples = chips->get("samples");
        if (!samples) return missing(*chips, "[chips]: 'samples' is missing: the number of chips, such as samples = 20");
        out_.chips = static_cast<std::size_t>(TRY(sweeps::parse_integer(*samples, "samples", 1, 10'000)));
        if (const auto* yield = chips->get("yield")) TRY(read_yield(*yield));
        bool varies_process = true, varies_mismatch = true;
        if (chips->has("process")) varies_process = TRY(flag_of(*chips, "process"));
        if (chips->has("mismatch")) varies_mismatch = TRY(flag_of(*chips, "mismatch"));
        if (!varies_process && !varies_mismatch)
            return missing(*chips, "[chips]: with process = false and mismatch = false all chips would be equal; set one of them to true");
        for (const auto& [name, varies] : {std::pair{"process", varies_process}, std::pair{"mismatch", varies_mismatch}}) {
            if (!varies) continue;
            ConfigNode axis;
            axis.location = chips->location;
            add_entry(axis, "what", text_node(name, chips->location));
            axes.push_back(std::move(axis));
        }
        out_.sweep.top.set("samples", samples->text);
        return {};
    }

    /// The measures that the simulations must have: that of the goal; the limits add theirs.
    Result<void> add_measures() {
        const auto* goal = out_.top.get("goal");
        std::vector<ConfigNode> measures;
        if (goal) {
            TRY(check_keys(*goal, goal_keys, "[goal]: "));
            const auto *min = goal->get("minimize"), *max = goal->get("maximize");
            if (min && max) return missing(*max, "[goal]: give either minimize or maximize; further quantities can have [limits]");
            const auto* name = min ? min : max;
            if (!name) return missing(*goal, "[goal]: 'minimize' is missing: the measure to reduce, such as minimize = \"power\"");
            out_.goal.name = name->text, out_.goal.is_maximized = max != nullptr;
            out_.goal.kind = name->text == "distance" ? DesignGoal::Kind::distance
                             : name->text == "yield"  ? DesignGoal::Kind::yield
                                                      : DesignGoal::Kind::measure;
            TRY(read_over(goal->get("over")));
            if (out_.goal.kind == DesignGoal::Kind::measure) measures.push_back(*name);
        }
        if (measures.empty() && out_.top.has("afferent")) measures.push_back(text_node("spikes", out_.top.location));
        if (!measures.empty()) add_entry(out_.sweep.top, "measures", list_node(std::move(measures), out_.top.location));
        return {};
    }

    Result<void> read_over(const ConfigNode* over) {
        using Over = DesignGoal::Over;
        if (!over) return {};
        if (over->text == "first")
            out_.goal.over = Over::first;
        else if (over->text == "mean")
            out_.goal.over = Over::mean;
        else if (over->text == "worst")
            out_.goal.over = Over::worst;
        else
            return over->error_here(
                fmt::format("[goal]: over = \"{}\" is unknown; write \"first\" (the first condition), \"mean\" or "
                            "\"worst\" (of all conditions)",
                            over->text));
        return {};
    }

    /// Adds the limits of the first condition and of the chips to those of all cases. A measure can have only one of both.
    Result<void> add_nominal_limits() {
        const auto* nominal = out_.top.get("nominal_limits");
        if (!nominal) return {};
        auto& entries = out_.sweep.top.entries;
        if (!out_.sweep.top.has("limits")) {
            ConfigNode limits = *nominal;
            limits.entries.clear();
            add_entry(out_.sweep.top, "limits", std::move(limits));
        }
        auto& limits = std::ranges::find_if(entries, [](const auto& entry) { return entry.first.text == "limits"; })->second;
        for (const auto& [name, limit] : nominal->entries) {
            if (limits.has(name.text))
                return name.error_here(fmt::format("[nominal_limits]: {} has limits in [limits], too; keep one of them", name.text));
            limits.entries.emplace_back(name, limit);
        }
        return {};
    }

    /// Writes the sweep: the keys that it shares with the file, and its axes.
    Result<void> write_sweep(std::string canonical) {
        out_.sweep.top.location = out_.top.location, out_.sweep.canonical = std::move(canonical);
        for (const auto& [key, value] : out_.top.entries)
            if (std::find(sweep_keys.begin(), sweep_keys.end(), key.text) != sweep_keys.end())
                out_.sweep.top.entries.emplace_back(key, value);
        if (const auto* seed = out_.top.get("seed")) out_.sweep.top.set("seed", seed->text);
        std::vector<ConfigNode> axes;
        if (out_.variables().empty())
            return bad_input("there is nothing to optimize; add a [[variable]] with what, from and to", {out_.file()});
        if (out_.variables().size() > max_variables)
            return out_.variables()[max_variables].error_here(
                fmt::format("more than {} variables; a [[variable]] can have a list of names that get the same value", max_variables));
        for (const auto& variable : out_.variables()) TRY(add_variable(variable, axes));
        for (const auto& at : out_.conditions()) TRY(add_condition(at, axes));
        TRY(read_chips(axes));
        TRY(add_measures());
        TRY(add_nominal_limits());
        add_entry(out_.sweep.top, "vary", list_node(std::move(axes), out_.top.location));
        return {};
    }

public:
    Result<ProblemText> read(ConfigNode top, std::string canonical) {
        TRY(check_keys(top, top_keys, ""));
        out_.top = std::move(top);
        TRY(write_sweep(std::move(canonical)));
        return std::move(out_);
    }
};

}  // namespace

Result<ProblemText> interpret_text(ConfigNode top, std::string canonical) {
    return TextReader().read(std::move(top), std::move(canonical));
}

Result<bool> flag_of(const ConfigNode& table, std::string_view key) {
    const auto* given = table.get(key);
    if (!given || given->text == "false") return false;
    if (given->text == "true") return true;
    return given->error_here(fmt::format("{} must be true or false, not '{}'", key, given->text));
}

}  // namespace corpuscle::optimize
