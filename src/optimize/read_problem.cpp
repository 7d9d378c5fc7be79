// Reads an optimization file: makes the sweep that simulates its designs, then the variables, cases, limits and goal.

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <filesystem>

#include "core/text/input_files.hpp"
#include "core/text/quantity.hpp"
#include "optimize/problem_text.hpp"
#include "run/afferent_plan.hpp"

namespace corpuscle::optimize {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_file_size = std::size_t{1} << 20;  // bytes

constexpr auto pattern_keys = std::to_array<ConfigKey>({"like", "first_spike", "within", "cases"});
constexpr auto search_keys = std::to_array<ConfigKey>({"points", "starts", "evaluations", "rounds", "cases"});

class ProblemReader {
    const ProblemText& text_;
    OptimizationProblem out_;

    static Error missing(const LocatedText& at, std::string message) { return at.error_here(std::move(message)); }

    /// The conditions and chips are those of the file; .step and .mc of the netlist would add others.
    Result<void> check_netlist() const {
        if (const auto* circuit = out_.sweep->nominal_circuit())
            for (const auto& d : circuit->directives)
                if (d.name == "step" || d.name == "mc")
                    return bad_input(fmt::format(".{} is not used here; remove it, and write {} instead", d.name,
                                                 d.name == "mc" ? "[chips] in the optimization file" : "[[at]] in the optimization file"),
                                     d.location);
        return {};
    }

    /// The phases of the force, and the time before, between and after them.
    static std::vector<TimeWindow> windows_of(const sweeps::SweepForce& force) {
        std::vector<TimeWindow> out;
        double from = 0;
        for (const auto& p : force.phases) {
            if (p.from > from) out.push_back({from, p.from});
            out.push_back({p.from, p.to}), from = p.to;
        }
        if (force.end() > from) out.push_back({from, force.end()});
        return out;
    }

    Result<void> read_pattern() {
        const auto* pattern = text_.top.get("pattern");
        if (!pattern) return {};
        TRY(check_keys(*pattern, pattern_keys, "[pattern]: "));
        const auto* like = pattern->get("like");
        if (!like)
            return missing(*pattern, "[pattern]: 'like' is missing: the model whose spikes are the reference, such as like = \"sa1\"");
        const auto* force = out_.sweep->nominal_force();
        if (!force) return like->error_here("[pattern]: models respond to a force; use it with afferent = ..., not with netlist = ...");
        const auto plan = TRY(like->located(plan_any_afferent(like->text), "like: "));
        const auto response = TRY(sweeps::simulate_afferent(*make_afferent(plan.result, {force->clock.T()}), *force));
        double tolerance = 0;
        if (const auto* given = pattern->get("first_spike")) {
            tolerance = TRY(given->located(parse_quantity(given->text, "s"), "first_spike: "));
            if (!(tolerance > 0)) return given->error_here(fmt::format("first_spike = {} must be above 0 s", given->text));
        }
        if (const auto* given = pattern->get("cases")) {
            if (given->text != "all" && given->text != "nominal")
                return given->error_here(
                    fmt::format("[pattern]: cases = \"{}\" is unknown; write \"all\", or \"nominal\" for the first "
                                "condition and the chips",
                                given->text));
            out_.pattern_is_nominal = given->text == "nominal";
        }
        std::optional<double> within;
        if (const auto* given = pattern->get("within")) within = static_cast<double>(TRY(sweeps::parse_integer(*given, "within", 0, 1e6)));
        out_.pattern = FiringLimits::around(response.spikes, windows_of(*force), tolerance, within);
        return {};
    }

    Result<void> read_goal() {
        auto& goal = out_.goal;
        const auto* node = text_.top.get("goal");
        const auto* name = node ? node->has("minimize") ? node->get("minimize") : node->get("maximize") : nullptr;
        const bool has_limits = text_.top.has("limits") || text_.top.has("nominal_limits") || out_.pattern;
        switch (goal.kind) {
            case DesignGoal::Kind::none:
                if (!has_limits)
                    return bad_input("there is neither a goal nor a limit; add [goal] with minimize = ..., [pattern] or [limits]",
                                     {text_.file()});
                return {};
            case DesignGoal::Kind::measure:
                goal.column = TRY(out_.sweep->add_measure(*name));
                goal.unit = out_.sweep->measures[goal.column].unit;
                return {};
            case DesignGoal::Kind::distance:
                if (out_.pattern) return {};
                return name->error_here("the distance is that of the spikes from a [pattern]; add one with like = \"sa1\"");
            case DesignGoal::Kind::yield:
                if (text_.chips > 0 && has_limits) return {};
                return name->error_here("the yield is the fraction of the [chips] within [pattern] and [limits]; add them");
        }
        return {};
    }

