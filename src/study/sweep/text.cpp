// A sweep file's TOML; the one place that knows toml++.

#include "study/sweep/text.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "signal/field.hpp"

namespace corpuscle::sweeps {
namespace {

using Names = std::vector<std::string_view>;

const Names known_keys = {"title",      "afferent", "netlist", "force", "channel", "rate",     "unit", "scale",  "seed",  "units",
                          "iterations", "every",    "orders",  "set",   "vary",    "measures", "keep", "traces", "limits"};
const Names axis_keys = {"what", "how", "from", "to", "count", "log", "list", "mean", "sigma", "at_least", "at_most"};
const Names limit_keys = {"at_least", "at_most", "like", "within"};

std::string joined(const Names& names) { return fmt::format("{}", fmt::join(names, ", ")); }
bool is_one_of(const Names& names, std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); }

/// Reads tables; the first thing that is wrong is kept, and what comes after it does not matter.
class Reading {
    const std::string& file_;

public:
    std::optional<Error> wrong;

    explicit Reading(const std::string& file) : file_(file) {}

    Place place(const toml::source_region& at) const {
        return {file_, static_cast<long>(at.begin.line), static_cast<long>(at.begin.column)};
    }
    void refuse(const toml::source_region& at, std::string sentence) {
        if (!wrong) wrong = bad_input(std::move(sentence), place(at));
    }

    void only(const toml::table& table, const Names& known, std::string_view where) {
        for (const auto& [key, value] : table)
            if (!is_one_of(known, key.str()))
                refuse(key.source(),
                       fmt::format("{}there is no '{}'{} (there are {})", where, key.str(), did_you_mean(key.str(), known), joined(known)));
    }

    static std::string_view kind(const toml::node& node) {
        if (node.is_table()) return "a table";
        if (node.is_array() || node.is_array_of_tables()) return "a list";
        if (node.is_boolean()) return "true or false";
        return "a date";
    }

    /// A text or a number; `truth`: or true, false.
    MaybeSaid scalar(const toml::node& node, std::string_view name, bool truth = false) {
        Said out{{}, place(node.source())};
        if (const auto* text = node.as_string())
            out.text = text->get();
        else if (const auto* whole = node.as_integer())
            out.text = fmt::format("{}", whole->get());
        else if (const auto* real = node.as_floating_point())
            out.text = fmt::format("{}", real->get());
        else if (const auto* boolean = node.as_boolean(); boolean && truth)
            out.text = boolean->get() ? "true" : "false";
        else
            return refuse(node.source(), fmt::format("{} is {}; a text or a number is wanted", name, kind(node))), MaybeSaid{};
        return out;
    }
    MaybeSaid scalar(const toml::table& table, std::string_view name, bool truth = false) {
        const auto* node = table.get(name);
        return node ? scalar(*node, name, truth) : std::nullopt;
    }

    std::optional<std::vector<Said>> list(const toml::table& table, std::string_view name) {
        const auto* node = table.get(name);
        if (!node) return {};
        const auto* array = node->as_array();
        if (!array) return refuse(node->source(), fmt::format("{} wants a list: {} = [...]", name, name)), std::nullopt;
        std::vector<Said> out;
        for (const auto& one : *array)
            if (auto said = scalar(one, fmt::format("an element of {}", name))) out.push_back(std::move(*said));
        return out;
    }

    const toml::table* table(const toml::table& of, std::string_view name) {
        const auto* node = of.get(name);
        if (node && !node->is_table()) refuse(node->source(), fmt::format("{} wants a table: [{}] on a line of its own", name, name));
        return node ? node->as_table() : nullptr;
    }

    /// [set]: press.F_max = "2N" is a table in a table, and means what "press.F_max" does.
    void settings(const toml::table& from, const std::string& before, std::vector<SaidSetting>& out) {
        for (const auto& [key, value] : from) {
            const auto name = before + std::string(key.str());
            if (const auto* inner = value.as_table())
                settings(*inner, name + ".", out);
            else if (auto said = scalar(value, name))
                out.push_back({name, std::move(*said)});
        }
    }

    void limits(const toml::table& from, const std::string& before, std::vector<SaidLimit>& out) {
        for (const auto& [key, value] : from) {
            SaidLimit limit{{before + std::string(key.str()), place(key.source())}, {}, {}, {}, {}};
            if (const auto* pair = value.as_array()) {
                if (pair->size() != 2)
                    return refuse(value.source(), fmt::format("{}: a limit of two numbers is wanted, [least, most]", limit.measure.text));
                limit.at_least = scalar((*pair)[0], limit.measure.text), limit.at_most = scalar((*pair)[1], limit.measure.text);
            } else if (const auto* inner = value.as_table()) {
                const bool of_limit = inner->is_inline() || inner->empty() || std::any_of(inner->begin(), inner->end(), [](const auto& e) {
                                          return is_one_of(limit_keys, e.first.str());
                                      });
                if (!of_limit) {
                    limits(*inner, limit.measure.text + ".", out);
                    continue;
                }
                only(*inner, limit_keys, limit.measure.text + ": ");
                limit.at_least = scalar(*inner, "at_least"), limit.at_most = scalar(*inner, "at_most");
                limit.like = scalar(*inner, "like"), limit.within = scalar(*inner, "within");
            } else {
                return refuse(value.source(),
                              fmt::format("{0}: write {0} = [least, most], or {{at_least = ...}}, {{at_most = ...}}, {{like = \"sa1\", "
                                          "within = ...}}",
                                          limit.measure.text));
            }
            out.push_back(std::move(limit));
        }
    }

    void axis(const toml::table& from, std::vector<SaidAxis>& out) {
        only(from, axis_keys, "[[vary]]: ");
        SaidAxis a;
        if (auto what = scalar(from, "what"))
            a.what = std::move(*what);
        else
            refuse(from.source(), "[[vary]]: what varies is missing: what = \"process\", \"temp\", a parameter's name ...");
        a.how = scalar(from, "how"), a.from = scalar(from, "from"), a.to = scalar(from, "to"), a.count = scalar(from, "count");
        a.log = scalar(from, "log", true), a.mean = scalar(from, "mean"), a.sigma = scalar(from, "sigma");
        a.at_least = scalar(from, "at_least"), a.at_most = scalar(from, "at_most"), a.list = list(from, "list");
        out.push_back(std::move(a));
    }

    void axes(const toml::table& from, std::vector<SaidAxis>& out) {
        const auto* node = from.get("vary");
        if (!node) return;
        const auto* array = node->as_array();
        if (!array) return refuse(node->source(), "vary wants tables: [[vary]] on a line of its own, one for each thing that varies");
        for (const auto& one : *array) {
            const auto* inner = one.as_table();
            if (!inner) return refuse(one.source(), "vary wants tables: [[vary]] on a line of its own, one for each thing that varies");
            axis(*inner, out);
        }
    }
};

SweepText text_from(const toml::table& top, Reading& reading) {
    SweepText out;
    reading.only(top, known_keys, "");
    out.title = reading.scalar(top, "title"), out.afferent = reading.scalar(top, "afferent"), out.netlist = reading.scalar(top, "netlist");
    out.force = reading.scalar(top, "force"), out.channel = reading.scalar(top, "channel"), out.rate = reading.scalar(top, "rate");
    out.unit = reading.scalar(top, "unit"), out.scale = reading.scalar(top, "scale");
    out.seed = reading.scalar(top, "seed"), out.units = reading.scalar(top, "units"), out.every = reading.scalar(top, "every");
    out.iterations = reading.scalar(top, "iterations"), out.orders = reading.scalar(top, "orders");
    out.measures = reading.list(top, "measures"), out.keep = reading.list(top, "keep");
    if (auto traces = reading.list(top, "traces")) out.traces = std::move(*traces);
    if (const auto* set = reading.table(top, "set")) reading.settings(*set, "", out.set);
    if (const auto* limits = reading.table(top, "limits")) reading.limits(*limits, "", out.limits);
    reading.axes(top, out.vary);
    return out;
}

/// Tables as tables, whichever way they were written.
void lay_out(toml::node& node) {
    if (auto* table = node.as_table()) {
        table->is_inline(false);
        for (auto&& [key, value] : *table) lay_out(value);
    }
    if (auto* array = node.as_array())
        for (auto& value : *array) lay_out(value);
}

std::string canonical_text(toml::table top) {
    lay_out(top);
    std::ostringstream out;
    out << toml::toml_formatter{top} << '\n';
    return out.str();
}

}  // namespace

Result<SweepText> read_sweep_text(std::string_view text, const std::string& file) {
    Reading reading(file);
    try {
        const toml::table top = toml::parse(text);
        auto out = text_from(top, reading);
        if (reading.wrong) return *reading.wrong;
        out.file = file, out.canonical = canonical_text(top);
        return out;
    } catch (const toml::parse_error& error) {
        return bad_input(std::string(error.description()), reading.place(error.source()));
    }
}

}  // namespace corpuscle::sweeps