    void mark_nominal_limits() {
        const auto* limits = text_.top.get("nominal_limits");
        for (const auto& measure : out_.sweep->measures) out_.is_nominal_limit.push_back(limits && limits->has(measure.name));
    }

    Result<void> read_search() {
        const auto* search = text_.top.get("search");
        if (!search) return {};
        TRY(check_keys(*search, search_keys, "[search]: "));
        const auto read = [&](const char* key, double min, double max, std::size_t& value) -> Result<void> {
            if (const auto* given = search->get(key)) value = static_cast<std::size_t>(TRY(sweeps::parse_integer(*given, key, min, max)));
            return {};
        };
        auto& s = out_.search;
        TRY(read("points", 0, 100'000, s.points));
        TRY(read("starts", 1, 64, s.starts));
        TRY(read("evaluations", 1, 100'000, s.evaluations));
        TRY(read("rounds", 1, 100, s.rounds));
        TRY(read("cases", 1, 10'000, s.cases));
        return {};
    }

public:
    explicit ProblemReader(const ProblemText& text) : text_(text) {}

    Result<OptimizationProblem> read(const std::string& folder) {
        const auto& top = text_.top;
        if (const auto* seed = top.get("seed"))
            out_.seed = static_cast<std::uint64_t>(TRY(sweeps::parse_integer(*seed, "seed", 0, 0x1p53 - 1)));
        out_.sweep = TRY(sweeps::make_planned_sweep(text_.sweep, folder));
        TRY(check_netlist());
        out_.variables = TRY(read_variables(text_, *out_.sweep));
        out_.cases = TRY(make_cases(text_, out_.sweep->plan()));
        out_.condition_count = out_.cases.size() - text_.chips, out_.required_yield = text_.required_yield;
        out_.goal = text_.goal;
        TRY(read_pattern());
        TRY(read_goal());
        mark_nominal_limits();
        TRY(read_search());
        const auto* circuit = out_.sweep->nominal_circuit();
        out_.file = text_.file(), out_.subject = (top.has("afferent") ? top.get("afferent") : top.get("netlist"))->text;
        out_.title = top.has("title") ? top.get("title")->text : circuit ? circuit->title : out_.subject;
        return std::move(out_);
    }
};

/// Gives errors about other files, such as the netlist, their full path, and errors without a file that of the optimization file.
Error with_file(Error error, const fs::path& file) {
    std::error_code status;
    const auto full_path = file.parent_path() / error.location.file;
    if (error.location.file.empty())
        error.location.file = file.string();
    else if (error.location.file != file.string() && fs::exists(full_path, status))
        error.location.file = full_path.string();
    return error;
}

}  // namespace

Result<OptimizationProblem> read_problem_text(const std::string& text, const std::string& name, const OptimizationOverrides& overrides) {
    auto top = TRY(parse_toml(text, name));
    auto canonical = canonical_toml(text);
    if (overrides.seed) {
        top.set("seed", fmt::format("{}", *overrides.seed));
        canonical += fmt::format("--seed {}\n", *overrides.seed);
    }
    const auto interpreted = interpret_text(std::move(top), std::move(canonical));
    if (!interpreted) return with_file(interpreted.error(), name);
    auto problem = ProblemReader(*interpreted).read(fs::path(name).parent_path().string());
    return problem ? std::move(problem) : Result<OptimizationProblem>(with_file(problem.error(), name));
}

Result<OptimizationProblem> read_problem(const std::string& path, const OptimizationOverrides& overrides) {
    const auto text = TRY(read_entire_input(path, max_file_size, "optimization file"));
    return read_problem_text(text, path, overrides);
}

}  // namespace corpuscle::optimize
